#include "compare_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "hamjet/error.hpp"
#include "hamjet/io/reference_cache.hpp"
#include "interruption.hpp"
#include "progress.hpp"
#include "report_origin.hpp"
#include "standard_streams.hpp"

namespace hamjet::cli {
namespace {

/// What is finished is saved at most this often.
constexpr std::chrono::seconds checkpoint_interval(2);

/// Puts what an interrupted comparison left into `result`.
void take_up(const std::filesystem::path& directory, const std::string& determinants,
             ComparisonResult& result) {
  const std::filesystem::path file = directory / "compare.json";
  std::ifstream stream(file);
  if (!stream) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: cannot be read, so there is nothing to resume; leave --resume out "
                            "to start",
                            file.string()));
  }
  std::ostringstream text;
  text << stream.rdbuf();
  try {
    io::EarlierRuns earlier = io::read_comparison_runs(text.str());
    if (earlier.determinants != determinants) {
      throw Error(ErrorKind::usage,
                  "is the comparison of another scene or other settings; leave "
                  "--resume out to start anew, or choose another -o");
    }
    result.runs = std::move(earlier.runs);
    result.cost_runs = std::move(earlier.cost_runs);
    result.along_time = std::move(earlier.along_time);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", file.string(), error.what()));
  }
}

/// The runs so far, marked as partial if they are. A page of an earlier comparison would contradict
/// them.
void write_figures(const ComparisonResult& result, const io::ReportOrigin& origin,
                   const std::filesystem::path& directory) {
  io::OutputDirectory output(directory);
  output.write("compare.csv", io::comparison_csv(result));
  output.write("compare.json", io::comparison_json(result, origin));
  output.replace("report.html");
  output.commit();
}

}  // namespace

int compare(const CompareOptions& options) {
  const Scene scene = read_scene(options.scene);
  const std::filesystem::path directory = output_path(options.scene, scene.name);
  io::ReportOrigin origin = report_origin(options.scene.command);
  origin.determinants = comparison_key(scene);
  ComparisonResult result;
  if (options.resume) take_up(directory, origin.determinants, result);
  io::OutputDirectory output(directory);
  io::ReferenceCache cache(io::ReferenceCache::user_directory());
  auto saved = std::chrono::steady_clock::now();
  try {
    Progress progress(!options.scene.quiet);
    ComparisonOptions work;
    work.references = &cache;
    work.progress = [&](const std::string& task, double fraction) {
      stop_if_interrupted();
      progress.update(task, fraction);
    };
    work.checkpoint = [&] {
      const auto now = std::chrono::steady_clock::now();
      if (now - saved < checkpoint_interval) return;
      saved = now;
      const UninterruptedWriting guard(Writing::checkpoint);
      write_figures(result, origin, directory);
    };
    compare(scene, work, result);
  } catch (const Interrupted& interrupted) {
    if (result.runs.empty()) throw;
    {
      const UninterruptedWriting guard(Writing::partial_results);
      write_figures(result, origin, directory);
    }
    print_error(
        fmt::format("interrupted; what was finished is in {}, marked as partial; the same command "
                    "with --resume goes on",
                    directory.string()));
    return interrupted.exit_code();
  }
  {
    // The figures are safe before the plots are drawn.
    const UninterruptedWriting guard(Writing::checkpoint);
    write_figures(result, origin, directory);
  }
  const io::ComparisonReport report = io::make_report(result, origin, options.plots);
  {
    const UninterruptedWriting guard;
    io::write_report(report, output);
  }
  if (report.drawing_problem) print_error(*report.drawing_problem);
  if (options.scene.json) {
    print(report.files.back().content);
  } else if (!options.scene.quiet) {
    print(io::comparison_table(result) + "\n" + advice(result) +
          fmt::format("\nreport: {}\n", (directory / "report.html").string()));
  }
  return 0;
}

}  // namespace hamjet::cli
