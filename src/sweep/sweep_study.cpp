#include "sweep_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "../report/study_description.hpp"
#include "../scene/document/scene_document.hpp"
#include "../scene/document/scene_text.hpp"
#include "../scene/scene_name.hpp"
#include "../scene/tables/scene_table.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "hamjet/version.hpp"
#include "sweep_tables.hpp"
#include "sweep_values.hpp"

namespace hamjet::io {
namespace {

constexpr std::string_view grid_or_list =
    "one or more tables [[axis]] (a grid of all combinations) or [[item]] (a list)";

void add_key(SweepStudy& study, SweepKey key, const TableReader& table, std::string_view at) {
  const auto is_same = [&](const auto& other) { return other == key.name; };
  const bool is_constant =
      std::any_of(study.constants.begin(), study.constants.end(),
                  [&](const Override& constant) { return is_same(constant.key); });
  const bool is_there = std::any_of(study.keys.begin(), study.keys.end(),
                                    [&](const SweepKey& other) { return is_same(other.name); });
  if (is_constant || is_there) {
    table.fail(at, fmt::format("there twice, got {}, which {} gives already", in_quotes(key.name),
                               is_constant ? "sweep.set" : "another axis"));
  }
  // The columns of a grid's table would say what another key has changed.
  const auto is_within = [](std::string_view inner, const std::string& outer) {
    return inner.starts_with(outer + '.');
  };
  for (const SweepKey& other : study.keys) {
    if (study.is_grid && (is_within(other.name, key.name) || is_within(key.name, other.name))) {
      table.fail(
          at, fmt::format("a part of another key, got {} beside {}, must be a key of other values",
                          in_quotes(key.name), in_quotes(other.name)));
    }
  }
  study.keys.push_back(std::move(key));
}

void require_count(const TableReader& root, std::string_view key, double count,
                   std::size_t most_items) {
  if (count <= static_cast<double>(most_items)) return;
  throw Error(ErrorKind::too_large,
              fmt::format("{}: too many items, got {:.0f}, must be at most {}", root.head(key),
                          count, most_items));
}

/// Makes all combinations of the axes' values, the last axis changing fastest.
void read_grid(const TableReader& root, const toml::table& tables, std::size_t most_items,
               SweepStudy& study) {
  study.is_grid = true;
  study.items = {{}};
  const std::vector<TableReader> axes = root.tables("axis");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const toml::table& table = *(*tables.get_as<toml::array>("axis"))[i].as_table();
    const std::vector<std::string> values = axis_values(axes[i], table, most_items);
    SweepKey key{axes[i].text("key"), axes[i].has("spacing") && axes[i].choice("spacing") == 1,
                 axes[i].head("key")};
    if (key.name.empty()) axes[i].fail("key", "empty, must be a key such as nominal.e");
    add_key(study, std::move(key), axes[i], "key");
    require_count(root, "axis",
                  static_cast<double>(study.items.size()) * static_cast<double>(values.size()),
                  most_items);
    std::vector<std::vector<std::string>> items;
    items.reserve(study.items.size() * values.size());
    for (const auto& item : study.items) {
      for (const std::string& value : values) {
        items.push_back(item);
        items.back().push_back(value);
      }
    }
    study.items = std::move(items);
  }
}

void read_list(const TableReader& root, const toml::table& tables, std::size_t most_items,
               SweepStudy& study) {
  const std::vector<TableReader> readers = root.tables("item");
  const toml::array& array = *tables.get_as<toml::array>("item");
  require_count(root, "item", static_cast<double>(array.size()), most_items);
  for (std::size_t i = 0; i < array.size(); ++i) {
    std::vector<std::string>& item = study.items.emplace_back(study.keys.size());
    const auto keys = flat_keys(*array[i].as_table());
    if (keys.empty()) readers[i].fail("", "empty, must have a key of the scene, as nominal.e");
    for (const auto& [name, node] : keys) {
      const auto place =
          std::find_if(study.keys.begin(), study.keys.end(),
                       [&, &key = name](const SweepKey& k) { return k.name == key; });
      const auto k = static_cast<std::size_t>(place - study.keys.begin());
      if (place == study.keys.end()) {
        const auto& at = node->source().begin;
        const std::string source = node->source().path ? *node->source().path : study.name;
        add_key(study,
                {name, false, fmt::format("{}: item.{}", location(source, at.line, at.column), i)},
                readers[i], "");
        item.emplace_back();
      }
      item[k] = override_text(*node);
    }
  }
  // Items before the one that brought a key along lack its value.
  for (auto& item : study.items) item.resize(study.keys.size());
}

/// A column's JSON pointer, checked as far as it can be before it is followed.
std::string read_pointer(const TableReader& column) {
  std::string pointer = column.text("value");
  try {
    const nlohmann::json::json_pointer parsed(pointer);
    if (!parsed.empty()) return pointer;
  } catch (const nlohmann::json::exception&) {
    // The error is thrown below.
  }
  column.fail("value",
              fmt::format("not a JSON pointer, got {}, must be one into summary.json, such "
                          "as \"/best/total_change_m_s\"",
                          in_quotes(pointer)));
}

void read_columns(const TableReader& root, SweepStudy& study) {
  for (const TableReader& column : root.tables("column")) {
    column.check_keys();
    SweepColumn entry{column.text("name"), "", read_pointer(column), column.head("value")};
    if (column.has("unit")) entry.unit = column.text("unit");
    const auto is_taken = [&](std::string_view name) { return entry.name == name; };
    const bool is_there =
        is_taken("item") || is_taken("exit_code") || is_taken("error") ||
        std::any_of(study.keys.begin(), study.keys.end(),
                    [&](const SweepKey& key) { return is_taken(key.name); }) ||
        std::any_of(study.columns.begin(), study.columns.end(),
                    [&](const SweepColumn& other) { return is_taken(other.name); });
    if (is_there || entry.name.empty()) {
      column.fail("name",
                  fmt::format("{}, got {}, must be a name of its own",
                              entry.name.empty() ? "empty" : "there twice", in_quotes(entry.name)));
    }
    for (const char* const text : {"name", "unit"}) {
      if (column.has(text) &&
          printable(column.text(text), std::string::npos) != column.text(text)) {
        column.fail(text, fmt::format("a control character, got {}, must be printable",
                                      in_quotes(column.text(text))));
      }
    }
    // Quotes in the table's header would not keep a spreadsheet from computing it.
    if (std::string_view("=+-@").find(entry.name[0]) != std::string_view::npos) {
      column.fail("name", fmt::format("begins as a formula of a spreadsheet, got {}, must begin "
                                      "with another character than = + - @",
                                      in_quotes(entry.name)));
    }
    study.columns.push_back(std::move(entry));
  }
}

bool is_number(const std::string& text) {
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && rest == text.data() + text.size() && std::isfinite(value);
}

SweepMap read_map(const TableReader& map, const SweepStudy& study) {
  map.check_keys();
  std::vector<std::string_view> keys;
  std::vector<std::string_view> columns;
  for (const SweepKey& key : study.keys) keys.push_back(key.name);
  for (const SweepColumn& column : study.columns) columns.push_back(column.name);
  SweepMap settings{map.choice("x", keys), map.choice("y", keys), map.choice("value", columns)};
  if (settings.x == settings.y) map.fail("y", "the same as x, must be another key");
  for (const auto& [name, key] : {std::pair("x", settings.x), std::pair("y", settings.y)}) {
    for (const auto& item : study.items) {
      if (!is_number(item[key])) {
        map.fail(name, fmt::format("not a number in every item, got {}, must be a key of numbers",
                                   item[key].empty() ? "nothing" : printable(item[key])));
      }
    }
  }
  settings.is_logarithmic = map.has("scale") && map.choice("scale") == 1;
  return settings;
}

void read_sweep_table(const TableReader& sweep, const toml::table& table,
                      const std::filesystem::path& file, SweepStudy& study) {
  sweep.check_keys();
  study.command = sweep_commands()[sweep.choice("command")];
  study.scene = sweep.text("scene");
  if (study.scene.empty()) sweep.fail("scene", "empty, must name the base scene's file");
  study.scene_path = file.parent_path() / study.scene;
  if (sweep.has("set")) {
    sweep.table("set");
    const toml::table& set = *table.get_as<toml::table>("set");
    for (const auto& [key, node] : flat_keys(set)) {
      study.constants.push_back({key, override_text(*node)});
      study.constant_places.push_back(sweep.head("set"));
    }
  }
}

}  // namespace

const std::vector<std::string_view>& sweep_commands() {
  static const std::vector<std::string_view> commands = [] {
    std::vector<std::string_view> all = study_commands();
    all.insert(all.begin(), "run");
    return all;
  }();
  return commands;
}

SweepStudy read_sweep_study(const std::filesystem::path& file) {
  return parse_sweep_study(read_scene_file(file), file, read_scene_file);
}

SweepStudy parse_sweep_study(
    std::string_view text, const std::filesystem::path& file,
    const std::function<std::string(const std::filesystem::path&)>& read_scene,
    std::size_t most_items) {
  const SceneDocument document =
      parse_document(text, printable(file.string(), std::string::npos), {});
  const TableReader root(document.table, "", document.source, &sweep_study_table());
  SweepStudy study;
  study.name = scene_name(file.string());
  study.version = version;
  // The table is read first, so that a scene in place of a study is told that it has none.
  const TableReader sweep = root.table("sweep");
  if (root.has("schema")) root.integer("schema");
  root.check_keys();
  study.title = default_title(file.string());
  root.read_if_any("title", study.title);
  study.title = printable(study.title, std::string::npos);
  read_sweep_table(sweep, *document.table.get_as<toml::table>("sweep"), file, study);
  if (root.has("axis") == root.has("item")) {
    root.fail(
        root.has("axis") ? "item" : "axis",
        fmt::format("{}, must be {}", root.has("axis") ? "beside axis" : "missing", grid_or_list));
  }
  if (root.has("axis")) {
    read_grid(root, document.table, most_items, study);
  } else {
    read_list(root, document.table, most_items, study);
  }
  read_columns(root, study);
  if (root.has("map")) study.map = read_map(root.table("map"), study);
  study.scene_text = read_scene(study.scene_path);
  return study;
}

std::vector<Override> sweep_overrides(const SweepStudy& study, std::size_t item) {
  std::vector<Override> overrides = study.constants;
  for (std::size_t k = 0; k < study.keys.size(); ++k) {
    const std::string& value = study.items[item][k];
    if (!value.empty()) overrides.push_back({study.keys[k].name, value});
  }
  return overrides;
}

std::string shown_sweep_value(const std::string& value) {
  const bool is_quoted =
      value.size() >= 2 && (value[0] == '"' || value[0] == '\'') && value.back() == value[0];
  if (!is_quoted) return value;
  const std::string inner = value.substr(1, value.size() - 2);
  return inner.find_first_of("\\\"'") == std::string::npos ? inner : value;
}

std::string sweep_item_text(const SweepStudy& study, std::size_t item) {
  std::string text;
  for (std::size_t k = 0; k < study.keys.size(); ++k) {
    const std::string& value = study.items[item][k];
    if (value.empty()) continue;
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", study.keys[k].name,
                        printable(shown_sweep_value(value)));
  }
  return text;
}

}  // namespace hamjet::io
