#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hamjet/error.hpp"

namespace hamjet::io {

/// A file that was to be read does not exist.
class MissingFile : public Error {
 public:
  MissingFile(std::filesystem::path file, const std::string& message)
      : Error(ErrorKind::input_output, message), file_(std::move(file)) {}
  const std::filesystem::path& file() const noexcept { return file_; }

 private:
  std::filesystem::path file_;
};

// The largest number of bytes that are read from a file, for each kind of file that has no header
// of its own; it exceeds what hamjet writes. For scenes, orbit messages and gravity fields it
// stands beside their readers.
inline constexpr std::size_t largest_summary_bytes = std::size_t{256} << 20;
inline constexpr std::size_t largest_jet_bytes = std::size_t{1} << 30;
inline constexpr std::size_t largest_manifest_bytes = std::size_t{1} << 30;
inline constexpr std::size_t largest_sweep_row_bytes = std::size_t{16} << 20;
inline constexpr std::size_t largest_reference_bytes = std::size_t{1} << 30;

/// All bytes of a file of at most `most_bytes`; the file may be a pipe, but not a device. Throws
/// Error(input_output) with path and reason, MissingFile where the file does not exist, and
/// Error(too_large), before reading if the size is known.
std::string read_text_file(const std::filesystem::path& file, std::size_t most_bytes);

/// The bytes of a file, or the reason why there are none.
struct FileContent {
  std::string text;
  std::string problem;        ///< reason why the file could not be read; otherwise empty
  bool is_too_large = false;  ///< the file has more bytes than allowed
  bool is_missing = false;    ///< the file does not exist
};

/// Reads a regular file of at most `most_bytes`. A directory, a pipe, a device, or a file that is
/// being written to is refused.
FileContent read_regular_file(const std::filesystem::path& file, std::size_t most_bytes);

/// The text that read_regular_file gives. If there is none, throws Error(input_output), MissingFile
/// or Error(too_large), with path and reason.
std::string require_regular_file(const std::filesystem::path& file, std::size_t most_bytes);

/// Throws the reason why the last system call, on this file, failed.
[[noreturn]] void throw_unreadable(const std::filesystem::path& file);

/// The kind of a file in words ("a directory", "a device", ...), for the mode that stat gives.
const char* kind_of_file(mode_t mode);

/// Throws that a file has no content: MissingFile where it does not exist, otherwise Error of this
/// kind.
[[noreturn]] void throw_no_content(const std::filesystem::path& file, const FileContent& content,
                                   ErrorKind kind, const std::string& message);

/// The complete path for messages, on one line.
std::string printable_path(const std::filesystem::path& file);

/// Writes the comma-separated fields of a line into `fields`.
void split_line(std::string_view line, std::vector<std::string_view>& fields);

/// Removes the first line from `text` and returns it without its end (LF, or CR LF).
std::string_view take_line(std::string_view& text);

}  // namespace hamjet::io
