#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "../xml/orbit_message_xml.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "known_text.hpp"

// The syntax that all orbit messages share (CCSDS 502.0-B-3, 7.3 to 7.5).

namespace hamjet::io {

constexpr std::string_view blanks = " \t";

/// A line that is not blank, with blanks around it removed.
struct MessageLine {
  std::size_t number = 0;
  std::string_view text;
  std::string_view keyword;  ///< the text before the first '=', or the whole line if it has none
  std::string_view value;    ///< the text after it; in an assignment it may have any characters
  std::string_view unit;     ///< the unit that an attribute in XML gives
  bool is_assignment = false;

  bool is(std::string_view word) const { return !is_assignment && text == word; }
  bool is_comment() const {
    return text.starts_with("COMMENT") && (text.size() == 7 || text[7] == ' ' || text[7] == '\t');
  }
};

/// The lines of a message one after the other, without comments and blank lines. For a message in
/// XML notation they are the statements of its elements.
class MessageLines {
 public:
  /// Reads a message of this kind: "oem", "opm" or "cdm". The text must outlive this object. Throws
  /// for UTF-16, and as statements_of_xml.
  MessageLines(const std::string& name, std::string_view text, std::string_view kind);
  /// Lines that have been read point into this object.
  MessageLines(const MessageLines&) = delete;
  MessageLines& operator=(const MessageLines&) = delete;

  /// Reads the next line; returns false at the end of the text. Throws for a control character or a
  /// character that is not ASCII. Values are exempt; they are checked when they are used.
  bool next(MessageLine& line);
  /// Throws for a control character, or one that is not ASCII.
  void check_characters(std::size_t line, std::string_view text) const;
  /// The kind of the whole text, if it is known; for messages.
  const KnownText* known() const { return known_text(whole_); }
  /// The number of the last line read; at the end of the text, the number of the line after it.
  std::size_t number() const { return number_; }

  /// Throws Error(input_output) with `name:line: keyword: problem`.
  [[noreturn]] void fail(std::size_t line, std::string_view keyword,
                         const std::string& problem) const;

 private:
  std::string_view take();
  bool take_statement(MessageLine& line);

  std::string name_;
  std::string_view whole_;
  std::string_view rest_;
  std::size_t number_ = 0;
  std::vector<XmlStatement> statements_;  ///< statements of a message in XML
  std::size_t next_statement_ = 0;
  std::size_t number_of_lines_ = 0;  ///< number of lines of a message in XML
};

/// Reads the first line, which must give the version of this message, one of `versions`. Another
/// first line is not quoted: the file may be any other file, whose content must not appear in
/// messages.
std::string read_version(MessageLines& lines, std::string_view keyword,
                         const std::vector<std::string_view>& versions);

/// The assignments of one part of a message.
class MessageBlock {
 public:
  /// `lines` must outlive the block.
  explicit MessageBlock(const MessageLines& lines) : lines_(&lines) {}

  /// Adds an assignment. Throws for a keyword that is not among `keywords`, a repeated keyword, or
  /// a line that is not an assignment.
  void add(const MessageLine& line, const std::vector<std::string_view>& keywords);
  /// Sets the line at which missing keywords are reported.
  void end_at(std::size_t line) { end_ = line; }

  /// Whether a keyword is there with a value; an empty one counts as none.
  bool has(std::string_view keyword) const {
    const auto found = values_.find(keyword);
    return found != values_.end() && !found->second.text.empty();
  }
  /// The line of a keyword, which must be present.
  std::size_t line_of(std::string_view keyword) const { return values_.find(keyword)->second.line; }
  /// The text of a required keyword.
  std::string text(std::string_view keyword) const;
  /// The text of a required keyword, in capitals.
  std::string capitals(std::string_view keyword) const;
  Epoch epoch(std::string_view keyword) const;
  /// The number of a required keyword. The unit may follow in brackets; if `unit` is empty, no unit
  /// may follow.
  double number(std::string_view keyword, std::string_view unit) const;
  /// The number of an optional keyword on which nothing depends. No value if the keyword is absent
  /// or its number faulty; the fault is then added to `doubts`.
  std::optional<double> unused_number(std::string_view keyword, std::string_view unit,
                                      std::vector<std::string>& doubts) const;

  /// The metadata from OBJECT_NAME, OBJECT_ID, CENTER_NAME, REF_FRAME and TIME_SYSTEM.
  OrbitMetadata metadata(AcceptedFrames frames) const;

  [[noreturn]] void fail(std::string_view keyword, const std::string& problem) const;

 private:
  struct Value {
    std::size_t line;
    std::string_view text;
    std::string_view unit;  ///< the unit that an attribute in XML gives
  };
  const Value& required(std::string_view keyword, std::string_view right) const;

  const MessageLines* lines_;
  std::map<std::string_view, Value, std::less<>> values_;
  std::size_t end_ = 1;
};

/// The form in which a moment must be written, for messages.
inline constexpr std::string_view epoch_form = "YYYY-MM-DDThh:mm:ss or YYYY-DDDThh:mm:ss";

}  // namespace hamjet::io
