#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sealed_summary.hpp"

// How a set of files replaces an earlier one, although a directory that also holds other files
// cannot be exchanged in one step. The new set is written to `.hamjet-new` and flushed to the disk.
// Renaming that folder to `.hamjet-ready` is the single step that decides: from then on the new set
// counts, and any hamjet that finds the folder finishes the work. A process that is killed thus
// leaves either the old set untouched, or the new one to be put in place. All of this is done under
// the directory's lock (see DirectoryLock), except `is_ready`.

namespace hamjet::io {

/// The set that is being written.
class PreparedSet {
 public:
  explicit PreparedSet(std::filesystem::path directory);
  /// Removes the set if it has not been decided.
  ~PreparedSet();
  PreparedSet(const PreparedSet&) = delete;
  PreparedSet& operator=(const PreparedSet&) = delete;

  /// Writes a file. Throws Error(input_output) that names the file in its final place.
  void write(const std::filesystem::path& relative, std::string_view content);
  /// Seals the summary, decides the set, and puts all files in place. Returns the summary as it was
  /// written.
  std::string commit(const std::filesystem::path& name, std::string_view summary);

 private:
  std::filesystem::path directory_;
  std::vector<FileRecord> files_;
  std::vector<std::filesystem::path> created_;  ///< folders that were created, outermost first
};

/// Removes an undecided set that a killed process has left.
void remove_unfinished(const std::filesystem::path& directory);

/// Whether a set is decided and not yet in place.
bool is_ready(const std::filesystem::path& directory);

/// Puts a decided set in its place, from wherever an earlier attempt broke off. First it removes
/// the earlier summary and those files of the earlier set of this name that are still as they were
/// written and not in the new set; then it moves the files, the summary last. Throws
/// Error(input_output); nothing is lost then.
void put_in_place(const std::filesystem::path& directory);

}  // namespace hamjet::io
