#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/store/report_file.hpp"

namespace hamjet::io {

/// The files and texts that a study leaves.
struct StudyReport {
  /// CSV files, `figure.svg` where it could be drawn, `summary.json` last.
  std::vector<ReportFile> files;
  std::string table;                           ///< for the terminal
  std::string details = "";                    ///< the same, where more is asked for
  std::string json = "";                       ///< what --json prints; empty: the summary
  int exit_code = 0;                           ///< 0, 1 (a check failed) or 4 (numerical failure)
  std::string failure;                         ///< one line, if the exit code is not 0
  std::optional<std::string> drawing_problem;  ///< one line, if gnuplot could not draw

  /// The content of `summary.json`.
  const std::string& summary() const { return files.back().content; }
};

/// Whether a report has its figure, whose drawing takes most of the time.
enum class Figure { drawn, left_out };

/// The report of a study's result; each study has its own. The figure is drawn by gnuplot; without
/// it the tables are complete all the same.
template <class Result>
StudyReport study_report(const Result& result, Figure figure = Figure::drawn);

}  // namespace hamjet::io
