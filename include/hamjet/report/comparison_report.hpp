#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/store/report_file.hpp"
#include "hamjet/store/output_directory.hpp"
#include "hamjet/studies/comparison.hpp"

namespace hamjet::io {

/// Files of the plots that are wanted beside the page.
enum class PlotFormat { none, pdf, png };

/// The runs of an earlier comparison, for one that takes it up again.
struct EarlierRuns {
  std::string determinants;  ///< ReportOrigin::determinants of the earlier comparison
  bool is_complete = false;
  /// The runs as they were written, with those that failed or were left out: see
  /// ComparedRun::is_finished.
  std::vector<ComparedRun> runs;
  std::vector<ComparedRun> cost_runs;
  std::vector<RunAlongTime> along_time;
};

/// `compare.csv`: one row a run, those of the comparison and then those of the cost against order
/// (column `part`), numbers with 17 digits. A field is empty where nothing was computed: all
/// figures of a run that failed or was left out, whose reason is in the column `reason`.
std::string comparison_csv(const ComparisonResult& result);

/// `compare.json`: everything. What was not computed is null. Doubles are written so that the same
/// ones are read back; JSON has no infinite numbers: they are the strings "inf", "-inf" and "nan".
std::string comparison_json(const ComparisonResult& result, const ReportOrigin& origin);

/// Reads a `compare.json`: the runs are bit for bit those that were written (of NaN only that it is
/// one). Throws Error(input_output) in one line with `name`, that of the file, and the place of the
/// mistake.
EarlierRuns read_comparison_runs(std::string_view text, const std::string& name = "compare.json");

/// `report.html`: one page that needs no other file, no network and no script. Where a plot cannot
/// be drawn the page says why, and `drawing_problem` is set to the first reason, one line.
std::string comparison_html(const ComparisonResult& result, const ReportOrigin& origin,
                            std::optional<std::string>& drawing_problem);

/// The table for the terminal: the verdict, and for each series of runs the time to reach relative
/// errors (largest over all degrees) of 1e-6, 1e-9 and 1e-12 as ratios to the best.
std::string comparison_table(const ComparisonResult& result);

/// What the terminal shows beside it if asked for more: every run with its time and errors.
std::string comparison_details(const ComparisonResult& result);

/// All files of a report.
struct ComparisonReport {
  std::vector<ReportFile> files;  ///< `compare.csv`, `report.html`, plots, `compare.json` last
  std::optional<std::string> drawing_problem;  ///< one line, if gnuplot could not draw
};

/// Makes the report, which takes seconds for the plots: `plots/<name>.pdf` or `.png` if asked for.
/// What cannot be drawn is left out, and everything else is there all the same.
ComparisonReport make_report(const ComparisonResult& result, const ReportOrigin& origin,
                             PlotFormat format);

/// Writes all files and commits them. Returns `compare.json` as it is there, with the checksums of
/// the files. Throws Error(input_output).
std::string write_report(const ComparisonReport& report, OutputDirectory& output);

}  // namespace hamjet::io
