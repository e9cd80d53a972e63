#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "hamjet/detail/report/study_report.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "scene_options.hpp"

namespace hamjet::cli {

/// Prints a table, its details where the options ask for them, and the lines that name files, which
/// alone may be longer than the terminal is wide.
void print_table(const RunOptions& options, const std::string& table, const std::string& details,
                 const std::string& files);

/// Whether results that end with this exit code must not take the place of those in the directory:
/// a numerical failure left them out, and the earlier ones are whole.
bool keeps_earlier(const std::filesystem::path& directory, int exit_code);

/// Says that the earlier results are kept.
void note_kept(const std::filesystem::path& directory);

/// Does the work of a study, which shows its progress and stops at a signal. Writes the files of
/// its report in place of earlier results, unless keeps_earlier. Then prints what the options ask
/// for, and returns the exit code.
int report_study(const RunOptions& options, const std::string& scene_name,
                 const std::function<io::StudyReport(const ProgressCallback&)>& work);

/// The study of this command of the scene that the options name: writes its results and returns the
/// exit code. Throws Error(scene) if the scene has no table for it.
int study(const RunOptions& options, std::string_view command);

}  // namespace hamjet::cli
