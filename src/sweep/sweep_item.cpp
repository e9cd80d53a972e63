#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <type_traits>
#include <utility>

#include "../report/paper/paper_reports.hpp"
#include "../report/study_description.hpp"
#include "../scene/study_reader.hpp"
#include "../store/json_text.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "../text/whole_number.hpp"
#include "hamjet/error.hpp"
#include "hamjet/report/results.hpp"
#include "sweep_items.hpp"

namespace hamjet::io {
namespace {

/// What a command leaves of one item.
struct ItemOutcome {
  std::string summary;
  int exit_code = 0;
  std::string failure;
};

/// The first thing that failed in a propagation.
std::string failure_of(const PropagationResult& result) {
  for (const RunResult& run : result.runs) {
    const std::string& label = run.settings.label;
    if (!run.failure.empty()) return fmt::format("{}: {}", label, run.failure);
    if (!run.failed_checks.empty()) return fmt::format("{}: {}", label, run.failed_checks[0]);
    for (const KindResult& kind : run.kinds) {
      if (!kind.failure.empty()) return fmt::format("{}: {}", label, kind.failure);
    }
  }
  if (!result.reference_failure.empty()) return "reference: " + result.reference_failure;
  return result.relative_hamiltonian_failure;
}

ItemOutcome run_flow_jet(const Scene& scene, const ProgressCallback& progress) {
  const PropagationResult result = propagate(scene, progress);
  return {summary_json(result), exit_code(result), failure_of(result)};
}

ItemOutcome outcome_of(const StudyReport& report) {
  return {report.summary(), report.exit_code, report.failure};
}

ItemOutcome run_any(const Study& study, const ProgressCallback& progress) {
  return std::visit(
      [&](const auto& scene) {
        if constexpr (std::is_same_v<std::decay_t<decltype(scene)>, Scene>) {
          return run_flow_jet(scene, progress);
        } else {
          return outcome_of(study_report(run_study(scene, progress), Figure::left_out));
        }
      },
      study);
}

ItemOutcome run_command(const SweepStudy& study, std::size_t item,
                        const ProgressCallback& progress) {
  const std::string file = study.scene_path.string();
  const bool is_run = study.command == "run";
  Study subject = parse_study(study.scene_text, file, sweep_overrides(study, item),
                              is_run ? SceneUnits::told : SceneUnits::chiefs);
  if (is_run) return run_any(subject, progress);
  const Scene scene = require_flow_jet(std::move(subject), file);
  const StudyDescription& described = study_of_command(study.command, scene);
  require_scene_of(described, scene, file);
  StudyWork work{progress};
  work.origin.gnuplot = "";
  return outcome_of(described.study(scene, work).report());
}

/// The element of a list: by its index, or by its label as with --set; none beyond the end.
const nlohmann::json* element(const nlohmann::json& list, const std::string& name,
                              bool& is_name_right) {
  for (const nlohmann::json& entry : list) {
    if (entry.is_object() && entry.value("label", nlohmann::json()) == name) return &entry;
  }
  const auto index = whole_number<std::size_t>(name);
  is_name_right = index.has_value();
  return index && *index < list.size() ? &list[*index] : nullptr;
}

[[noreturn]] void throw_astray(const SweepColumn& column, const nlohmann::json& place,
                               const std::string& name) {
  std::vector<std::string> names;
  if (place.is_object()) {
    for (const auto& entry : place.items()) names.push_back(entry.key());
  }
  const std::string hint = place.is_object() ? "; " + suggestion(name, {names.begin(), names.end()})
                           : place.is_array()
                               ? ", where there is a list: must be an index from 0 or a label"
                               : ", where there is a value already";
  throw Error(ErrorKind::scene, fmt::format("leads nowhere in summary.json, got {} in {}{}",
                                            in_quotes(name), in_quotes(column.pointer), hint));
}

SweepValue value_at(const nlohmann::json& summary, const SweepColumn& column) {
  std::vector<std::string> names;
  for (nlohmann::json::json_pointer pointer(column.pointer); !pointer.empty(); pointer.pop_back()) {
    names.insert(names.begin(), pointer.back());
  }
  const nlohmann::json* place = &summary;
  for (const std::string& name : names) {
    if (place->is_null()) return {};
    bool is_name_right = true;
    const nlohmann::json* next = nullptr;
    if (place->is_array()) {
      next = element(*place, name, is_name_right);
      if (next == nullptr && is_name_right) return {};
    } else if (place->is_object() && place->contains(name)) {
      next = &(*place)[name];
    }
    if (next == nullptr) throw_astray(column, *place, name);
    place = next;
  }
  if (place->is_null()) return {};
  if (place->is_boolean()) return place->get<bool>();
  if (place->is_number()) return place->get<double>();
  if (place->is_string()) return place->get<std::string>();
  throw Error(
      ErrorKind::scene,
      fmt::format("is {} in summary.json, got {}, must be a number, a text or a truth value",
                  place->is_array() ? "a list" : "an object", in_quotes(column.pointer)));
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  if (from.empty()) return;
  for (std::size_t i = text.find(from); i != std::string::npos;
       i = text.find(from, i + to.size())) {
    text.replace(i, from.size(), to);
  }
}

/// The error's line as it is wherever the sweep runs: with paths as from the study's folder.
std::string portable_text(const SweepStudy& study, std::string text) {
  replace_all(text, printable_path(study.scene_path), printable(study.scene, std::string::npos));
  // Other files that the scene names are found beside it.
  const auto folder_of = [](const std::filesystem::path& path) {
    return path.has_parent_path() ? printable_path(path.parent_path()) + "/" : std::string();
  };
  const std::string there = folder_of(study.scene_path);
  const std::string here = folder_of(study.scene);
  if (there == here) return text;
  if (text.starts_with(there)) text.replace(0, there.size(), here);
  replace_all(text, " " + there, " " + here);
  return text;
}

/// A line of an item's errors as one of the study's: what `--set key` is becomes the place of the
/// key.
std::string study_line(const SweepStudy& study, const std::string& line) {
  const auto replaced = [&](const std::string& key, const std::string& place) {
    const std::string head = override_source(key);
    if (!line.starts_with(head)) return std::string();
    return fmt::format("{}: {}{}", place, printable(key), line.substr(head.size()));
  };
  std::string message = line;
  for (const SweepKey& key : study.keys) {
    if (const std::string other = replaced(key.name, key.place); !other.empty()) message = other;
  }
  for (std::size_t i = 0; i < study.constants.size(); ++i) {
    const std::string other = replaced(study.constants[i].key, study.constant_places[i]);
    if (!other.empty()) message = other;
  }
  return message;
}

/// A mistake of an item is one of the study's.
Error study_error(const SweepStudy& study, const Error& error) {
  std::istringstream text(error.what());
  std::string message;
  for (std::string line; std::getline(text, line);) {
    message += (message.empty() ? "" : "\n") + study_line(study, line);
  }
  const bool is_usage = error.kind() == ErrorKind::usage;
  return {is_usage ? ErrorKind::scene : error.kind(), message};
}

/// The exception that is being handled, as the row of its item.
void take_failure(const SweepStudy& study, SweepRow& row) {
  try {
    throw;
  } catch (const Error& error) {
    const bool is_usage =
        error.kind() == ErrorKind::usage;  // an override was wrong, which is a mistake in the study
    row.exit_code = is_usage ? static_cast<int>(ErrorKind::scene) : error.exit_code();
    row.error = portable_text(study, error.what());
    replace_all(row.error, "\n", "; ");  // a row is a line
  } catch (const std::bad_alloc&) {
    row.exit_code = static_cast<int>(ErrorKind::too_large);
    row.error = "out of memory";
  } catch (const std::exception& error) {
    row.exit_code = static_cast<int>(ErrorKind::numerical);
    row.error = printable(error.what(), 300);
  }
}

}  // namespace

SweepRow run_sweep_item(const SweepStudy& study, std::size_t item,
                        const ProgressCallback& progress) {
  SweepRow row{item, 0, "", std::vector<SweepValue>(study.columns.size())};
  ItemOutcome outcome;
  bool is_stopped = false;
  try {
    outcome = run_command(study, item, [&](const std::string& task, double fraction) {
      is_stopped = true;
      if (progress) progress(task, fraction);
      is_stopped = false;
    });
  } catch (...) {
    if (is_stopped) throw;
    take_failure(study, row);
    return row;
  }
  row.exit_code = outcome.exit_code;
  row.error = portable_text(study, outcome.failure);
  const nlohmann::json summary = nlohmann::json::parse(outcome.summary);
  for (std::size_t c = 0; c < study.columns.size(); ++c) {
    const SweepColumn& column = study.columns[c];
    try {
      row.values[c] = value_at(summary, column);
    } catch (const Error& error) {
      row.exit_code = error.exit_code();
      row.error = fmt::format("column {}: {}", column.name, error.what());
      row.astray = fmt::format("{}: {}", column.place, error.what());
    }
  }
  return row;
}

void check_sweep_items(const SweepStudy& study) {
  const std::size_t last = study.items.size() - 1;
  std::optional<Error> first_error;
  for (const std::size_t item : {std::size_t{0}, last / 2, last}) {
    try {
      const std::string file = study.scene_path.string();
      Study subject = parse_study(study.scene_text, file, sweep_overrides(study, item));
      if (study.command == "run") return;
      const Scene scene = require_flow_jet(std::move(subject), file);
      require_scene_of(study_of_command(study.command, scene), scene, file);
      return;
    } catch (const Error& error) {
      if (!first_error) first_error = error;
    }
  }
  throw study_error(study, *first_error);
}

}  // namespace hamjet::io
