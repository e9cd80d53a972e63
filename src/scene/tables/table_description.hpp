#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

// The declarations of the keys of all tables of a scene. TableReader takes allowed keys, ranges and
// choices from here, and `hamjet list keys` prints them. Conditions that involve other keys are in
// the functions that read the tables; the key's form or help describes them in words.

namespace hamjet::io {

struct TableDescription;

/// The form of a value. Numbers are finite; ranges include both ends.
struct ValueForm {
  enum class Type { number, integer, boolean, text, table };

  Type type = Type::number;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool is_positive = false;  ///< above 0, instead of the range
  bool is_array = false;     ///< an array of such values
  std::size_t count = 0;     ///< number of an array's elements; 0 for at least one
  std::vector<std::string_view> choices = {};  ///< if not empty, the only allowed texts
  const TableDescription* table = nullptr;     ///< for the type table: its description
  std::string words = {};  ///< a description for people, where the members do not suffice

  bool has_range() const { return least > -std::numeric_limits<double>::infinity(); }
};

namespace form {

inline ValueForm number() { return {}; }
inline ValueForm positive() { return {.is_positive = true}; }
inline ValueForm between(double least, double most) { return {.least = least, .most = most}; }
inline ValueForm integer(double least, double most) {
  return {.type = ValueForm::Type::integer, .least = least, .most = most};
}
inline ValueForm boolean() { return {.type = ValueForm::Type::boolean}; }
inline ValueForm text() { return {.type = ValueForm::Type::text}; }
inline ValueForm choice(std::vector<std::string_view> choices) {
  return {.type = ValueForm::Type::text, .choices = std::move(choices)};
}
inline ValueForm table(const TableDescription& description) {
  return {.type = ValueForm::Type::table, .table = &description};
}
inline ValueForm array(ValueForm element, std::size_t count = 0) {
  element.is_array = true;
  element.count = count;
  return element;
}
inline ValueForm words(std::string words, ValueForm rest = text()) {
  rest.words = std::move(words);
  return rest;
}

}  // namespace form

/// What holds if a table does not have a key.
struct Absence {
  enum class Meaning {
    refused,  ///< the key is required
    value,    ///< as if the key had the value `text`, in TOML
    other     ///< described by `text`
  };
  Meaning meaning = Meaning::refused;
  std::string text = {};
};

namespace absent {

inline Absence refused() { return {}; }
inline Absence other(std::string text) { return {Absence::Meaning::other, std::move(text)}; }
/// The default value, taken from the initializer of the member.
template <class Value>
Absence value(const Value& value) {
  if constexpr (std::is_convertible_v<Value, std::string_view>) {
    return {Absence::Meaning::value, fmt::format("\"{}\"", std::string_view(value))};
  } else if constexpr (std::is_arithmetic_v<Value>) {
    return {Absence::Meaning::value, fmt::format("{}", value)};
  } else {
    return {Absence::Meaning::value, fmt::format("[{}]", fmt::join(value, ", "))};
  }
}

}  // namespace absent

/// A key of a table. Its unit follows from the end of its name.
struct SceneKey {
  std::string_view name;
  ValueForm form;
  Absence absence;
  std::string_view help;
  /// What has this key, for example models or methods; if empty, every such table has it.
  std::vector<std::string_view> owners = {};

  bool belongs_to(std::string_view owner) const;
};

/// The two kinds of models that tables distinguish, as owners of keys.
inline constexpr std::string_view orbits = "orbits";
inline constexpr std::string_view other_models = "other models";

/// Concatenates lists.
template <class Element>
std::vector<Element> joined(std::initializer_list<std::vector<Element>> lists) {
  std::vector<Element> all;
  for (const std::vector<Element>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// A table, or each table of an array.
struct TableDescription {
  std::vector<SceneKey> keys;  ///< in the order in which messages list them
  std::string_view note = {};  ///< text about the whole table

  /// The distinct names of the keys.
  std::vector<std::string_view> names() const;
  /// The names of the keys that belong to an owner, or to no owner.
  std::vector<std::string_view> names_of(std::string_view owner) const;
  std::vector<std::string_view> names_not_of(std::string_view owner) const;
  /// The key of this name; null if there is none.
  const SceneKey* find(std::string_view name) const;
};

// The descriptions of the tables of a scene, each defined beside the function that reads the table.

const TableDescription& assignment_table();
const TableDescription& canonical_transformation_table();
const TableDescription& case_table();
const TableDescription& checks_table();
const TableDescription& compare_table();
const TableDescription& energy_conservation_table();
const TableDescription& deputy_table();
const TableDescription& ephemeris_table();
const TableDescription& figure_table();
const TableDescription& formation_table();
const TableDescription& generating_function_table();
const TableDescription& integrator_table();
const TableDescription& jet_table();
const TableDescription& nominal_table();
const TableDescription& optimal_control_table();
const TableDescription& output_table();
const TableDescription& reference_table();
const TableDescription& relative_hamiltonian_table();
const TableDescription& spacecraft_table();
const TableDescription& system_table();
const TableDescription& thruster_table();
const TableDescription& transfer_table();
const TableDescription& collision_table();
const TableDescription& safety_table();
const TableDescription& uncertainty_table();
const TableDescription& units_table();
const TableDescription& validity_table();

/// The keys with which every scene and every sweep begins: `schema` and `title`.
const std::vector<SceneKey>& head_keys();

/// A study's name and the tables and keys at the top of its scenes.
struct StudyTables {
  std::string_view name;
  TableDescription top;
};

/// All keys of this name in scenes of the first study, by their paths from the top: "jet.order".
std::vector<std::string> paths_of_key(std::string_view name);

/// All studies; the first one is that of a scene without the key `study`.
const std::vector<StudyTables>& all_studies();

}  // namespace hamjet::io
