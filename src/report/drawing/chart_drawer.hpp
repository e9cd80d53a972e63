#pragma once

#include <optional>
#include <string>

#include "chart.hpp"

namespace hamjet::io {

/// Draws fitted charts with gnuplot, and stops asking a program that is not there or does not
/// answer.
class ChartDrawer {
 public:
  /// The program is a name on the path, or a path; without one nothing is drawn.
  explicit ChartDrawer(std::string program)
      : program_(std::move(program)), is_asked_(!program_.empty()) {}

  /// The chart as a file, or an empty text and the reason.
  std::string draw(const Chart& chart, Drawing drawing, std::string& reason);
  /// The chart in both widths, a panel in one, as a part of a page, or an empty text and the
  /// reason.
  std::string draw_inline(const Chart& chart, std::string& reason);

  /// The first reason for which something could not be drawn, one line.
  const std::optional<std::string>& problem() const noexcept { return problem_; }

 private:
  std::string program_;
  std::optional<std::string> problem_;
  bool is_asked_;
};

}  // namespace hamjet::io
