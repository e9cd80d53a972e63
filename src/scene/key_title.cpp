#include "key_title.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "../text/whole_number.hpp"
#include "starts/scene_elements.hpp"
#include "tables/key_unit.hpp"

namespace hamjet::io {
namespace {

/// Tables of which a scene has only one and which concern the whole scene: their names would add
/// nothing to a title.
constexpr std::string_view unsaid_tables[] = {"nominal", "jet", "system"};

std::vector<std::string_view> parts_of(std::string_view key) {
  std::vector<std::string_view> parts;
  for (std::size_t end = 0; end != key.npos; key.remove_prefix(std::min(end + 1, key.size()))) {
    end = key.find('.');
    parts.push_back(key.substr(0, end));
  }
  return parts;
}

std::string in_words(std::string_view name) {
  std::string words(without_unit(name));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// Keys of elements are symbols; their help has the name in words.
std::string name_in_words(std::string_view name) {
  constexpr std::size_t longest_symbol = 4;
  if (without_unit(name).size() > longest_symbol) return in_words(name);
  for (const SceneKey& element : element_keys()) {
    if (element.name == name) return std::string(element.help.substr(0, element.help.find(',')));
  }
  return in_words(name);
}

}  // namespace

std::string key_title(std::string_view key) {
  std::vector<std::string_view> parts = parts_of(key);
  std::optional<std::size_t> index;
  if (parts.size() > 1) index = whole_number<std::size_t>(parts.back());
  if (index) parts.pop_back();
  const bool is_unsaid =
      parts.size() > 1 && std::find(std::begin(unsaid_tables), std::end(unsaid_tables),
                                    parts.front()) != std::end(unsaid_tables);
  std::string title;
  for (std::size_t i = is_unsaid ? 1 : 0; i + 1 < parts.size(); ++i) {
    title += in_words(parts[i]) + ' ';
  }
  title += name_in_words(parts.back());
  if (index) title += fmt::format(", component {}", *index + 1);
  const std::string_view unit = unit_of(parts.back());
  return unit.empty() ? title : fmt::format("{} ({})", title, unit);
}

}  // namespace hamjet::io
