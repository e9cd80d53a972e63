#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet::cli {

/// The numbers in which the user gives deviations from a jet's nominal and wants the final ones:
/// canonical, or a relative state of an orbit in metres and m/s.
class EvalCoordinates {
 public:
  /// `frame` and `derivatives` are the words of the command line. Throws Error(usage) if they are
  /// wrong or do not fit the jet's model.
  EvalCoordinates(const io::StoredJet& stored, const std::string& frame,
                  const std::optional<std::string>& derivatives);

  /// The frame in words, with the derivatives.
  const std::string& text() const { return text_; }
  /// Names of the columns of a deviation, and of a final state.
  const std::vector<std::string_view>& initial_columns() const { return initial_columns_; }
  const std::vector<std::string_view>& final_columns() const { return final_columns_; }

  /// A canonical deviation (dq, dp) in the numbers of the initial columns.
  std::vector<double> initial_row(std::span<const double> canonical) const;
  /// The jet's variables of a deviation; no value if the deviation has other components too, of
  /// which the jet says nothing.
  std::optional<std::vector<double>> variables(std::span<const double> deviation) const;
  /// The final state of the jet's components.
  std::vector<double> final_state(std::span<const double> components) const;

 private:
  const io::StoredJet& stored_;
  std::vector<std::string_view> initial_columns_;
  std::vector<std::string_view> final_columns_;
  std::string text_ = "canonical";
  std::optional<ChiefFrame> initial_;  ///< absent: canonical
  std::optional<ChiefFrame> final_;
};

/// Throws Error(usage) if a frame or the derivatives are no such words.
void check_frame(const std::string& frame, const std::optional<std::string>& derivatives);

}  // namespace hamjet::cli
