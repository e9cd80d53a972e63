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

/// The keys that a table may have, and the keys that belong to other settings of the same table, so
/// that the message about these can say so.
struct KnownKeys {
  std::vector<std::string_view> keys;
  std::vector<std::string_view> keys_elsewhere = {};
  std::string owner = {};  ///< to what `keys` belong, for example "the model kepler"
  /// Keys that the caller refuses with a reason of its own; no message suggests them.
  std::vector<std::string_view> refused_by_caller = {};
};

/// Typed reader of one TOML table. Every function that reads throws Error(scene) with location,
/// dotted key, what is wrong, what was found and what would be right. For "required" functions a
/// missing key is an error too; for an optional key, call `has` first.
class TableReader {
 public:
  /// `path` is the table's dotted name, empty for the whole scene; the description is null if the
  /// keys are not declared. `errors` keeps the errors that `attempt` catches; if it is null, none
  /// are caught. Table, source, description and errors must outlive the reader.
  TableReader(const toml::table& table, std::string path, const SceneSource& source,
              const TableDescription* description = nullptr, SceneErrors* errors = nullptr);

  /// Performs a part of the reading on which the following parts do not depend. An Error in it is
  /// kept, so that the rest can be read too. Returns whether there was no error.
  bool attempt(const std::function<void()>& part) const;
  /// Attempts every declared key, and the keys of all tables below, as far as each can be judged by
  /// itself. This covers the keys that a reader did not reach because of an error. Of keys with
  /// owners, those of `owners` and of the owners that the table's own choices name are attempted.
  void attempt_declared_keys(const std::vector<std::string_view>& owners) const;

  /// Throws Error(scene) for the first unknown key, in the order of the text. If errors are kept,
  /// the errors of further unknown keys are kept too.
  void check_keys(const KnownKeys& known) const;
  /// check_keys for all declared keys.
  void check_keys() const { check_keys({description_->names()}); }
  /// check_keys for the declared keys of one owner, which messages call `text`.
  void check_keys(std::string_view owner, std::string text) const {
    check_keys({description_->names_of(owner), description_->names_not_of(owner), std::move(text)});
  }

  bool has(std::string_view key) const { return table_->contains(key); }
  /// The table's keys in the order of the text, for a table whose user chooses them.
  std::vector<std::string> keys() const;
  /// Whether an unknown key of the table, which has been refused, may be a misspelling of this one.
  bool is_misspelt(std::string_view key) const {
    return errors_ != nullptr && errors_->is_excused(path_, key);
  }

  /// Required: a finite number in the declared range; integers are numbers too.
  double number(std::string_view key) const;
  /// Required: a finite number above 0.
  double positive_number(std::string_view key) const;
  /// Required: a finite number in the range from `least` to the greatest value, both included.
  double number_between(std::string_view key, double least, double greatest) const;
  /// Required: an integer (4.0 is not one) in a range, both ends included.
  std::int64_t integer_between(std::string_view key, std::int64_t least,
                               std::int64_t greatest) const;
  /// Required: an integer in the declared range.
  std::int64_t integer(std::string_view key) const;
  /// The key's value, if the key is present and an integer.
  std::optional<std::int64_t> integer_if_any(std::string_view key) const;
  /// Required: an array of `count` finite numbers.
  std::vector<double> numbers(std::string_view key, std::size_t count) const;
  /// Required: an array of `count` finite numbers above 0.
  std::vector<double> positive_numbers(std::string_view key, std::size_t count) const;
  /// Required: an array of finite numbers, not empty.
  std::vector<double> numbers(std::string_view key) const;
  /// Required: an array of integers in a range, both ends included; not empty.
  std::vector<std::int64_t> integers(std::string_view key, std::int64_t least,
                                     std::int64_t greatest) const;
  /// Required: an array of integers in the declared range; not empty.
  std::vector<std::int64_t> integers(std::string_view key) const;
  /// Required: an array of `size` arrays (rows) of `size` finite numbers; the result is stored by
  /// rows.
  std::vector<double> square_matrix(std::string_view key, std::size_t size) const;
  /// Required: a finite number, or a non-empty array of finite numbers.
  std::vector<double> number_or_numbers(std::string_view key) const;
  /// Required: true or false.
  bool boolean(std::string_view key) const;
  /// The key's value, if the key is present and true or false.
  std::optional<bool> boolean_if_any(std::string_view key) const;
  /// Whether the key is present and a number, finite or not.
  bool is_number(std::string_view key) const;
  /// The key's value, if the key is present and a string.
  std::optional<std::string> text_if_any(std::string_view key) const;
  /// Required: a string.
  std::string text(std::string_view key) const;
  /// Required: the path of a file, relative to the folder of the scene.
  std::filesystem::path path_beside_scene(std::string_view key) const;
  /// Required: the path of a file as in path_beside_scene; returns the file's content. Throws
  /// Error(input_output) if the file cannot be read, Error(too_large) if it has more bytes than
  /// allowed.
  std::string content_beside_scene(std::string_view key, std::size_t most_bytes) const;
  /// Required: an array of strings, not empty.
  std::vector<std::string> texts(std::string_view key) const;
  /// Required: one of `choices`; returns its index.
  std::size_t choice(std::string_view key, const std::vector<std::string_view>& choices) const;
  /// Required: one of the declared choices; returns its index.
  std::size_t choice(std::string_view key) const;
  /// Reads a key of one value, as declared, into `value`, which is unchanged if the table does not
  /// have the key.
  template <class Value>
  void read_if_any(std::string_view key, Value& value) const;
  /// Throws for a key that is missing or not as declared; if errors are kept, for all such keys.
  void require(const std::vector<std::string_view>& keys) const;
  /// Required: exactly one of `keys`, which is returned.
  std::string_view exactly_one_of(const std::vector<std::string_view>& keys) const;
  /// If an override gave this key, the end of a message that tells how to remove the other keys of
  /// the choice; otherwise empty.
  std::string removal_of_others(std::string_view key,
                                const std::vector<std::string_view>& given) const;

  /// Required: a table.
  TableReader table(std::string_view key) const;
  /// Required: an array of tables, not empty.
  std::vector<TableReader> tables(std::string_view key) const;

  /// Throws Error(scene) with the message `head: problem`.
  [[noreturn]] void fail(std::string_view key, const std::string& problem) const;
  /// Throws Error(scene) about an element of an array, or about the key if its value is not an
  /// array.
  [[noreturn]] void fail_element(std::string_view key, std::size_t index,
                                 const std::string& problem) const;

  /// Adds `warning: head: what` to the warnings about the scene, once.
  void warn(std::string_view key, std::string_view what) const;

  /// Warns with the first of several texts, and the number of further ones; for an empty list there
  /// is no warning.
  void warn(std::string_view key, const std::vector<std::string>& all) const;

  /// The head of a message: `location: dotted key`, at the key's value if there is one, otherwise
  /// at the table; for a value of an override see `message_head`. An empty key stands for the table
  /// itself.
  std::string head(std::string_view key) const;
  /// The location of the key's value, or of the table if it does not have the key.
  std::string where(std::string_view key) const;
  /// The value as messages quote it, for example `the string "4"`.
  std::string found(std::string_view key) const;

 private:
  const toml::node& required(std::string_view key, std::string_view right) const;
  const toml::array& required_array(std::string_view key, std::string_view right) const;
  /// The declared form of the key, which must be declared.
  const ValueForm& form_of(std::string_view key) const;
  const TableDescription* description_of(std::string_view key) const;
  /// Reads a key of one value or of an array, as declared, only to find its errors.
  void read_declared(const SceneKey& key) const;
  /// The possible owners of the table's keys, besides the owners of the tables above it.
  std::vector<std::string_view> owners_of_keys() const;
  /// Excuses the missing keys of which the unknown one may be a misspelling.
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
