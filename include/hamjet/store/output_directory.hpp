#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet::io {

class DirectoryLock;
class PreparedSet;

/// A directory that receives sets of results, and that nobody else writes to meanwhile. A set is
/// whole: commit() puts all of its files in place, or the earlier ones are untouched. Should the
/// process be killed in the midst of that, the next hamjet that uses the directory completes it.
///
/// Each set is described by one JSON file, which lists the others with size and CRC-32 and ends
/// with the CRC-32 of itself, so that what was changed or cut later is noticed (see ResultSet).
/// Files of an earlier set of the same name are removed as far as they are still as they were
/// written; other files of the user stay.
class OutputDirectory {
 public:
  /// Locks the directory and makes sure that it can be written to, so that a mistake shows before
  /// the computation. Throws Error(input_output) with path and reason; if another process uses the
  /// directory, with its number.
  explicit OutputDirectory(std::filesystem::path path);
  /// Leaves nothing behind of what was not committed, not even the directory if it is new.
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }

  /// Stores a file of the set under a relative path; its folder is created. A path that was written
  /// before gets the new content. Throws Error(input_output).
  void write(const std::filesystem::path& relative, std::string_view content);

  /// Puts the set in place. The file that was written last must be a JSON object at the top of the
  /// directory: it describes the set, and gets the keys "files" and "crc32". Returns it as it was
  /// put there. Throws Error(input_output). Another set may follow.
  std::string commit();

  /// What a sudden end of the process would leave behind, to be removed in this order by a signal
  /// handler: a hidden file, then the folders that were made for it, as far as they are empty.
  std::vector<std::filesystem::path> leftovers() const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<DirectoryLock> lock_;
  std::unique_ptr<PreparedSet> set_;  ///< while one is being written
  std::filesystem::path last_path_;   ///< kept until the next file shows whether it is the summary
  std::string last_content_;
};

}  // namespace hamjet::io
