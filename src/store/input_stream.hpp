#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "file_system.hpp"

namespace hamjet::io {

/// A text of any length that is read piece by piece, from a regular file, a pipe or standard input.
/// Devices, which may have no end, are refused. Throws Error(input_output) with path and reason,
/// and MissingFile where the file does not exist.
class InputStream {
 public:
  explicit InputStream(const std::filesystem::path& file);
  static InputStream standard_input();

  /// The printable name of the text in messages.
  const std::string& name() const { return name_; }
  /// Reads the next bytes, as many as fit, and returns their number; 0 at the end.
  std::size_t read(std::span<char> bytes);
  /// Makes sure that the text can be read again; the text of a pipe is copied to the disk.
  void keep();
  /// Starts again at the beginning of the text, after keep().
  void rewind();
  /// Throws if a regular file has changed since it was opened.
  void require_unchanged() const;

 private:
  InputStream(std::string name, Descriptor file);

  std::string name_;
  Descriptor file_;
  struct stat opened_;
};

}  // namespace hamjet::io
