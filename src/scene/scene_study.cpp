#include <algorithm>
#include <functional>

#include "../studies/descriptions/system_description.hpp"
#include "../studies/sunlight.hpp"
#include "../text/scene_message.hpp"
#include "default_integrator.hpp"
#include "document/scene_document.hpp"
#include "document/scene_text.hpp"
#include "hamjet/error.hpp"
#include "scene_name.hpp"
#include "scene_sections.hpp"
#include "starts/scene_of_conjunction.hpp"
#include "study_reader.hpp"
#include "systems/scene_earth.hpp"
#include "tables_of_studies.hpp"

namespace hamjet::io {
namespace {

const SceneKey study_key = {"study",
                            form::choice({"flow-jet", "canonical-transformation",
                                          "energy-conservation", "optimal-control"}),
                            absent::value("flow-jet"),
                            "what is computed; the other three studies are those of the paper"};

SceneKey required_table(std::string_view name, const TableDescription& table,
                        std::string_view help) {
  return {name, form::table(table), absent::refused(), help};
}

SceneKey optional_table(std::string_view name, const TableDescription& table,
                        std::string_view absence, std::string_view help) {
  return {name, form::table(table), absent::other(std::string(absence)), help};
}

/// The tables of every study that has a model.
std::vector<SceneKey> start_keys() {
  return {
      required_table("system", system_table(), "the dynamics"),
      optional_table(
          "units", units_table(), "the nominal's initial distance",
          "unit of length of an orbit, whose mu is 1; other models have metre, second, kilogram"),
      required_table("nominal", nominal_table(), "the initial state")};
}

std::vector<SceneKey> keys_of_studies() {
  std::vector<SceneKey> keys;
  for (const TableOfStudy& study : tables_of_studies()) {
    keys.push_back(optional_table(study.name, study.description(), study.absence, study.help));
  }
  return keys;
}

TableDescription flow_jet_top() {
  constexpr std::string_view none = "none";
  return {joined<SceneKey>(
      {head_keys(),
       {{"precision", form::choice({"double", "extended"}), absent::value("double"),
         "extended: the whole chain with 113 significant bits"}},
       start_keys(),
       {required_table("jet", jet_table(), "the Taylor polynomials of the flow"),
        {"integrator",
         form::words(fmt::format("1 to {} tables", most_integrators),
                     form::array(form::table(integrator_table()))),
         absent::other(default_integrator_text()), "how the jet is integrated"},
        optional_table("formation", formation_table(), none,
                       "residuals are also stated at this deviation"),
        optional_table("generating_function", generating_function_table(), none,
                       "the inverted maps"),
        optional_table("reference", reference_table(), "none, and errors are null",
                       "what errors refer to"),
        optional_table("relative_hamiltonian", relative_hamiltonian_table(), none,
                       "Taylor coefficients of H about the nominal"),
        optional_table("checks", checks_table(), "all on", "self-checks"),
        optional_table("compare", compare_table(), "the defaults", "what `hamjet compare` tries"),
        optional_table("figure", figure_table(), none, "`figure.svg`, with its numbers in CSV"),
        optional_table("spacecraft", spacecraft_table(), "no drag, no radiation",
                       "what air and light do to the chief"),
        optional_table("deputy", deputy_table(), none,
                       "the second spacecraft, for `hamjet motion`, `transfer` and `eval`"),
        optional_table("transfer", transfer_table(), none,
                       "what `hamjet transfer` and `assign` work on"),
        optional_table("thruster", thruster_table(), none,
                       "what burns in `hamjet transfer` and `hamjet bounded`"),
        optional_table("validity", validity_table(), none,
                       "what `hamjet validity` works on, and `transfer` too"),
        optional_table("assignment", assignment_table(), none, "what `hamjet assign` works on"),
        optional_table("uncertainty", uncertainty_table(), none,
                       "what `hamjet uncertainty` works on")},
       keys_of_studies(),
       {optional_table("output", output_table(), "CSV and JSON", "further files of results"),
        optional_table("ephemeris", ephemeris_table(), "of the nominal's file",
                       "what dates an orbit"),
        optional_table("case", case_table(), none, "what `hamjet stability` works on"),
        study_key}})};
}

/// A study of the paper on a model: its own table, beside the tables of the model.
TableDescription paper_top(std::string_view name, const TableDescription& table) {
  return {joined<SceneKey>(
      {head_keys(), start_keys(), {required_table(name, table, "the study"), study_key}})};
}

TableDescription energy_conservation_top() {
  TableDescription top = paper_top("energy_conservation", energy_conservation_table());
  // These tables are refused with a reason, not as unknown keys.
  for (const std::string_view key : {"jet", "integrator"}) {
    top.keys.push_back({key, {}, absent::refused(), {}, {"flow-jet"}});
  }
  return top;
}

/// Whether the model is an orbit or another model, as owner of keys; empty if the model is not
/// known.
std::vector<std::string_view> kind_of_model(const toml::table& scene) {
  const auto name = scene.at_path("system.model").value<std::string_view>();
  for (const SystemDescription& system : all_systems()) {
    if (name != system.name) continue;
    if (system.model == SystemModel::own) return {system.name};
    return {is_orbit(system.model) ? orbits : other_models};
  }
  return {};
}

/// Keeps the errors of a scene whose key `study` is misspelt. The tables that are right depend on
/// the study, so that only keys that no study has are reported.
void attempt_misspelt_study(const TableReader& root, const toml::table& scene) {
  const bool is_misspelt = std::any_of(scene.begin(), scene.end(), [](const auto& entry) {
    return nearest(entry.first.str(), {study_key.name}).has_value();
  });
  if (root.has(study_key.name) || !is_misspelt) return;
  std::vector<std::string_view> names;
  for (const StudyTables& study : all_studies()) {
    names = joined<std::string_view>({names, study.top.names()});
  }
  root.attempt([&] { root.check_keys({.keys = names}); });
}

/// The tables of a study with a known index in all_studies(). The paper's studies are computed, and
/// their results given, in the units that the scene asks for.
Study read_tables(const TableReader& root, std::size_t study, SceneUnits units) {
  // The readers are in the order of all_studies().
  const std::function<Study(const TableReader&)> readers[] = {
      [&](const TableReader& tables) {
        Scene scene = read_flow_jet(tables, units);
        set_span_of_earth(tables, scene);
        return scene;
      },
      read_canonical_transformation, read_energy_conservation, read_optimal_control};
  const auto& [name, top] = all_studies()[study];
  root.attempt([&] {
    root.check_keys({.keys = top.names_of(name), .refused_by_caller = top.names_not_of(name)});
  });
  Study result;
  root.attempt([&] { result = readers[study](root); });
  return result;
}

}  // namespace

const std::vector<SceneKey>& head_keys() {
  static const std::vector<SceneKey> keys = {
      {"schema", form::integer(1, 1), absent::value(1), "version of this format"},
      {"title", form::text(), absent::other("the file's name without `.toml`"),
       "title of the results"}};
  return keys;
}

const std::vector<StudyTables>& all_studies() {
  static const std::vector<StudyTables> studies = [] {
    const auto& names = study_key.form.choices;
    return std::vector<StudyTables>{
        {names[0], flow_jet_top()},
        {names[1], paper_top("canonical_transformation", canonical_transformation_table())},
        {names[2], energy_conservation_top()},
        {names[3],
         {joined<SceneKey>({head_keys(),
                            {study_key, required_table("optimal_control", optimal_control_table(),
                                                       "the study")}})}}};
  }();
  return studies;
}

std::string scene_name(const std::string& file_name) {
  if (file_name == standard_input_name) return "standard-input";
  std::string name = std::filesystem::path(file_name).stem().string();
  for (char& c : name) {
    const bool allowed = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                         (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
    if (!allowed) c = '_';
  }
  name.erase(0, name.find_first_not_of('.'));
  return name.empty() ? "scene" : name;
}

std::string default_title(const std::string& file_name) {
  const std::string stem = std::filesystem::path(file_name).stem().string();
  return stem.empty() ? "scene" : printable(stem);
}

Study parse_study(std::string_view text, const std::string& file_name,
                  const std::vector<Override>& overrides, SceneUnits units) {
  std::string name = printable(file_name, std::string::npos);
  std::string of_message;
  if (is_conjunction_message(text)) {
    of_message = scene_of_conjunction(text, file_name, overrides);
    text = of_message;
    name += ", as a scene";
  }
  SceneDocument document = parse_document(text, name, overrides, default_integrator_table());
  document.source.folder = std::filesystem::path(file_name).parent_path();
  return read_document(document, file_name, units);
}

Study read_document(const SceneDocument& document, const std::string& file_name, SceneUnits units) {
  SceneErrors errors;
  const std::vector<std::string> no_warnings;
  const auto reader_of = [&](std::size_t study) {
    return TableReader(document.table, "", document.source, &all_studies()[study].top, &errors);
  };
  std::size_t number = 0;
  if (document.table.contains("study")) number = reader_of(0).choice("study");
  const TableReader root = reader_of(number);
  // A newer schema may have other keys, so that its number is checked first.
  if (root.has("schema")) root.integer("schema");
  attempt_misspelt_study(root, document.table);
  if (!errors.empty()) errors.raise(document.source.name, no_warnings);
  Study study = read_tables(root, number, units);
  std::string title = default_title(file_name);
  root.attempt([&] { root.read_if_any("title", title); });
  if (Scene* const scene = std::get_if<Scene>(&study)) {
    const std::vector<std::string>& more = errors.warnings();
    scene->warnings.insert(scene->warnings.end(), more.begin(), more.end());
  }
  // The title stands at the head of tables and pages.
  title = printable(title, std::string::npos);
  if (!errors.empty()) {
    root.attempt_declared_keys(kind_of_model(document.table));
    const Scene* const scene = std::get_if<Scene>(&study);
    errors.raise(document.source.name, scene != nullptr ? scene->warnings : no_warnings);
  }
  std::visit(
      [&](auto& scene) {
        scene.name = scene_name(file_name);
        scene.title = title;
      },
      study);
  if (Scene* const scene = std::get_if<Scene>(&study)) {
    const std::vector<std::string> decays = warnings_of_decay(root, *scene);
    scene->warnings.insert(scene->warnings.end(), decays.begin(), decays.end());
    try {
      light_nominal(*scene);
    } catch (const Error& error) {
      // That an orbit decays is why its light cannot be followed to the end.
      if (scene->warnings.empty()) throw;
      throw Error(error.kind(),
                  fmt::format("{}\n{}", error.what(), fmt::join(scene->warnings, "\n")));
    }
  }
  return study;
}

Study read_study(const std::filesystem::path& file, const std::vector<Override>& overrides,
                 SceneUnits units) {
  return parse_study(read_scene_file(file), file.string(), overrides, units);
}

Scene require_flow_jet(Study study, const std::string& file_name) {
  if (Scene* scene = std::get_if<Scene>(&study)) return std::move(*scene);
  throw Error(ErrorKind::scene,
              printable(file_name, std::string::npos) +
                  ": study: has no flow jet, which this command works on; `hamjet run` runs this "
                  "scene");
}

Scene parse_scene(std::string_view text, const std::string& file_name,
                  const std::vector<Override>& overrides, SceneUnits units) {
  return require_flow_jet(parse_study(text, file_name, overrides, units), file_name);
}

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides,
                 SceneUnits units) {
  return parse_scene(read_scene_file(file), file.string(), overrides, units);
}

}  // namespace hamjet::io
