#include "orbit_message_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../text/letter_case.hpp"
#include "../../text/scene_message.hpp"
#include "../number_table.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

/// What the value of a mandatory keyword must be, for the message that the keyword is missing.
constexpr std::string_view any_text = "a text";

}  // namespace

MessageLines::MessageLines(const std::string& name, std::string_view text, std::string_view kind)
    : name_(name), whole_(text), rest_(text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    fail(1, "", "not ASCII, got a UTF-16 byte order mark, must be ASCII");
  }
  if (text.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  const std::size_t first = rest_.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && rest_[first] == '<') {
    statements_ = statements_of_xml(name, rest_, kind);
    number_of_lines_ = static_cast<std::size_t>(std::count(rest_.begin(), rest_.end(), '\n')) + 1;
    rest_ = {};
  }
}

/// Takes the next line's text, without blanks around it, and its number.
bool MessageLines::take_statement(MessageLine& line) {
  line = {};
  if (next_statement_ < statements_.size()) {
    const XmlStatement& statement = statements_[next_statement_++];
    number_ = line.number = statement.line;
    line.text = trimmed(statement.text);
    line.unit = statement.unit;
    return true;
  }
  if (rest_.empty()) {
    number_ = std::max(number_ + 1, number_of_lines_);
    return false;
  }
  line.number = ++number_;
  line.text = trimmed(take());
  return true;
}

/// A line ends with LF, CR, CR LF or LF CR.
std::string_view MessageLines::take() {
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end);
  if (rest_.starts_with("\r\n") || rest_.starts_with("\n\r")) rest_.remove_prefix(1);
  if (!rest_.empty()) rest_.remove_prefix(1);
  return line;
}

void MessageLines::check_characters(std::size_t line, std::string_view text) const {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte >= 0x20 && byte < 0x7f) || c == '\t') continue;
    fail(line, "", fmt::format("not a text, got the byte 0x{:02x}, must be printable ASCII", byte));
  }
}

bool MessageLines::next(MessageLine& line) {
  while (take_statement(line)) {
    // Comments may be in any language, because nothing depends on them.
    if (line.text.empty() || line.is_comment()) continue;
    const std::size_t equals = line.text.find('=');
    line.is_assignment = equals != std::string_view::npos;
    check_characters(line.number, line.text.substr(0, equals));
    line.keyword = trimmed(line.text.substr(0, equals));
    if (line.is_assignment) line.value = trimmed(line.text.substr(equals + 1));
    return true;
  }
  line = {};
  return false;
}

void MessageLines::fail(std::size_t line, std::string_view keyword,
                        const std::string& problem) const {
  throw Error(ErrorKind::input_output, fmt::format("{}:{}: {}{}{}", name_, line, printable(keyword),
                                                   keyword.empty() ? "" : ": ", problem));
}

std::string read_version(MessageLines& lines, std::string_view keyword,
                         const std::vector<std::string_view>& versions) {
  const std::string right = fmt::format("{}", fmt::join(versions, " or "));
  MessageLine line;
  if (!lines.next(line)) {
    lines.fail(1, keyword, fmt::format("missing, got an empty file, must be {}", right));
  }
  if (!line.is_assignment || line.keyword != keyword) {
    const KnownText* const other = lines.known();
    lines.fail(line.number, keyword,
               other != nullptr ? fmt::format("missing, got {}, {}; here must be {} = {}",
                                              other->name, other->use, keyword, right)
                                : fmt::format("missing, got another first line, must be {} = {}",
                                              keyword, right));
  }
  if (std::find(versions.begin(), versions.end(), line.value) == versions.end()) {
    lines.fail(line.number, keyword,
               fmt::format("unknown version, got {}, must be {}", in_quotes(line.value), right));
  }
  return std::string(line.value);
}

void MessageBlock::add(const MessageLine& line, const std::vector<std::string_view>& keywords) {
  if (!line.is_assignment) {
    lines_->fail(
        line.number, "",
        fmt::format("no assignment, got {}, must be keyword = value", in_quotes(line.text)));
  }
  if (std::find(keywords.begin(), keywords.end(), line.keyword) == keywords.end()) {
    lines_->fail(line.number, line.keyword,
                 "unknown keyword here, " + suggestion(line.keyword, keywords));
  }
  const auto [earlier, is_new] =
      values_.emplace(line.keyword, Value{line.number, line.value, line.unit});
  if (!is_new) {
    lines_->fail(line.number, line.keyword,
                 fmt::format("there twice, got it in line {} too, must be there once",
                             earlier->second.line));
  }
}

const MessageBlock::Value& MessageBlock::required(std::string_view keyword,
                                                  std::string_view right) const {
  const auto found = values_.find(keyword);
  if (found == values_.end()) {
    lines_->fail(end_, keyword, fmt::format("missing, got nothing up to here, must be {}", right));
  }
  const Value& value = found->second;
  lines_->check_characters(value.line, value.text);
  if (value.text.empty()) {
    fail(keyword, fmt::format("empty, got nothing behind \"=\", must be {}", right));
  }
  return value;
}

void MessageBlock::fail(std::string_view keyword, const std::string& problem) const {
  const auto found = values_.find(keyword);
  lines_->fail(found != values_.end() ? found->second.line : end_, keyword, problem);
}

std::string MessageBlock::text(std::string_view keyword) const {
  const Value& value = required(keyword, any_text);
  if (!value.unit.empty()) {
    fail(keyword,
         fmt::format("a text with a unit, got {}, must be without", in_quotes(value.unit)));
  }
  return std::string(value.text);
}

Epoch MessageBlock::epoch(std::string_view keyword) const {
  const Value& value = required(keyword, epoch_form);
  const auto epoch = parse_epoch(value.text);
  if (!epoch) {
    fail(keyword, fmt::format("no moment of the calendar, got {}, must be {}",
                              in_quotes(value.text), epoch_form));
  }
  return *epoch;
}

double MessageBlock::number(std::string_view keyword, std::string_view unit) const {
  const std::string right =
      unit.empty() ? "a finite number" : fmt::format("a finite number of {}", unit);
  const Value& value = required(keyword, right);
  std::string_view text = value.text;
  if (!value.unit.empty() && value.unit != unit) {
    fail(keyword, fmt::format("wrong unit, got {}, must be {}", in_quotes(value.unit),
                              unit.empty() ? "without a unit" : in_quotes(unit)));
  }
  const std::size_t bracket = text.find('[');
  if (bracket != std::string_view::npos) {
    const std::string_view given = text.substr(bracket);
    if (unit.empty() || given != fmt::format("[{}]", unit)) {
      fail(keyword,
           fmt::format("wrong unit, got {}, must be {}", in_quotes(given),
                       unit.empty() ? std::string("without a unit") : fmt::format("[{}]", unit)));
    }
    text = trimmed(text.substr(0, bracket));
  }
  const auto number = finite_number(text);
  if (!number) {
    fail(keyword, fmt::format("no number, got {}, must be {}", in_quotes(text), right));
  }
  return *number;
}

std::optional<double> MessageBlock::unused_number(std::string_view keyword, std::string_view unit,
                                                  std::vector<std::string>& doubts) const {
  if (!has(keyword)) return std::nullopt;
  try {
    return number(keyword, unit);
  } catch (const Error& error) {
    doubts.push_back(fmt::format("{}; it is not used", error.what()));
    return std::nullopt;
  }
}

std::string MessageBlock::capitals(std::string_view keyword) const {
  return io::capitals(text(keyword));
}

OrbitMetadata MessageBlock::metadata(AcceptedFrames frames) const {
  OrbitMetadata result;
  result.object_name = text("OBJECT_NAME");
  result.object_id = text("OBJECT_ID");
  result.center_name = text("CENTER_NAME");
  result.center_name_line = line_of("CENTER_NAME");
  result.reference_frame = capitals("REF_FRAME");
  if (!is_accepted_frame(result.reference_frame, frames)) {
    fail("REF_FRAME", frame_problem(result.reference_frame, frames));
  }
  std::string name = text("TIME_SYSTEM");
  const auto system = time_system_named(name);
  if (!system) {
    fail("TIME_SYSTEM", fmt::format("unknown time system, got {}, must be one of: {}",
                                    in_quotes(name), listed(time_system_names())));
  }
  result.time_system = *system;
  if (has("REF_FRAME_EPOCH")) result.reference_frame_epoch = epoch("REF_FRAME_EPOCH");
  return result;
}

}  // namespace hamjet::io
