#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "../dynamics/celestial_bodies.hpp"
#include "../scene/starts/scene_elements.hpp"
#include "../scene/tables/table_description.hpp"
#include "../studies/descriptions/system_description.hpp"
#include "../text/scene_message.hpp"
#include "bindings.hpp"

// What hamjet.orbit takes as keywords, from what the tables of a scene declare.

namespace hamjet::python {
namespace {

namespace py = pybind11;

/// A key that belongs to every scene, or to orbits alone.
bool is_of_orbits(const io::SceneKey& key) {
  const auto names_orbit = [](std::string_view owner) {
    return owner == io::orbits ||
           std::any_of(all_systems().begin(), all_systems().end(),
                       [&](const SystemDescription& s) { return s.is_orbit && s.name == owner; });
  };
  return key.owners.empty() || std::any_of(key.owners.begin(), key.owners.end(), names_orbit);
}

/// A table whose keys are keywords, and the table itself at the top of the scene.
struct KeywordTable {
  std::string_view name = {};  ///< empty: the top
  std::vector<const io::SceneKey*> keys = {};

  std::vector<std::string_view> names() const {
    std::vector<std::string_view> result;
    for (const io::SceneKey* key : keys) result.push_back(key->name);
    return result;
  }
};

void add_keys(KeywordTable& table, const io::TableDescription& description) {
  for (const io::SceneKey& key : description.keys) {
    const auto names = table.names();
    const bool is_new = std::find(names.begin(), names.end(), key.name) == names.end();
    if (is_new && is_of_orbits(key)) table.keys.push_back(&key);
  }
}

/// The tables without which no scene of a flow's jet is, and the top with the others as a whole.
std::vector<KeywordTable> orbit_tables() {
  std::vector<KeywordTable> tables(1);
  for (const io::SceneKey& key : io::all_studies().front().top.keys) {
    const bool is_needed =
        key.form.table != nullptr && key.absence.meaning == io::Absence::Meaning::refused;
    if (!is_needed) {
      tables.front().keys.push_back(&key);
    } else {
      add_keys(tables.emplace_back(KeywordTable{key.name}), *key.form.table);
    }
  }
  // Messages list so many names and no more: those of the field, most of which are alike, come
  // last.
  std::stable_sort(tables.begin(), tables.end(),
                   [](const auto& a, const auto& b) { return a.keys.size() < b.keys.size(); });
  return tables;
}

/// All keywords: the name of each, its table ("" for the top of the scene), and what it means.
std::vector<std::tuple<std::string, std::string, std::string>> orbit_keys() {
  std::vector<std::tuple<std::string, std::string, std::string>> keys;
  for (const KeywordTable& table : orbit_tables()) {
    for (const io::SceneKey* key : table.keys) keys.emplace_back(key->name, table.name, key->help);
  }
  return keys;
}

/// The table of a keyword, "" for the top: of a misspelt one that whose reader will say what was
/// meant. Throws Error(scene) for one that is like no other.
std::string table_of_keyword(const std::string& scene, const std::string& keyword) {
  const std::vector<KeywordTable> tables = orbit_tables();
  std::vector<std::string_view> all;
  for (const KeywordTable& table : tables) {
    const auto names = table.names();
    if (std::find(names.begin(), names.end(), keyword) != names.end()) {
      return std::string(table.name);
    }
    all.insert(all.end(), names.begin(), names.end());
  }
  const auto near = io::nearest(keyword, all);
  for (const KeywordTable& table : tables) {
    const auto names = table.names();
    const bool is_near = near && std::find(names.begin(), names.end(), *near) != names.end();
    if (is_near || io::remedy_for_foreign_key(table.name, keyword)) return std::string(table.name);
  }
  io::throw_scene_error(
      fmt::format("{}: {}", scene, io::printable(keyword)),
      fmt::format("unknown key, got {}, {}", io::printable(keyword), io::suggestion(keyword, all)));
}

/// The Earth's field without its zonal coefficients, as keys of [system].
py::dict earth_system() {
  const CelestialBody& earth = *body_named("EARTH");
  py::dict system;
  system["model"] = std::string(description_of(SystemModel::zonal_gravity).name);
  system["mu_km3_s2"] = earth.mu_km3_s2;
  system["radius_km"] = earth.equator_radius_km;
  return system;
}

/// The keys of elements of an orbit, and those of them that say the place.
std::pair<std::vector<std::string_view>, std::vector<std::string_view>> element_keys() {
  return {io::TableDescription{io::element_keys()}.names(), io::place_keys()};
}

}  // namespace

void bind_orbit_keys(py::module_& module) {
  module.def("orbit_keys", &orbit_keys);
  module.def("table_of_keyword", &table_of_keyword, py::arg("scene"), py::arg("keyword"));
  module.def("element_keys", &element_keys);
  module.def("earth_system", &earth_system);
}

}  // namespace hamjet::python
