#include <functional>

#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "scene_document.hpp"
#include "scene_name.hpp"
#include "scene_sections.hpp"
#include "scene_text.hpp"
#include "study_reader.hpp"

namespace hamjet::io {
namespace {

/// A study's name in scenes, its keys at the top level, and what reads them.
struct StudyReader {
  std::string_view name;
  std::vector<std::string_view> keys;
  std::function<Study(const TableReader&)> read;
};

const std::vector<StudyReader>& studies() {
  static const std::vector<StudyReader> readers = {
      {"flow-jet",
       {"schema",    "title",
        "precision", "system",
        "units",     "nominal",
        "jet",       "integrator",
        "formation", "generating_function",
        "reference", "relative_hamiltonian",
        "checks",    "compare",
        "figure",    "transfer",
        "validity",  "assignment",
        "output",    "ephemeris",
        "case",      "study"},
       read_flow_jet},
      {"canonical-transformation",
       {"schema", "title", "system", "units", "nominal", "canonical_transformation", "study"},
       read_canonical_transformation},
      {"energy-conservation",
       {"schema", "title", "system", "units", "nominal", "energy_conservation", "study", "jet",
        "integrator"},
       read_energy_conservation},
      {"optimal-control", {"schema", "title", "study", "optimal_control"}, read_optimal_control},
  };
  return readers;
}

Study read_tables(const TableReader& root) {
  std::vector<std::string_view> names;
  for (const StudyReader& study : studies()) names.push_back(study.name);
  const StudyReader& study = studies()[root.has("study") ? root.choice("study", names) : 0];
  // A newer schema may have other keys, so that its number comes before theirs; but a misspelt
  // `schema` is named.
  if (!root.has("schema")) root.check_keys({study.keys});
  root.integer_between("schema", 1, 1);
  root.check_keys({study.keys});
  return study.read(root);
}

}  // namespace

std::string scene_name(const std::string& file_name) {
  std::string name = std::filesystem::path(file_name).stem().string();
  for (char& c : name) {
    const bool allowed = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                         (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
    if (!allowed) c = '_';
  }
  name.erase(0, name.find_first_not_of('.'));
  return name.empty() ? "scene" : name;
}

Study parse_study(std::string_view text, const std::string& file_name,
                  const std::vector<Override>& overrides) {
  SceneDocument document = parse_document(text, printable(file_name, std::string::npos), overrides);
  document.source.folder = std::filesystem::path(file_name).parent_path();
  return read_document(document, file_name);
}

Study read_document(const SceneDocument& document, const std::string& file_name) {
  Study study = read_tables(TableReader(document.table, "", document.source));
  std::visit([&](auto& scene) { scene.name = scene_name(file_name); }, study);
  return study;
}

Study read_study(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  return parse_study(read_scene_file(file), file.string(), overrides);
}

Scene require_flow_jet(Study study, const std::string& file_name) {
  if (Scene* scene = std::get_if<Scene>(&study)) return std::move(*scene);
  throw Error(ErrorKind::scene,
              printable(file_name, std::string::npos) +
                  ": study: has no flow jet, which this command works on; `hamjet run` runs this "
                  "scene");
}

Scene parse_scene(std::string_view text, const std::string& file_name,
                  const std::vector<Override>& overrides) {
  return require_flow_jet(parse_study(text, file_name, overrides), file_name);
}

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  return parse_scene(read_scene_file(file), file.string(), overrides);
}

}  // namespace hamjet::io
