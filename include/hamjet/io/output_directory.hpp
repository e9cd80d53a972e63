#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet::io {

/// Writes a set of files so that either all are there in full or the old ones are untouched: each
/// goes to a temporary file beside its place, is flushed to the disk, and commit() renames them
/// all. Temporary files that were not committed are removed.
class OutputDirectory {
 public:
  /// Makes sure that the directory can be created and written to, so that a mistake shows before
  /// the computation; leaves nothing behind, so that a computation that is broken off does not
  /// either. Throws Error(input_output) with path and reason.
  explicit OutputDirectory(std::filesystem::path path);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }

  /// Stores a file under a relative path; its folder is created. A path that was written before
  /// gets the new content. Throws Error(input_output).
  void write(const std::filesystem::path& relative, std::string_view content);
  /// Names a file of earlier results: it is removed by commit() unless it was written anew.
  void replace(const std::filesystem::path& relative);
  /// Puts all files in their places, in the order in which they were written, then removes the
  /// earlier ones that have no successor.
  void commit();

 private:
  struct Pending {
    std::filesystem::path temporary;
    std::filesystem::path target;
  };

  std::filesystem::path path_;
  std::vector<Pending> pending_;
  std::vector<std::filesystem::path> earlier_;
  std::vector<std::filesystem::path> created_directories_;
};

}  // namespace hamjet::io
