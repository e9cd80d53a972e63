#include "study_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "../text/terminal_text.hpp"
#include "hamjet/store/output_directory.hpp"
#include "process/guarded_output.hpp"
#include "process/interruption.hpp"
#include "process/standard_streams.hpp"
#include "progress.hpp"

namespace hamjet::cli {

void print_table(const RunOptions& options, const std::string& table, const std::string& details,
                 const std::string& files) {
  print(io::fitted(table) + (options.verbose ? io::fitted(details) : "") + files);
}

int report_study(const RunOptions& options, const std::string& scene_name,
                 const std::function<io::StudyReport(const ProgressCallback&)>& work) {
  const std::filesystem::path directory = output_path(options, scene_name);
  GuardedOutput guarded(directory);
  io::OutputDirectory& output = guarded.directory();
  io::StudyReport report;
  {
    Progress progress(!options.quiet);
    report = work([&](const std::string& task, double fraction) {
      stop_if_interrupted();
      progress.update(task, fraction);
    });
  }
  std::string summary;
  {
    const UninterruptedWriting guard;
    for (const io::ReportFile& file : report.files) output.write(file.path, file.content);
    summary = output.commit();
  }
  if (report.drawing_problem) print_error(*report.drawing_problem);
  if (options.json) {
    print(report.json.empty() ? summary : report.json);
  } else if (!options.quiet) {
    const auto page = std::find_if(report.files.begin(), report.files.end(), [](const auto& file) {
      return file.path.extension() == ".html";
    });
    print_table(options, report.table, report.details,
                fmt::format("results: {}\n", directory.string()) +
                    (page != report.files.end()
                         ? fmt::format("report: {}\n", (directory / page->path).string())
                         : ""));
  }
  if (report.exit_code != 0) print_error(report.failure);
  return report.exit_code;
}

}  // namespace hamjet::cli
