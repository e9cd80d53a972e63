#include "study_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "../app/processors.hpp"
#include "../app/report_origin.hpp"
#include "../report/study_description.hpp"
#include "../store/result_set.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "../text/scene_refusal.hpp"
#include "../text/terminal_text.hpp"
#include "hamjet/error.hpp"
#include "hamjet/store/output_directory.hpp"
#include "process/guarded_output.hpp"
#include "process/interruption.hpp"
#include "process/standard_streams.hpp"
#include "progress.hpp"

namespace hamjet::cli {

void print_table(const RunOptions& options, const std::string& table, const std::string& details,
                 const std::string& files) {
  print(io::fitted(table) + (options.verbose ? io::fitted(details) : "") +
        io::printable_lines(files));
}

bool keeps_earlier(const std::filesystem::path& directory, int exit_code) {
  return exit_code == static_cast<int>(ErrorKind::numerical) &&
         io::has_whole_results(directory, "summary.json");
}

void note_kept(const std::filesystem::path& directory) {
  print_error(
      fmt::format("{}the earlier results in {} are kept, and these are not written; -o "
                  "names another directory",
                  io::note_head, io::printable_path(directory)));
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
  const bool is_kept = keeps_earlier(directory, report.exit_code);
  std::string summary = report.summary();
  {
    const UninterruptedWriting guard;
    if (!is_kept) {
      for (const io::ReportFile& file : report.files) output.write(file.path, file.content);
      summary = output.commit();
    }
  }
  if (report.drawing_problem) print_error(*report.drawing_problem);
  if (options.json) {
    print(report.json.empty() ? summary : report.json);
  } else if (!options.quiet) {
    const auto page = std::find_if(report.files.begin(), report.files.end(), [](const auto& file) {
      return file.path.extension() == ".html";
    });
    std::string places;
    if (!is_kept) places = fmt::format("results: {}\n", io::printable_path(directory));
    if (!is_kept && page != report.files.end()) {
      places += fmt::format("report: {}\n", io::printable_path(directory / page->path));
    }
    print_table(options, report.table, report.details, places);
  }
  if (report.exit_code != 0) print_error(report.failure);
  if (is_kept) note_kept(directory);
  return report.exit_code;
}

int study(const RunOptions& options, std::string_view command) {
  const Scene scene = read_scene(options);
  const io::StudyDescription& described = io::study_of_command(command, scene);
  io::require_scene_of(described, scene, *options.scene_file);
  if (described.notes_escape) note_escape(options, scene);
  return report_study(
      options, scene.name + described.suffix(), [&](const ProgressCallback& progress) {
        return io::naming_file(*options.scene_file, [&] {
          return described
              .study(scene, {progress, report_origin(options.command), usable_processors()})
              .report();
        });
      });
}

}  // namespace hamjet::cli
