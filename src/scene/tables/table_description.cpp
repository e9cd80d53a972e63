#include "table_description.hpp"

#include <algorithm>

namespace hamjet::io {
namespace {

template <class Condition>
std::vector<std::string_view> names_where(const std::vector<SceneKey>& keys,
                                          const Condition& condition) {
  std::vector<std::string_view> names;
  for (const SceneKey& key : keys) {
    const bool is_new = std::find(names.begin(), names.end(), key.name) == names.end();
    if (is_new && condition(key)) names.push_back(key.name);
  }
  return names;
}

void add_paths(const TableDescription& table, std::string_view name, const std::string& path,
               std::vector<std::string>& found) {
  for (const SceneKey& key : table.keys) {
    const std::string here = path + std::string(key.name);
    const bool is_new = std::find(found.begin(), found.end(), here) == found.end();
    if (key.name == name && is_new) found.push_back(here);
    if (key.form.table != nullptr) add_paths(*key.form.table, name, here + '.', found);
  }
}

}  // namespace

std::vector<std::string> paths_of_key(std::string_view name) {
  std::vector<std::string> found;
  add_paths(all_studies().front().top, name, "", found);
  return found;
}

bool SceneKey::belongs_to(std::string_view owner) const {
  return owners.empty() || std::find(owners.begin(), owners.end(), owner) != owners.end();
}

std::vector<std::string_view> TableDescription::names() const {
  return names_where(keys, [](const SceneKey&) { return true; });
}

std::vector<std::string_view> TableDescription::names_of(std::string_view owner) const {
  return names_where(keys, [&](const SceneKey& key) { return key.belongs_to(owner); });
}

std::vector<std::string_view> TableDescription::names_not_of(std::string_view owner) const {
  return names_where(keys, [&](const SceneKey& key) { return !key.belongs_to(owner); });
}

const SceneKey* TableDescription::find(std::string_view name) const {
  const auto key =
      std::find_if(keys.begin(), keys.end(), [&](const SceneKey& k) { return k.name == name; });
  return key != keys.end() ? &*key : nullptr;
}

}  // namespace hamjet::io
