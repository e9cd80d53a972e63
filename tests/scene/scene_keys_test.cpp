#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "hamjet/relative_motion/deputy_coordinates.hpp"
#include "scene/study_reader.hpp"
#include "scene/tables/key_reference.hpp"
#include "scene/tables/table_description.hpp"
#include "scene_key_places.hpp"
#include "scene_samples.hpp"
#include "study_text.hpp"
#include "sweep/sweep_tables.hpp"

// What the tables declare of their keys is what the readers do: every key is taken, a value just
// outside its range is refused, and leaving it out is its default. The scenes are those that are
// shipped, changed as with --set.

namespace hamjet::io {
namespace {

std::string in_array(const ValueForm& form, const std::string& value) {
  if (!form.is_array) return value;
  std::string array = value;
  for (std::size_t i = 1; i < form.count; ++i) array += ", " + value;
  return '[' + array + ']';
}

std::string number_text(const ValueForm& form, double value) {
  return form.type == ValueForm::Type::integer ? fmt::format("{:.0f}", value)
                                               : fmt::format("{:e}", value);
}

/// A value of the form.
std::string right_value(const ValueForm& form) {
  if (form.type == ValueForm::Type::boolean) return "true";
  if (!form.choices.empty()) return in_array(form, fmt::format("\"{}\"", form.choices[0]));
  if (form.type == ValueForm::Type::text) return in_array(form, "\"text\"");
  return in_array(form, form.has_range() ? number_text(form, form.most) : "1");
}

/// Values just outside what the form declares.
std::vector<std::string> wrong_values(const ValueForm& form) {
  std::vector<std::string> values;
  if (form.type == ValueForm::Type::boolean) values = {"1", "\"true\""};
  if (form.type == ValueForm::Type::text) values = {"1"};
  if (!form.choices.empty()) values.emplace_back("\"none of them\"");
  if (form.is_positive) values = {"0", "-1e-300"};
  if (form.has_range()) {
    const bool is_integer = form.type == ValueForm::Type::integer;
    const auto beyond = [&](double bound, double sign) {
      return is_integer ? number_text(form, bound + sign)
                        : fmt::format("{:.17g}", std::nextafter(bound, sign * INFINITY));
    };
    values.push_back(beyond(form.least, -1));
    if (form.most < std::numeric_limits<double>::max()) values.push_back(beyond(form.most, 1));
    if (is_integer) values.emplace_back("1.5");
  }
  if (form.type == ValueForm::Type::number) values.emplace_back("inf");
  for (std::string& value : values) value = in_array(form, value);
  return values;
}

/// The study as a text, or the message where it is refused, behind "refused: ".
std::string read(const Place& place, const std::string& key, const std::string& value) {
  std::vector<Override> overrides = place.changes;
  overrides.push_back({key, value});
  const std::string file = std::string(HAMJET_SOURCE_DIR) + "/data/scenes/" + place.file + ".toml";
  try {
    StudyText text;
    std::visit([&](const auto& study) { text.add(study); }, read_study(file, overrides));
    return text.text();
  } catch (const Error& error) {
    return std::string("refused: ") + error.what();
  }
}

void check_key(const SceneKey& key, const std::string& table, std::string_view owner) {
  const std::string path =
      table.empty() ? std::string(key.name) : fmt::format("{}.{}", table, key.name);
  SCOPED_TRACE(fmt::format("{} ({})", path, owner));
  Place place = place_of(table, owner);
  if (const auto special = special_places().find(path); special != special_places().end()) {
    if (!special->second.file.empty()) place = {special->second.file};
    place.changes = joined<Override>({place.changes, special->second.changes});
    place.value = special->second.value;
  }
  const std::string value = place.value.empty() ? right_value(key.form) : place.value;
  EXPECT_FALSE(read(place, path, value).starts_with("refused")) << read(place, path, value);
  for (const std::string& wrong : wrong_values(key.form)) {
    const std::string said = read(place, path, wrong);
    EXPECT_TRUE(said.starts_with("refused: --set " + path)) << wrong << " gives " << said;
  }
  const std::string without = read(place, path, "null");
  if (key.absence.meaning == Absence::Meaning::refused) {
    EXPECT_TRUE(without.starts_with("refused")) << "it can be left out";
  } else if (key.absence.meaning == Absence::Meaning::value) {
    EXPECT_FALSE(without.starts_with("refused")) << without;
    EXPECT_EQ(read(place, path, key.absence.text), without) << "with the default";
  }
}

void check_keys(const TableDescription& table, const std::string& path,
                std::set<const TableDescription*>& checked) {
  for (const SceneKey& key : table.keys) {
    EXPECT_FALSE(key.help.empty() && key.owners.empty()) << path << ": " << key.name;
    // The other deputies are read as [deputy] is.
    const bool is_of_deputy = special_places().contains(fmt::format("deputy.{}", key.name));
    const bool is_of_nominal = path == "nominal" || !key.owners.empty();
    if (is_of_deputy && !is_of_nominal && path != "deputy") continue;
    if (key.form.table != nullptr) {
      // Other commands than `stability` do not look into this one.
      if (key.name == "case" || !checked.insert(key.form.table).second) continue;
      const std::string below = path + std::string(path.empty() ? "" : ".") + std::string(key.name);
      check_keys(*key.form.table, key.form.is_array ? below + ".0" : below, checked);
    } else if (key.owners.empty()) {
      check_key(key, path, "");
    } else {
      for (const std::string_view owner : key.owners) check_key(key, path, owner);
    }
  }
}

TEST(SceneKeys, TheReadersDoWhatTheTablesDeclare) {
  std::set<const TableDescription*> checked;
  for (const StudyTables& study : all_studies()) {
    if (!checked.empty()) {
      for (const SceneKey& key : study.top.keys) {
        if (key.form.table != nullptr && checked.insert(key.form.table).second) {
          check_keys(*key.form.table, std::string(key.name), checked);
        }
      }
      continue;
    }
    check_keys(study.top, "", checked);
  }
}

std::string content_of(const std::string& name) {
  std::ifstream file(std::string(HAMJET_SOURCE_DIR) + "/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(SceneKeys, ThePageHasThem) {
  EXPECT_TRUE(content_of("data/scenes/keys/README.md") == key_reference(sweep_study_table()))
      << "renew it by: hamjet list keys > data/scenes/keys/README.md";
}

/// Names of all keys of a table and of those below.
void add_names(const TableDescription& table, std::set<std::string_view>& names) {
  for (const SceneKey& key : table.keys) {
    names.insert(key.name);
    if (key.form.table != nullptr) add_names(*key.form.table, names);
  }
}

TEST(SceneKeys, TheDictionaryOfTheFuzzTargetHasThem) {
  std::set<std::string_view> names;
  for (const StudyTables& study : all_studies()) add_names(study.top, names);
  const std::string dictionary = content_of("tests/fuzz/scene_text.dict");
  for (const std::string_view name : names) {
    EXPECT_NE(dictionary.find(fmt::format("\n\"{}\"\n", name)), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace hamjet::io
