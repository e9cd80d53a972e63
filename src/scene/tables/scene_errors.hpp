#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/error.hpp"

namespace hamjet::io {

/// The largest number of errors that are reported for one scene; further errors are only counted.
inline constexpr std::size_t most_errors_said = 20;

/// Thrown in place of an error that has been kept already, or that follows from a kept one.
struct AlreadySaid : std::exception {};

/// The errors of a scene, kept while the rest of it is read, so that all are reported together.
class SceneErrors {
 public:
  /// Keeps the error that is being handled, unless it has been kept already.
  void keep(const Error& handled);
  bool empty() const { return kept_.empty(); }
  /// Whether there is an error whose message begins with `head: `.
  bool has_about(std::string_view head) const;

  /// Keeps a warning about a scene that is accepted; each line is kept once.
  void warn(const std::string& line);
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Notes that an unknown key may be a misspelling of this one, which is then not reported as
  /// missing.
  void excuse_key(std::string_view table, std::string_view key);
  /// Notes that an unknown key may be a misspelling of any one missing key, or of all.
  void excuse_any_key(std::string_view table) { ++excuses_left_[std::string(table)]; }
  void excuse_all_keys(std::string_view table) { excused_tables_.emplace(table); }
  bool is_excused(std::string_view table, std::string_view key) const;
  /// Whether a missing key is excused, by its name or by one of the remaining excuses for any key
  /// of the table.
  bool take_excuse(std::string_view table, std::string_view key);

  /// Throws a single error as it was, or several as one Error with a line for each, in the order of
  /// the lines of `source`; errors without a line come last. Its kind is scene if one of them has
  /// this kind. The warnings, any of which may name the cause, follow in lines of their own, unless
  /// the only error has another kind.
  [[noreturn]] void raise(std::string_view source, const std::vector<std::string>& warnings) const;

 private:
  struct Kept {
    std::string message;
    ErrorKind kind;
    std::exception_ptr thrown;
  };
  using Names = std::set<std::string, std::less<>>;

  std::vector<Kept> kept_;
  std::vector<std::string> warnings_;
  Names excused_keys_;
  Names excused_tables_;
  std::map<std::string, std::size_t, std::less<>> excuses_left_;
};

}  // namespace hamjet::io
