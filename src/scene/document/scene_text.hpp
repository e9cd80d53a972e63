#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace hamjet::io {

/// Largest scene in bytes; a real one has a few thousand.
inline constexpr std::size_t largest_scene_bytes = std::size_t{1} << 20;

/// The bytes of a scene file. Throws Error(input_output) with the path and the reason if it is
/// missing, unreadable, not a regular file (a directory, a pipe, a device), or written to while it
/// is read, and Error(scene) if it is larger than `largest_scene_bytes`.
std::string read_scene_file(const std::filesystem::path& file);

/// Checks the text before TOML is parsed, and returns it without a UTF-8 byte order mark. `source`
/// is the name for messages, already printable. Throws Error(scene) with
///  - the kind of the text, if it is an orbit message or two-line elements, and how a scene names
///    such a file;
///  - the size, if the text is larger than `largest_scene_bytes`;
///  - the byte offset of a UTF-16 byte order mark, of a byte that is not UTF-8, or of a NUL;
///  - line, column and key of a number that binary64 or a 64-bit integer cannot hold (the parser
///    would turn 1e-400 into 0 without a word);
///  - line and column of a character outside strings and comments that is not ASCII, at some of
///    which the parser's behaviour is undefined;
///  - line and column of tables and arrays nested deeper than any scene needs (freeing a deeply
///    nested table recurses, so that 100 000 levels would overflow the stack).
std::string_view check_scene_text(std::string_view text, std::string_view source);

}  // namespace hamjet::io
