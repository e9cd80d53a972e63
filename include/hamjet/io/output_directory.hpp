#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet::io {

/// Writes a set of files so that either all are there in full or the old ones are untouched: each
/// goes to a temporary file beside its place, is flushed to the disk, and commit() renames them all.
/// Temporary files that were not committed are removed.
class OutputDirectory {
 public:
  /// Creates the directory if it is missing and makes sure that it can be written to, so that a
  /// mistake shows before the computation. Throws Error(input_output) with path and reason.
  explicit OutputDirectory(std::filesystem::path path);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }

  /// Stores a file under a relative path; its folder is created. Throws Error(input_output).
  void write(const std::filesystem::path& relative, std::string_view content);
  /// Puts all files in their places, in the order in which they were written.
  void commit();

 private:
  struct Pending {
    std::filesystem::path temporary;
    std::filesystem::path target;
  };

  std::filesystem::path path_;
  std::vector<Pending> pending_;
  std::vector<std::filesystem::path> created_directories_;
};

}  // namespace hamjet::io
