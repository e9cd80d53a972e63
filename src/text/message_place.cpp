#include "message_place.hpp"

#include "scene_message.hpp"
#include "whole_number.hpp"

namespace hamjet::io {
namespace {

constexpr std::string_view separator = ": ";

/// Takes `:number` off the front of the text. Where the text does not begin so, nothing is taken
/// and there is no value.
std::optional<std::size_t> take_number(std::string_view& text) {
  if (!text.starts_with(':')) return std::nullopt;
  const std::size_t end = std::min(text.find(':', 1), text.size());
  const auto number = whole_number<std::size_t>(std::string(text.substr(1, end - 1)));
  if (number) text.remove_prefix(end);
  return number;
}

/// Takes the name of a file off the front of the text, with line and column if these follow.
void take_file(std::string_view& text, std::string_view file, PlacedMessage& result) {
  const std::string_view head = text.substr(0, text.find(separator));
  const std::string_view name =
      text.starts_with(file) ? file : head.substr(0, std::min(head.find(':'), head.size()));
  std::string_view rest = text.substr(name.size());
  const auto line = take_number(rest);
  const auto column = take_number(rest);
  // A name without a line is taken for a file only if it is the name of the scene.
  if (!rest.starts_with(separator) || (!line && name != file)) return;
  result.file = std::string(name);
  result.line = line;
  result.column = column;
  text = rest.substr(separator.size());
}

}  // namespace

PlacedMessage placed(std::string_view message, std::string_view file) {
  PlacedMessage result;
  const std::string option = override_source("");
  if (message.starts_with(option)) {
    message.remove_prefix(option.size());
  } else {
    take_file(message, file, result);
  }
  const std::size_t end = message.find(separator);
  const std::string_view key = message.substr(0, end);
  if (end != std::string_view::npos && key.find(' ') == std::string_view::npos) {
    result.key = std::string(key);
    message.remove_prefix(end + separator.size());
  }
  result.problem = std::string(message);
  return result;
}

}  // namespace hamjet::io
