#include "compare_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "../app/report_origin.hpp"
#include "../formats/reference_cache.hpp"
#include "../store/result_set.hpp"
#include "../store/text_file.hpp"
#include "hamjet/error.hpp"
#include "process/guarded_output.hpp"
#include "process/interruption.hpp"
#include "process/standard_streams.hpp"
#include "progress.hpp"
#include "study_command.hpp"

namespace hamjet::cli {
namespace {

/// What is finished is first saved after this time, then after intervals that double up to the
/// longest.
constexpr std::chrono::milliseconds first_checkpoint(50);
constexpr std::chrono::milliseconds longest_interval(2000);

/// Puts what an interrupted comparison left into `result`.
void take_up(const std::filesystem::path& directory, const std::string& determinants,
             ComparisonResult& result) {
  const std::filesystem::path file = directory / "compare.json";
  if (std::error_code ignored; !std::filesystem::exists(file, ignored)) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: is not there, so there is nothing to resume; leave --resume out "
                            "to start",
                            io::printable_path(file)));
  }
  const io::ResultSet set(directory, "compare.json");
  io::EarlierRuns earlier = io::read_comparison_runs(set.summary(), io::printable_path(file));
  set.verify();
  if (earlier.determinants != determinants) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: is the comparison of another scene or other settings; leave "
                            "--resume out to start anew, or choose another -o",
                            io::printable_path(file)));
  }
  result.runs = std::move(earlier.runs);
  result.cost_runs = std::move(earlier.cost_runs);
  result.along_time = std::move(earlier.along_time);
}

/// The runs so far, marked as partial if they are. Page and plots of an earlier comparison, which
/// would contradict them, go.
void write_figures(const ComparisonResult& result, const io::ReportOrigin& origin,
                   io::OutputDirectory& output) {
  output.write("compare.csv", io::comparison_csv(result));
  output.write("compare.json", io::comparison_json(result, origin));
  output.commit();
}

}  // namespace

int compare(const CompareOptions& options) {
  const Scene scene = read_unsplit_scene(options.scene, "hamjet compare", io::SceneUnits::told);
  const std::filesystem::path directory = output_path(options.scene, scene.name);
  io::ReportOrigin origin = report_origin(options.scene.command);
  origin.determinants = comparison_key(scene);
  ComparisonResult result;
  GuardedOutput guarded(directory);
  io::OutputDirectory& output = guarded.directory();
  note_unused(options.scene, uncompared_coordinates(scene));
  if (options.resume) take_up(directory, origin.determinants, result);
  io::ReferenceCache cache(io::ReferenceCache::user_directory());
  auto saved = std::chrono::steady_clock::now();
  auto interval = first_checkpoint;
  bool are_figures_written = false;
  io::ComparisonReport report;
  std::string summary;
  try {
    {
      Progress progress(!options.scene.quiet);
      ComparisonOptions work;
      work.references = &cache;
      work.progress = [&](const std::string& task, double fraction) {
        stop_if_interrupted();
        progress.update(task, fraction);
      };
      work.checkpoint = [&] {
        const auto now = std::chrono::steady_clock::now();
        if (now - saved < interval) return;
        saved = now;
        interval = std::min(2 * interval, longest_interval);
        const UninterruptedWriting guard(Writing::checkpoint);
        write_figures(result, origin, output);
      };
      compare(scene, work, result);
    }
    {
      // The figures are safe before the plots are drawn.
      const UninterruptedWriting guard(Writing::checkpoint);
      write_figures(result, origin, output);
    }
    are_figures_written = true;
    report = io::make_report(result, origin, options.plots);
    const UninterruptedWriting guard;
    summary = io::write_report(report, output);
  } catch (const Interrupted& interrupted) {
    if (result.runs.empty()) throw;
    if (!are_figures_written) {
      const UninterruptedWriting guard(Writing::partial_results);
      write_figures(result, origin, output);
    }
    // The result, not the moment of the signal, says what the file has: a signal can come between
    // the last figure and its writing.
    const std::string place = directory.string();
    return end_interrupted(
        interrupted,
        result.is_complete
            ? fmt::format("interrupted; all figures are in {}, without the report, which the same "
                          "command with --resume makes",
                          place)
            : fmt::format("interrupted; what was finished is in {}, marked as partial; the same "
                          "command with --resume goes on",
                          place));
  }
  if (report.drawing_problem) print_error(*report.drawing_problem);
  if (options.scene.json) {
    print(summary);
  } else if (!options.scene.quiet) {
    print_table(options.scene, io::comparison_table(result), io::comparison_details(result),
                "\n" + advice(result) +
                    fmt::format("\nreport: {}\n", (directory / "report.html").string()));
  }
  return 0;
}

}  // namespace hamjet::cli
