#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "../../text/scene_message.hpp"
#include "scene_errors.hpp"
#include "table_description.hpp"

namespace hamjet::io {

/// Keys that a table may have, and those that belong to other settings of the same table, so that
/// the message for them can say so.
struct KnownKeys {
  std::vector<std::string_view> keys;
  std::vector<std::string_view> keys_elsewhere = {};
  std::string owner = {};  ///< what `keys` belong to, for example "the model kepler"
  /// Keys that the caller refuses with a reason of its own; no message suggests them.
  std::vector<std::string_view> refused_by_caller = {};
};

/// Typed reader of one TOML table. Every function that reads throws Error(scene) with location,
/// dotted key, what is wrong, what was found and what would be right. "Required" functions take a
/// missing key for an error too; for an optional key ask `has` first.
class TableReader {
 public:
  /// `path` is the table's dotted name, empty for the whole scene; the description is null where
  /// the keys are not declared; `errors` keeps what `attempt` catches, null: nothing is caught.
  /// Table, source, description and errors must outlive the reader.
  TableReader(const toml::table& table, std::string path, const SceneSource& source,
              const TableDescription* description = nullptr, SceneErrors* errors = nullptr);

  /// Does a part of the reading on which what follows does not depend: an Error of it is kept, so
  /// that the rest can be read too. Returns whether there was none.
  bool attempt(const std::function<void()>& part) const;
  /// Attempts every key that is declared, and those of all tables below, as far as they can be
  /// judged alone: what a reader that stopped at an error has not come to. Of keys with owners,
  /// those of `owners` and of what the table's own choices name.
  void attempt_declared_keys(const std::vector<std::string_view>& owners) const;

  /// Throws Error(scene) for the first key, in the order of the text, that is not known; where
  /// errors are kept, the others are kept too.
  void check_keys(const KnownKeys& known) const;
  /// check_keys for all declared keys.
  void check_keys() const { check_keys({description_->names()}); }
  /// check_keys for the declared keys of one owner, which messages call `text`.
  void check_keys(std::string_view owner, std::string text) const {
    check_keys({description_->names_of(owner), description_->names_not_of(owner), std::move(text)});
  }

  bool has(std::string_view key) const { return table_->contains(key); }
  /// Whether an unknown key of the table, which has been refused, may stand for this one.
  bool is_misspelt(std::string_view key) const {
    return errors_ != nullptr && errors_->is_excused(path_, key);
  }

  /// Required: a finite number, in the range that is declared; integers are numbers too.
  double number(std::string_view key) const;
  /// Required: a finite number above 0.
  double positive_number(std::string_view key) const;
  /// Required: a finite number between the two, both included.
  double number_between(std::string_view key, double least, double greatest) const;
  /// Required: an integer (4.0 is none) between the two, both included.
  std::int64_t integer_between(std::string_view key, std::int64_t least,
                               std::int64_t greatest) const;
  /// Required: an integer in the range that is declared.
  std::int64_t integer(std::string_view key) const;
  /// The key's value, if it is there and an integer.
  std::optional<std::int64_t> integer_if_any(std::string_view key) const;
  /// Required: an array of `count` finite numbers.
  std::vector<double> numbers(std::string_view key, std::size_t count) const;
  /// Required: an array of `count` finite numbers above 0.
  std::vector<double> positive_numbers(std::string_view key, std::size_t count) const;
  /// Required: an array of finite numbers, not empty.
  std::vector<double> numbers(std::string_view key) const;
  /// Required: an array of integers between the two, both included; not empty.
  std::vector<std::int64_t> integers(std::string_view key, std::int64_t least,
                                     std::int64_t greatest) const;
  /// Required: an array of integers in the range that is declared; not empty.
  std::vector<std::int64_t> integers(std::string_view key) const;
  /// Required: an array of `size` arrays (rows) of `size` finite numbers; returned by rows.
  std::vector<double> square_matrix(std::string_view key, std::size_t size) const;
  /// Required: a finite number, or an array of them that is not empty.
  std::vector<double> number_or_numbers(std::string_view key) const;
  /// Required: true or false.
  bool boolean(std::string_view key) const;
  /// The key's value, if it is there and true or false.
  std::optional<bool> boolean_if_any(std::string_view key) const;
  /// Whether the key is there and a number, finite or not.
  bool is_number(std::string_view key) const;
  /// The key's value, if it is there and a string.
  std::optional<std::string> text_if_any(std::string_view key) const;
  /// Required: a string.
  std::string text(std::string_view key) const;
  /// Required: the path of a file, relative to the folder of the scene.
  std::filesystem::path path_beside_scene(std::string_view key) const;
  /// Required: the path of a file as in path_beside_scene; returns the file's content. Throws
  /// Error(input_output) if it cannot be read, Error(too_large) if it has more than so many bytes.
  std::string content_beside_scene(std::string_view key, std::size_t most_bytes) const;
  /// Required: an array of strings, not empty.
  std::vector<std::string> texts(std::string_view key) const;
  /// Required: one of `choices`; returns its index.
  std::size_t choice(std::string_view key, const std::vector<std::string_view>& choices) const;
  /// Required: one of the choices that are declared; returns its index.
  std::size_t choice(std::string_view key) const;
  /// Reads a key of one value, as declared, into `value`, which stays as it is where the table does
  /// not have the key.
  template <class Value>
  void read_if_any(std::string_view key, Value& value) const;
  /// Throws for what is missing of the keys, or is not as declared; where errors are kept, for all.
  void require(const std::vector<std::string_view>& keys) const;
  /// Required: the only one of `keys` that the table has.
  std::string_view exactly_one_of(const std::vector<std::string_view>& keys) const;
  /// How the other keys of a choice are removed, as the end of a message, if an override gave this
  /// one; empty otherwise.
  std::string removal_of_others(std::string_view key,
                                const std::vector<std::string_view>& given) const;

  /// Required: a table.
  TableReader table(std::string_view key) const;
  /// Required: an array of tables, not empty.
  std::vector<TableReader> tables(std::string_view key) const;

  /// Throws Error(scene) with the message `head: problem`.
  [[noreturn]] void fail(std::string_view key, const std::string& problem) const;
  /// Throws Error(scene) about an element of an array, or about the key where it has no array.
  [[noreturn]] void fail_element(std::string_view key, std::size_t index,
                                 const std::string& problem) const;

  /// Adds `warning: head: what` to what is said of the scene, once.
  void warn(std::string_view key, std::string_view what) const;

  /// Warns of the first of several, and how many more there are; of none it says nothing.
  void warn(std::string_view key, const std::vector<std::string>& all) const;

  /// `location: dotted key`, at the key's value if there is one, else at the table; for a value
  /// that an override gave see `message_head`. An empty key stands for the table itself.
  std::string head(std::string_view key) const;
  /// Where the key's value stands, or the table if it has no such key.
  std::string where(std::string_view key) const;
  /// The value as messages quote it, for example `the string "4"`.
  std::string found(std::string_view key) const;

 private:
  const toml::node& required(std::string_view key, std::string_view right) const;
  const toml::array& required_array(std::string_view key, std::string_view right) const;
  /// The form that is declared for the key, which must be.
  const ValueForm& form_of(std::string_view key) const;
  const TableDescription* description_of(std::string_view key) const;
  /// Reads a key of one value or of an array, as declared, for its errors alone.
  void read_declared(const SceneKey& key) const;
  /// What the table's keys may belong to, besides what the tables above it are of.
  std::vector<std::string_view> owners_of_keys() const;
  /// Excuses the keys that the unknown one may stand for.
  void excuse_for(std::string_view unknown, const KnownKeys& known) const;
  [[noreturn]] void fail_unknown(const toml::key& unknown, const KnownKeys& known) const;
  double finite(const toml::node& node, const std::string& dotted_key,
                std::string_view right) const;
  /// `key` with the table's dotted name before it.
  std::string dotted(std::string_view key) const;
  std::string location_of(const toml::node& node) const;

  const toml::table* table_;
  std::string path_;
  const SceneSource* source_;
  const TableDescription* description_;
  SceneErrors* errors_;
};

template <class Value>
void TableReader::read_if_any(std::string_view key, Value& value) const {
  if (!has(key)) return;
  if constexpr (std::is_same_v<Value, bool>) {
    value = boolean(key);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    value = text(key);
  } else if constexpr (std::is_enum_v<Value>) {
    value = static_cast<Value>(choice(key));
  } else if constexpr (std::is_integral_v<Value>) {
    value = static_cast<Value>(integer(key));
  } else {
    value = number(key);
  }
}

/// A value as messages quote it.
std::string describe(const toml::node& node);

}  // namespace hamjet::io
