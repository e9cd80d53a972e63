#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet::io {

class DirectoryLock;
class PreparedSet;

/// A directory that receives sets of results, locked against other processes. A set is complete or
/// absent: commit() either puts all of its files in place or leaves the earlier ones untouched. If
/// the process is killed during commit(), the next hamjet that uses the directory completes the
/// work.
///
/// Each set is described by one JSON file, which lists the others with size and CRC-32 and ends
/// with the CRC-32 of itself, so that a file that was changed or cut later is noticed (see
/// ResultSet). Files of an earlier set of the same name are removed if they are still as they were
/// written; other files of the user stay.
class OutputDirectory {
 public:
  /// Locks the directory and checks that it can be written to, so that a mistake shows before the
  /// computation. Throws Error(input_output) with path and reason; if another process uses the
  /// directory, the reason has the number of that process.
  explicit OutputDirectory(std::filesystem::path path);
  /// Removes everything that was not committed, and the directory too if it is new.
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }

  /// Stores a file of the set under a relative path; its folder is created. A second write to the
  /// same path replaces the first. Throws Error(input_output).
  void write(const std::filesystem::path& relative, std::string_view content);

  /// Puts the set in place. The file that was written last must be a JSON object at the top of the
  /// directory. It describes the set, and the keys "files" and "crc32" are added to it. Returns
  /// this file as it was put in place. Throws Error(input_output). Another set may follow.
  std::string commit();

  /// What a sudden end of the process would leave behind: a hidden file, then the folders that were
  /// made for it. A signal handler may remove these in this order, the folders if they are empty.
  std::vector<std::filesystem::path> leftovers() const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<DirectoryLock> lock_;
  std::unique_ptr<PreparedSet> set_;  ///< set while files are being written
  std::filesystem::path last_path_;  ///< kept until a further file shows that it is not the summary
  std::string last_content_;
};

}  // namespace hamjet::io
