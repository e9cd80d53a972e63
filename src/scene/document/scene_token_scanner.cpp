#include "scene_token_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "../../text/scene_message.hpp"

namespace hamjet::io {
namespace {

/// Deepest nesting of tables, arrays and dotted keys; a scene needs 4.
constexpr std::size_t deepest_nesting = 32;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_bare(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' ||
         c == '+' || c == '.' || c == ':';
}

class TokenScanner {
 public:
  TokenScanner(std::string_view text, std::string_view source) : text_(text), source_(source) {}

  void scan() {
    while (position_ < text_.size()) {
      const char c = text_[position_];
      if (c == '#') {
        skip_to_line_end();
      } else if (c == '"' || c == '\'') {
        check_start_of_string();
        skip_string(c);
      } else if (is_bare(c)) {
        take_bare_token();
        run_is_fresh_ = false;
      } else if ((static_cast<unsigned char>(c) & 0x80U) != 0) {
        refuse_character();
      } else {
        take_punctuation(c);
        advance(1);
      }
    }
  }

 private:
  void advance(std::size_t bytes) {
    for (const std::size_t end = std::min(position_ + bytes, text_.size()); position_ < end;
         ++position_) {
      if (text_[position_] == '\n') {
        ++line_;
        column_ = 1;
      } else if ((static_cast<unsigned char>(text_[position_]) & 0xc0U) != 0x80U) {
        ++column_;  // continuation bytes of UTF-8 do not count as columns
      }
    }
  }

  void skip_to_line_end() {
    const std::size_t end = text_.find('\n', position_);
    advance(std::min(end, text_.size()) - position_);
  }

  /// The character at the position, quoted.
  std::string character() const {
    const std::string_view rest = text_.substr(position_);
    return in_quotes(rest.substr(0, utf8_sequence_length(rest)));
  }

  /// Outside strings and comments TOML allows only ASCII. Where toml++ 3.3 tests whether a
  /// character is blank, its behaviour is undefined for characters that are not ASCII and lie in
  /// the same part of Unicode as a blank (is_non_ascii_horizontal_whitespace, U+00A1 to U+0499
  /// among them).
  [[noreturn]] void refuse_character() const {
    throw_scene_error(here(), fmt::format("not valid TOML: got the character {} outside quotes, "
                                          "must be within quotes or a comment",
                                          character()));
  }

  /// A string begins only after these characters, and not within a value that is not a string.
  /// Elsewhere a quote does not begin a string for the parser, and this scanner would disagree with
  /// it, so that it is refused.
  void check_start_of_string() const {
    constexpr std::string_view right = "\n\r\t =[{,.";
    const bool is_at_start = position_ == 0 || right.find(text_[position_ - 1]) != right.npos;
    if (is_at_start && !is_within_value() && !levels_.back().is_within_value) return;
    throw_scene_error(here(),
                      "not valid TOML: got a quotation mark within or behind a word or "
                      "a string, must be at the start of a key or a value");
  }

  /// Skips a string with its quotes. An unclosed string is left for the parser to report: skipping
  /// ends with the line or, for the form of several lines, with the text.
  void skip_string(char quote) {
    const std::string three_quotes(3, quote);
    const bool several_lines = text_.substr(position_).starts_with(three_quotes);
    const std::string_view end = std::string_view(three_quotes).substr(0, several_lines ? 3 : 1);
    advance(end.size());
    const std::size_t begin = position_;
    while (position_ < text_.size() && !text_.substr(position_).starts_with(end)) {
      if (text_[position_] == '\n' && !several_lines) return;
      if (quote == '"' && text_[position_] == '\\') {
        skip_escape(several_lines);
      } else {
        advance(1);
      }
    }
    last_word_ = text_.substr(begin, position_ - begin);
    advance(end.size());
    // In the form of several lines, one or two quotes before the closing three belong to the text.
    for (int i = 0; several_lines && i < 2 && text_.substr(position_).starts_with(quote); ++i) {
      advance(1);
    }
  }

  /// Skips a backslash and the character that it escapes. In a string of several lines, a backslash
  /// at the end of a line joins the next line. In such strings toml++ tests whether the characters
  /// after the backslash are blank, with the same undefined behaviour as outside strings.
  void skip_escape(bool several_lines) {
    advance(1);
    constexpr std::string_view blanks = " \t\r\n";
    const auto is_blank = [&] {
      return position_ < text_.size() && blanks.find(text_[position_]) != blanks.npos;
    };
    if (!several_lines) return advance(1);
    const bool joins_lines = is_blank();
    while (is_blank()) advance(1);
    if (position_ < text_.size() && (static_cast<unsigned char>(text_[position_]) & 0x80U) != 0) {
      refuse_behind_backslash(joins_lines);
    }
    if (!joins_lines) advance(1);
  }

  [[noreturn]] void refuse_behind_backslash(bool joins_lines) const {
    constexpr std::string_view joined =
        "where a line goes on that a backslash has broken, must be ASCII there, or the line be "
        "broken elsewhere";
    constexpr std::string_view escaped =
        "behind a backslash, must be one of b, t, n, f, r, u, U, \", \\ or the end of the line";
    throw_scene_error(here(), fmt::format("cannot be read: got the character {} {}", character(),
                                          joins_lines ? joined : escaped));
  }

  void take_bare_token() {
    std::size_t length = 0;
    while (position_ + length < text_.size() && is_bare(text_[position_ + length])) ++length;
    const std::string_view token = text_.substr(position_, length);
    for (const char c : token) {
      if (c == '.') deepen_by_dot();
    }
    check_number(token);
    last_word_ = token;
    advance(length);
  }

  void take_punctuation(char c) {
    switch (c) {
      case '=':
        key_ = last_word_;
        run_is_fresh_ = !level().in_value;
        level().in_value = true;
        break;
      case '[':
      case '{':
        ++depth_;
        open(c);
        check_depth();
        break;
      case ']':
      case '}':
        end_of_item();
        if (levels_.size() > 1) {
          levels_.pop_back();
          --depth_;
        }
        run_is_fresh_ = true;
        break;
      case ',':
      case '\n':
        end_of_item();
        run_is_fresh_ = true;
        break;
      case ' ':
      case '\t':
        run_is_fresh_ = true;
        break;
      default:
        run_is_fresh_ = false;
        break;
    }
  }

  /// Every dot of a dotted key is a table within a table. (The dot of a decimal number is counted
  /// too, which does no harm.)
  void deepen_by_dot() {
    ++level().dots;
    ++depth_;
    check_depth();
  }

  void end_of_item() {
    depth_ -= level().dots;
    level().dots = 0;
    level().in_value = level().is_array;
  }

  void check_depth() const {
    if (depth_ <= deepest_nesting) return;
    throw_scene_error(here(),
                      fmt::format("nested too deeply, got more than {0} levels of tables and "
                                  "arrays, must be at most {0}",
                                  deepest_nesting));
  }

  void check_number(std::string_view token) const {
    if (!is_digit(token[0]) && token[0] != '-' && token[0] != '+') return;
    std::string digits(token);
    std::erase(digits, '_');
    if (digits[0] == '+') digits.erase(0, 1);  // std::from_chars does not accept a plus sign
    const char* const end = digits.data() + digits.size();
    if (std::all_of(digits.begin() + (digits[0] == '-' ? 1 : 0), digits.end(), is_digit)) {
      std::int64_t integer = 0;
      if (std::from_chars(digits.data(), end, integer).ec == std::errc::result_out_of_range) {
        throw_scene_error(here() + ": " + printable(key_),
                          fmt::format("integer out of range, got {}, must be between {} and {}",
                                      printable(token), std::numeric_limits<std::int64_t>::min(),
                                      std::numeric_limits<std::int64_t>::max()));
      }
      return;
    }
    // Unlike other ways of reading a number, this one does not depend on the locale, and it reports
    // a literal that rounds to 0 just as one that rounds to infinity.
    double number = 0;
    const auto [rest, error] = std::from_chars(digits.data(), end, number);
    if (rest == end && error == std::errc::result_out_of_range) {
      throw_scene_error(
          here() + ": " + printable(key_),
          fmt::format("number out of range, got {}, must be 0 or between {:.2g} and {:.2g} in "
                      "magnitude",
                      printable(token), std::numeric_limits<double>::denorm_min(),
                      std::numeric_limits<double>::max()));
    }
  }

  /// The state of the unfinished item within a bracket.
  struct Level {
    bool is_array = false;
    bool in_value = false;         ///< a value comes next, not a key
    bool is_within_value = false;  ///< the parser takes such a bracket as a part of a value
    std::size_t dots = 0;
  };
  Level& level() { return levels_.back(); }

  /// Whether the parser still treats the next characters as part of a value that is not a string.
  bool is_within_value() const { return levels_.back().in_value && !run_is_fresh_; }

  /// Enters a bracket. An array contains values; a table, and the header of one, begins with a key.
  void open(char bracket) {
    const bool is_array = bracket == '[' && level().in_value;
    levels_.push_back({is_array, is_array, level().is_within_value || is_within_value()});
  }

  std::string here() const { return location(source_, line_, column_); }

  std::string_view text_;
  std::string_view source_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  std::size_t column_ = 1;
  std::size_t depth_ = 0;             ///< open brackets, and dots in the keys that lead to them
  std::vector<Level> levels_ = {{}};  ///< the text outside brackets, and each open bracket
  bool run_is_fresh_ = true;  ///< nothing but brackets since the last place where a value may begin
  std::string_view last_word_;
  std::string_view key_;  ///< the last word before an equals sign
};

}  // namespace

void check_tokens(std::string_view text, std::string_view source) {
  TokenScanner(text, source).scan();
}

}  // namespace hamjet::io
