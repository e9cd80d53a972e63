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

/// Most errors that are said of one scene; of further ones, how many there are.
inline constexpr std::size_t most_errors_said = 20;

/// Thrown in place of an error that is among the kept ones already, or follows from one of them.
struct AlreadySaid : std::exception {};

/// The errors of a scene, kept while the rest of it is read, so that all are said together.
class SceneErrors {
 public:
  /// Keeps the error that is being handled, unless it has been kept before.
  void keep(const Error& handled);
  bool empty() const { return kept_.empty(); }
  /// Whether there is an error whose message begins with `head: `.
  bool has_about(std::string_view head) const;

  /// Keeps a line that warns of the scene and does not refuse it, once.
  void warn(const std::string& line);
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// An unknown key may stand for this one, which is then not missing besides.
  void excuse_key(std::string_view table, std::string_view key);
  /// An unknown key may stand for any one that is missing, or for all.
  void excuse_any_key(std::string_view table) { ++excuses_left_[std::string(table)]; }
  void excuse_all_keys(std::string_view table) { excused_tables_.emplace(table); }
  bool is_excused(std::string_view table, std::string_view key) const;
  /// Whether the key, which is missing, is excused or one of any that the table has left.
  bool take_excuse(std::string_view table, std::string_view key);

  /// Throws the only error as it was, or one Error with a line for each in the order of the lines
  /// of `source`; those without a line come last. It is of the kind scene if one of them is. The
  /// warnings, any of which may be the cause, follow in lines of their own, but where the only
  /// error is of another kind.
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
