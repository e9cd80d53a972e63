#include "key_reference.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "../../text/scene_message.hpp"
#include "key_unit.hpp"

namespace hamjet::io {
namespace {

constexpr std::string_view introduction =
    R"(# All keys of a scene, and of a sweep

This page is what `hamjet list keys` prints; [the page on scenes](../README.md) explains them. Numbers are finite and
ranges include both ends. Canonical units are those of `[units]`; times in orbits are periods of the nominal. What a
key belongs to, where not every scene can have it, stands in brackets.
)";

std::string in_code(std::string_view text) { return fmt::format("`{}`", text); }

template <class Texts, class Format>
std::string listed_as(const Texts& texts, const Format& format) {
  std::vector<std::string> words;
  for (const auto& text : texts) words.push_back(format(text));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string value_text(const SceneKey& key) {
  using Type = ValueForm::Type;
  const ValueForm& form = key.form;
  const bool is_number = form.type == Type::number || form.type == Type::integer;
  const std::string_view unit = is_number ? unit_of(key.name) : std::string_view();
  std::string text = form.words;
  if (text.empty() && form.is_array) text = "array of ";
  if (text == "array of " && form.count > 0) text += fmt::format("{} ", form.count);
  if (form.words.empty()) {
    static constexpr std::string_view nouns[] = {"number", "integer", "`true` or `false`", "string",
                                                 "table"};
    if (form.choices.empty()) {
      text += nouns[static_cast<std::size_t>(form.type)];
      if (form.is_array) text += 's';
    }
    text += listed_as(form.choices, [](std::string_view c) { return fmt::format("`\"{}\"`", c); });
    if (form.is_positive) text += " above 0";
    if (form.least == form.most) {
      text += fmt::format(" {}", form.least);
    } else if (form.has_range()) {
      text += fmt::format(" from {} to {}", form.least, form.most);
    }
  }
  return unit.empty() ? text : fmt::format("{}; {}", text, unit);
}

std::string default_text(const Absence& absence) {
  if (absence.meaning == Absence::Meaning::refused) return "required";
  return absence.meaning == Absence::Meaning::value ? in_code(absence.text) : absence.text;
}

/// A line of a table: keys that differ in their names alone, or in what they belong to.
struct Row {
  std::vector<std::string_view> names;
  std::string texts;
  std::vector<std::string_view> owners;
};

std::vector<Row> rows_of(const std::vector<SceneKey>& keys) {
  std::vector<Row> rows;
  for (const SceneKey& key : keys) {
    const Row row = {
        {key.name},
        fmt::format("{} | {} | {}", value_text(key), default_text(key.absence), key.help),
        key.owners};
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const Row& other) {
      return other.names == row.names && other.texts == row.texts;
    });
    if (same != rows.end()) {
      same->owners = joined<std::string_view>({same->owners, row.owners});
    } else if (!rows.empty() && rows.back().texts == row.texts &&
               rows.back().owners == row.owners) {
      rows.back().names.push_back(key.name);
    } else {
      rows.push_back(row);
    }
  }
  return rows;
}

std::string table_text(const std::vector<SceneKey>& keys) {
  std::string text = "| key | value | default | what it is |\n|---|---|---|---|\n";
  for (const Row& row : rows_of(keys)) {
    const std::string names =
        row.names.size() > 3
            ? fmt::format("{} to {}", in_code(row.names.front()), in_code(row.names.back()))
            : listed_as(row.names, in_code);
    const std::string owners = row.owners.empty() ? "" : fmt::format(" ({})", listed(row.owners));
    text += fmt::format("| {} | {}{} |\n", names, row.texts, owners);
  }
  return text;
}

/// The sections of all tables below `path`, each once: what several keys have is said at the first.
void add_tables(const std::vector<SceneKey>& keys, const std::string& path,
                std::set<const TableDescription*>& said, std::string& text) {
  for (const SceneKey& key : keys) {
    const TableDescription* const table = key.form.table;
    if (table == nullptr || !said.insert(table).second) continue;
    std::vector<std::string> headings;
    for (const SceneKey& other : keys) {
      if (other.form.table != table) continue;
      const std::string name = path + std::string(other.name);
      headings.push_back(in_code(other.form.is_array ? "[[" + name + "]]" : "[" + name + "]"));
    }
    text += fmt::format("\n## {}\n\n", fmt::join(headings, ", "));
    if (!table->note.empty()) text += fmt::format("{}\n\n", table->note);
    text += table_text(table->keys);
    add_tables(table->keys, path + std::string(key.name) + '.', said, text);
  }
}

/// The table at a path from the top; null if there is none.
const TableDescription* table_at(std::string_view path) {
  const TableDescription* table = &all_studies().front().top;
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const SceneKey* const key = table->find(path.substr(0, dot));
    if (key == nullptr || key->form.table == nullptr) return nullptr;
    table = key->form.table;
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return table;
}

}  // namespace

std::optional<std::string> section_on_keys(std::string_view name) {
  while (name.starts_with('[')) name.remove_prefix(1);
  while (name.ends_with(']')) name.remove_suffix(1);
  if (name.empty()) return std::nullopt;
  if (const TableDescription* const table = table_at(name)) {
    const std::string note = table->note.empty() ? "" : fmt::format("{}\n\n", table->note);
    return fmt::format("## `[{}]`\n\n{}{}", name, note, table_text(table->keys));
  }
  std::string text;
  for (const std::string& path : paths_of_key(name)) {
    const std::size_t dot = path.rfind('.');
    const std::string parent = dot == std::string::npos ? "" : path.substr(0, dot);
    std::vector<SceneKey> keys = table_at(parent)->keys;
    std::erase_if(keys, [&](const SceneKey& key) { return key.name != name; });
    text += fmt::format("{}## {}\n\n{}", text.empty() ? "" : "\n",
                        parent.empty() ? "The top" : in_code("[" + parent + "]"), table_text(keys));
  }
  return text.empty() ? std::nullopt : std::optional(text);
}

std::string key_reference(const TableDescription& sweep_study) {
  std::string text(introduction);
  std::set<const TableDescription*> said;
  for (const StudyTables& study : all_studies()) {
    if (said.empty()) {
      text += "\n## The top\n\n" + table_text(study.top.keys);
    } else {
      text += fmt::format("\n## `study = \"{}\"`\n\nAt the top: {}.\n", study.name,
                          listed_as(study.top.names_of(study.name), in_code));
    }
    add_tables(study.top.keys, "", said, text);
  }
  text += "\n## A study of `hamjet sweep`\n\n" + table_text(sweep_study.keys);
  add_tables(sweep_study.keys, "", said, text);
  return text;
}

}  // namespace hamjet::io
