#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet::io {

/// All bytes of a file, which may be a pipe. Throws Error(input_output) with path and reason.
std::string read_text_file(const std::filesystem::path& file);

/// The bytes of a file, or why there are none.
struct FileContent {
  std::string text;
  std::string problem;        ///< not empty: it could not be read, and why
  bool is_too_large = false;  ///< that is why
};

/// Reads a regular file of at most so many bytes: not a directory, a pipe or a device, and not one
/// that is written to meanwhile.
FileContent read_regular_file(const std::filesystem::path& file, std::size_t most_bytes);

/// A path for messages, whole, on one line.
std::string printable_path(const std::filesystem::path& file);

/// The fields between the commas of a line, into `fields`.
void split_line(std::string_view line, std::vector<std::string_view>& fields);

/// Takes the first line off `text`, without its end (LF, or CR LF).
std::string_view take_line(std::string_view& text);

}  // namespace hamjet::io
