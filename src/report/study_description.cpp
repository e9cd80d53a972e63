#include "study_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>

#include "../studies/arcs.hpp"
#include "../studies/bounded/bounded_formation.hpp"
#include "../studies/bounded/event_study.hpp"
#include "../studies/bounded/frozen_orbit_study.hpp"
#include "../studies/flights/manoeuvred_flight.hpp"
#include "../studies/formation/charts/free_coordinates.hpp"
#include "../studies/formation/deputy_motion.hpp"
#include "../studies/formation/formation_problem.hpp"
#include "../studies/periodic/periodic_study.hpp"
#include "../studies/uncertainty/uncertainty.hpp"
#include "../text/scene_message.hpp"
#include "../text/scene_refusal.hpp"
#include "bounded/bounded_report.hpp"
#include "bounded/event_report.hpp"
#include "bounded/frozen_orbit_report.hpp"
#include "declared_tables.hpp"
#include "formation/assignment_tables.hpp"
#include "formation/deputy_motion_report.hpp"
#include "formation/transfer_tables.hpp"
#include "formation/validity_table.hpp"
#include "hamjet/error.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "periodic/periodic_report.hpp"
#include "uncertainty/moments_table.hpp"
#include "uncertainty/uncertainty_report.hpp"

namespace hamjet::io {
namespace {

/// Whether a scene has a table, by the member that holds it.
template <auto member>
bool has(const Scene& scene) {
  return (scene.*member).has_value();
}

/// A study, with the functions that make report and tables of its result.
template <auto study, auto report, auto tables>
DoneStudy done(const Scene& scene, const StudyWork& work) {
  auto result = study(scene, work.progress);
  const auto kept = std::make_shared<const decltype(result)>(std::move(result));
  return {[kept, origin = work.origin] { return report(*kept, origin); },
          [kept] { return tables(*kept); }};
}

DoneStudy uncertainty_done(const Scene& scene, const StudyWork& work) {
  const auto kept = std::make_shared<const UncertaintyResult>(
      study_uncertainty(scene, work.progress, work.threads));
  return {[kept, origin = work.origin] { return uncertainty_report(*kept, origin); },
          [kept] { return uncertainty_tables(*kept); }};
}

TransferResult transfers_of(const Scene& scene, const ProgressCallback& progress) {
  return study_transfer(scene, progress);
}

template <class Result>
std::vector<TableView> tables_without_rows(std::vector<TableView> (*tables)(const Result&),
                                           auto member) {
  Result result;
  result.scene = declaring_scene();
  (result.scene.*member).emplace();
  return tables(result);
}

/// The tables of a result that has nothing but the scene's table.
template <auto member, auto tables>
std::vector<TableView> declared() {
  return tables_without_rows(tables, member);
}

bool is_zero(const RelativeState& state) {
  return state.position_m.isZero(0) && state.velocity_m_s.isZero(0);
}

/// An assignment may have a table [transfer] with no places in it.
std::string lack_of_transfer(const Scene& scene) {
  const bool has_end = !scene.transfer->end.is_along_axes() || !is_zero(scene.transfer->end);
  if (!scene.assignment || !is_zero(scene.transfer->start) || has_end) return "";
  return "transfer.start: missing, must be a table with position_m, as must transfer.end; "
         "`hamjet assign` works on this scene's deputies and slots";
}

/// What the smallest table of the study holds. For a system that the scene writes it has as many
/// numbers as that has coordinates, and the scene's own duration.
std::string smallest_table(const StudyDescription& study, const Scene& scene) {
  const bool is_own = scene.system.model == SystemModel::own;
  if (is_own && study.table == "event") {
    return fmt::format("surface = \"expression\", expression = \"{}\"",
                       variable_names(scene.system)[0]);
  }
  std::string zeros, ones;
  for (std::size_t i = 1; i < told_coordinates(scene.system); ++i) {
    zeros += ", 0";
    ones += ", 0.01";
  }
  if (is_own && study.table == "uncertainty") {
    return fmt::format("position_m = [0.01{0}], velocity_m_s = [0.01{0}]", ones);
  }
  if (!is_own || study.table != "transfer") return std::string(study.smallest);
  return fmt::format(
      "times_canonical = [{:g}], start = {{position_m = [0.01{}]}}, end = {{position_m = [0{}]}}",
      scene.duration, zeros, zeros);
}

constexpr StudyDescription descriptions[] = {
    {.command = "motion",
     .purpose = "where the deputy goes relative to its chief, and how wrong this is",
     .files = "report.html, motion.csv and summary.json",
     .example = "where the second satellite goes; a report",
     .table = "deputy",
     .smallest = "position_m = [0, -1000, 0]",
     .has_table = &has<&Scene::deputy>,
     .study = &done<&study_deputy_motion, &deputy_motion_report, &deputy_motion_tables>,
     .declared = &declared_motion,
     .notes_escape = true,
     .flies_manoeuvres = true,
     .needs_orbit = true},
    {.command = "transfer",
     .purpose = "velocity changes from one relative position to another, for every time",
     .files = "report.html, figure.svg, transfers.csv, further CSV files and summary.json",
     .example = "velocity changes between relative positions; a report",
     .table = "transfer",
     .smallest = "times_s = [1200, 1800], start = {position_m = [0, -1000, 0]}, "
                 "end = {position_m = [0, -100, 0]}",
     .has_table = &has<&Scene::transfer>,
     .study = &done<&transfers_of, &flown_transfer_report, &transfer_tables>,
     .declared = &declared_transfer,
     .notes_escape = true,
     .lack = &lack_of_transfer},
    {.command = "validity",
     .purpose = "how far from the chief the polynomials are right, along time",
     .files = "report.html, validity.csv, split_domains.csv beside separation_m and summary.json",
     .example = "how far from the chief the polynomials are right",
     .table = "validity",
     .smallest = "tolerance_m = 1, count = 12",
     .has_table = &has<&Scene::validity>,
     .study = &done<&study_validity, &validity_report, &validity_tables>,
     .declared = &declared_validity},
    {.command = "uncertainty",
     .purpose = "how the covariance of the start grows: moments of every order along time",
     .files = "report.html, moments.csv and summary.json",
     .example = "how a covariance grows, to every order; a report",
     .table = "uncertainty",
     .smallest = "position_m = [100, 100, 100], velocity_m_s = [0.1, 0.1, 0.1]",
     .has_table = &has<&Scene::uncertainty>,
     .study = &uncertainty_done,
     .declared = &declared_uncertainty},
    {.command = "assign",
     .purpose = "send deputies to slots at the least total velocity change",
     .files = "assignment.csv, costs.csv, pairs.csv and summary.json",
     .example = "deputies to slots at the least total velocity change",
     .table = "assignment",
     .smallest = "deputy = [{position_m = [0, -100, 0]}], slot = [{position_m = [0, 100, 0]}]",
     .has_table = &has<&Scene::assignment>,
     .study = &done<&study_assignment, &assignment_report, &assignment_tables>,
     .declared = &declared_assignment,
     .notes_escape = true,
     .needs_orbit = true},
    {.command = "poincare",
     .purpose = "the frozen orbit of the chief's energy, and what turns about it; or a scene's "
                "[event] as polynomials",
     .files = "report.html, poincare.csv (with [event]: event.csv, event-map.csv) and summary.json",
     .example = "the frozen orbit, and what turns about it",
     .table = "event",
     .smallest = "surface = \"equator\"",
     .has_table = &has<&Scene::event>,
     .study = &done<&study_event, &event_report, &event_tables>,
     .declared = &declared_event},
    {.command = "poincare",
     .has_table = [](const Scene&) { return true; },
     .study = &done<&study_frozen_orbit, &frozen_orbit_report, &poincare_tables>,
     .declared = &declared_frozen_orbit,
     .needs_orbit = true},
    {.command = "bounded",
     .purpose = "deputies that stay with the chief for long without fuel",
     .files = "report.html, bounded.csv, box.csv of a box, summary.json",
     .example = "deputies that stay for months without fuel; a report",
     .table = "bounded",
     .smallest = "sizes_km = [1, 10]",
     .has_table = &has<&Scene::bounded>,
     .study = &done<&study_bounded, &bounded_report, &bounded_tables>,
     .declared = &declared_bounded,
     .needs_orbit = true},
    {.command = "periodic",
     .purpose = "periodic orbits near the nominal, their multipliers, and their families",
     .files = "report.html, periodic.csv and summary.json",
     .example = "periodic orbits and their families; a report",
     .table = "periodic",
     .smallest = "hold = \"energy\"",
     .has_table = &has<&Scene::periodic>,
     .study = &done<&study_periodic, &periodic_report, &periodic_tables>,
     .declared = &declared<&Scene::periodic, &periodic_tables>},
};

}  // namespace

std::span<const StudyDescription> study_descriptions() { return descriptions; }

std::vector<std::string_view> study_commands() {
  std::vector<std::string_view> commands;
  for (const StudyDescription& study : descriptions) {
    if (commands.empty() || commands.back() != study.command) commands.push_back(study.command);
  }
  return commands;
}

const StudyDescription& first_study_of(std::string_view command) {
  return *std::find_if(std::begin(descriptions), std::end(descriptions),
                       [&](const StudyDescription& study) { return study.command == command; });
}

const StudyDescription& study_of_command(std::string_view command, const Scene& scene) {
  const StudyDescription* found = &first_study_of(command);
  for (const StudyDescription& study : descriptions) {
    if (study.command != command) continue;
    found = &study;
    if (study.has_table(scene)) break;
  }
  return *found;
}

const StudyDescription& study_of_table(std::string_view table) {
  return *std::find_if(std::begin(descriptions), std::end(descriptions),
                       [&](const StudyDescription& study) { return study.table == table; });
}

std::vector<const StudyDescription*> studies_of(const Scene& scene) {
  std::vector<const StudyDescription*> studies;
  for (const StudyDescription& study : descriptions) {
    const bool has_table = !study.table.empty() && study.has_table(scene);
    const bool is_served = study.flies_manoeuvres || !has_manoeuvres(scene);
    if (has_table && is_served && (study.lack == nullptr || study.lack(scene).empty()))
      studies.push_back(&study);
  }
  return studies;
}

std::vector<std::string_view> commands_of(const Scene& scene) {
  std::vector<std::string_view> commands;
  if (!has_manoeuvres(scene)) commands.emplace_back("run");
  for (const StudyDescription* study : studies_of(scene)) commands.push_back(study->command);
  return commands;
}

void require_table(const StudyDescription& study, const Scene& scene, const std::string& file) {
  const std::string name = printable(file, std::string::npos);
  if (study.needs_orbit && !is_orbit(scene.system.model)) {
    // Without an orbit the command may have another study, which lacks its table.
    for (const StudyDescription& other : descriptions) {
      if (other.command != study.command || other.needs_orbit || other.has_table(scene)) continue;
      return require_table(other, scene, file);
    }
    throw Error(ErrorKind::scene,
                fmt::format("{}: system.model: `hamjet {}` is about orbits, got \"{}\", must be "
                            "\"earth\", \"zonal-gravity\" or \"kepler\"; {}",
                            name, study.command, model_name(scene.system.model),
                            scene.system.model == SystemModel::own
                                ? studies_of_own_systems
                                : "other models have `hamjet run` and `hamjet periodic`"));
  }
  if (!study.has_table(scene)) {
    throw Error(
        ErrorKind::scene,
        fmt::format("{0}: {1}: missing, must be a table [{1}]; the smallest is {1} = {{{2}}}", name,
                    study.table, smallest_table(study, scene)));
  }
  const std::string lack = study.lack != nullptr ? study.lack(scene) : "";
  if (!lack.empty()) throw Error(ErrorKind::scene, fmt::format("{}: {}", name, lack));
}

void require_scene_of(const StudyDescription& study, const Scene& scene, const std::string& file) {
  naming_file(file, [&] { require_unsplit(scene, fmt::format("hamjet {}", study.command)); });
  require_table(study, scene, file);
}

}  // namespace hamjet::io
