#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet::io {

/// All bytes of a file, which may be a pipe. Throws Error(input_output) with path and reason.
std::string read_text_file(const std::filesystem::path& file);

/// A path for messages, whole, on one line.
std::string printable_path(const std::filesystem::path& file);

/// The fields between the commas of a line, into `fields`.
void split_line(std::string_view line, std::vector<std::string_view>& fields);

/// Takes the first line off `text`, without its end (LF, or CR LF).
std::string_view take_line(std::string_view& text);

}  // namespace hamjet::io
