#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "file_system.hpp"

namespace hamjet::io {

/// A text that is read piece by piece, however long it is: of a regular file, a pipe or standard
/// input; of no device, which may have no end. Throws Error(input_output) with path and reason,
/// MissingFile where the file is not there.
class InputStream {
 public:
  explicit InputStream(const std::filesystem::path& file);
  static InputStream standard_input();

  /// What messages call it, printable.
  const std::string& name() const { return name_; }
  /// The next bytes, as many as there is room for; 0 at the end.
  std::size_t read(std::span<char> bytes);
  /// Makes sure that the text can be read again: that of a pipe is copied to the disk.
  void keep();
  /// Begins anew, after keep().
  void rewind();
  /// Throws if a regular file is not what it was when it was opened.
  void require_unchanged() const;

 private:
  InputStream(std::string name, Descriptor file);

  std::string name_;
  Descriptor file_;
  struct stat opened_;
};

}  // namespace hamjet::io
