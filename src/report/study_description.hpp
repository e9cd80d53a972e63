#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "../store/table_view.hpp"
#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/report/study_report.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// How a study is done: who hears of its progress, what its report says of its origin, and how many
/// threads it may use.
struct StudyWork {
  ProgressCallback progress = {};
  ReportOrigin origin = {};
  std::size_t threads = 1;
};

/// A study that has been done. Report and tables are made of its result when they are asked for.
struct DoneStudy {
  std::function<StudyReport()> report;
  std::function<std::vector<TableView>()> tables;  ///< the study's own first
};

/// All that the program knows of a study that works on a table of a scene. Commands, their help and
/// completion, sweeps, `hamjet check`, the page of columns and the Python module read it; nothing
/// else lists studies.
struct StudyDescription {
  std::string_view command = {};   ///< `hamjet <command>`, and the end of the name of its results
  std::string_view purpose = {};   ///< the command's line of help
  std::string_view files = {};     ///< what the command writes, for its help
  std::string_view example = {};   ///< what `hamjet --help` says of `hamjet <command> scene.toml`
  std::string_view table = {};     ///< the key of the table that it works on; empty: none
  std::string_view smallest = {};  ///< what the smallest such table holds, in one line
  bool (*has_table)(const Scene& scene) = nullptr;
  /// Does the study. Throws what the study throws.
  DoneStudy (*study)(const Scene& scene, const StudyWork& work) = nullptr;
  /// The tables of a result without rows, as the page of columns has them.
  std::vector<TableView> (*declared)() = nullptr;
  /// Whether deputies may leave flow boxes for orbits that are not bound. If so, users are told of
  /// it.
  bool notes_escape = false;
  /// Whether the manoeuvres of orbit messages are flown; other studies refuse them.
  bool flies_manoeuvres = false;
  /// Whether it is about orbits alone, and has nothing for a system that a scene writes.
  bool needs_orbit = false;
  /// What the table lacks for this study though it is there, as `key: problem`; null: nothing.
  std::string (*lack)(const Scene& scene) = nullptr;

  /// What stands behind the scene's name in that of the folder of results.
  std::string suffix() const { return "-" + std::string(command); }
};

/// All studies, in the order in which help shows them. Two of one command work on different tables;
/// the first whose table a scene has is done.
std::span<const StudyDescription> study_descriptions();

/// The commands of the studies, each once, in order.
std::vector<std::string_view> study_commands();

/// The first study of a command, which describes the command. There must be one.
const StudyDescription& first_study_of(std::string_view command);
/// The study of this command that a scene has the table for, or the command's last one.
const StudyDescription& study_of_command(std::string_view command, const Scene& scene);
/// The study that works on the table of this key. There must be one.
const StudyDescription& study_of_table(std::string_view table);

/// The studies whose tables a scene has, with all that they need in them.
std::vector<const StudyDescription*> studies_of(const Scene& scene);
/// The names of all commands that work on a scene, `run` first.
std::vector<std::string_view> commands_of(const Scene& scene);

/// Throws Error(scene) with `file` if the study is of other systems than the scene's, or if the
/// scene has not the table that it works on; the message shows the smallest such table.
void require_table(const StudyDescription& study, const Scene& scene, const std::string& file);
/// require_table, and the same where the scene asks for arcs, which no study splits flows into.
void require_scene_of(const StudyDescription& study, const Scene& scene, const std::string& file);

}  // namespace hamjet::io
