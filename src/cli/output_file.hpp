#pragma once

#include <filesystem>
#include <string>

namespace hamjet::cli {

/// The one file that the user named, written in full or not at all. Errors are
/// Error(input_output), unless said otherwise.
class OutputFile {
 public:
  /// Makes sure that the file can be written, so that a mistake shows before the work. Throws
  /// Error(usage) for a file of a set of results, which would no longer be whole.
  explicit OutputFile(const std::filesystem::path& file);

  void write(const std::string& content) const;

 private:
  std::filesystem::path file_;
};

}  // namespace hamjet::cli
