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

/// A file that was to be read and is not there.
class MissingFile : public Error {
 public:
  MissingFile(std::filesystem::path file, const std::string& message)
      : Error(ErrorKind::input_output, message), file_(std::move(file)) {}
  const std::filesystem::path& file() const noexcept { return file_; }

 private:
  std::filesystem::path file_;
};

// The most bytes that are read of a file of each kind that has no header of its own: more than
// hamjet writes of it. A scene, an orbit message and a gravity field have theirs beside their
// readers.
inline constexpr std::size_t largest_summary_bytes = std::size_t{256} << 20;
inline constexpr std::size_t largest_jet_bytes = std::size_t{1} << 30;
inline constexpr std::size_t largest_manifest_bytes = std::size_t{1} << 30;
inline constexpr std::size_t largest_sweep_row_bytes = std::size_t{16} << 20;
inline constexpr std::size_t largest_reference_bytes = std::size_t{1} << 30;

/// All bytes of a file of at most `most_bytes`, which may be a pipe, but no device. Throws
/// Error(input_output) with path and reason, MissingFile where it is not there, Error(too_large)
/// before reading where the size is known.
std::string read_text_file(const std::filesystem::path& file, std::size_t most_bytes);

/// The bytes of a file, or why there are none.
struct FileContent {
  std::string text;
  std::string problem;        ///< not empty: it could not be read, and why
  bool is_too_large = false;  ///< it has more than the bytes allowed
  bool is_missing = false;    ///< it is not there
};

/// Reads a regular file of at most `most_bytes`: not a directory, a pipe or a device, and not one
/// that is written to meanwhile.
FileContent read_regular_file(const std::filesystem::path& file, std::size_t most_bytes);

/// The text that read_regular_file gives; without one, throws Error(input_output), MissingFile or
/// Error(too_large), with path and reason.
std::string require_regular_file(const std::filesystem::path& file, std::size_t most_bytes);

/// Throws why the last call of the system, on this file, failed.
[[noreturn]] void throw_unreadable(const std::filesystem::path& file);

/// "a directory", "a device", ..., of the mode that stat gives.
const char* kind_of_file(mode_t mode);

/// Throws that a file has no content: MissingFile where it is not there, else Error of this kind.
[[noreturn]] void throw_no_content(const std::filesystem::path& file, const FileContent& content,
                                   ErrorKind kind, const std::string& message);

/// A path for messages, whole, on one line.
std::string printable_path(const std::filesystem::path& file);

/// The fields between the commas of a line, into `fields`.
void split_line(std::string_view line, std::vector<std::string_view>& fields);

/// Takes the first line off `text`, without its end (LF, or CR LF).
std::string_view take_line(std::string_view& text);

}  // namespace hamjet::io
