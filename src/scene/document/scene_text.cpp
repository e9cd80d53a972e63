#include "scene_text.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "../../formats/orbit_messages/known_text.hpp"
#include "../../store/text_file.hpp"
#include "../../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "scene_token_scanner.hpp"

namespace hamjet::io {
namespace {

[[noreturn]] void throw_too_long(std::string_view source, std::uintmax_t bytes) {
  throw_scene_error(source, fmt::format("the scene is too large, got {} bytes, must be at most {}",
                                        bytes, largest_scene_bytes));
}

void check_encoding(std::string_view text, std::string_view source) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw_scene_error(source,
                      "not UTF-8, got a UTF-16 byte order mark at byte offset 0, must be UTF-8");
  }
  for (std::size_t offset = 0; offset < text.size();) {
    const std::size_t length = utf8_sequence_length(text.substr(offset));
    if (length == 0) {
      throw_scene_error(source,
                        fmt::format("not UTF-8, got the byte 0x{:02x} at byte offset {}, must be "
                                    "UTF-8",
                                    static_cast<unsigned char>(text[offset]), offset));
    }
    if (text[offset] == '\0') {
      throw_scene_error(
          source,
          fmt::format("not a text, got a NUL byte at byte offset {}, must be TOML", offset));
    }
    offset += length;
  }
}

}  // namespace

std::string read_scene_file(const std::filesystem::path& file) {
  FileContent content = read_regular_file(file, largest_scene_bytes);
  if (!content.problem.empty()) {
    throw_no_content(
        file, content, content.is_too_large ? ErrorKind::scene : ErrorKind::input_output,
        fmt::format("{}: the scene cannot be read: {}", printable_path(file), content.problem));
  }
  return std::move(content.text);
}

std::string_view check_scene_text(std::string_view text, std::string_view source) {
  if (text.size() > largest_scene_bytes) throw_too_long(source, text.size());
  check_encoding(text, source);
  if (const KnownText* const other = known_text(text)) {
    throw_scene_error(
        source,
        fmt::format("no scene, got {}, {}{}", other->name, other->use,
                    other->example.empty()
                        ? ""
                        : fmt::format("; must be a scene that names it, {}", other->example)));
  }
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  check_tokens(text, source);
  return text;
}

}  // namespace hamjet::io
