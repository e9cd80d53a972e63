#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sealed_summary.hpp"

// How a set of files takes the place of an earlier one, though a directory that holds other files
// too cannot be exchanged in one step. The new set is written to `.hamjet-new` and flushed to the
// disk; renaming that folder to `.hamjet-ready` is the one step that decides. From then on the new
// set counts, and whoever finds the folder finishes what was begun: a process that is killed leaves
// the old set untouched, or the new one to be put in place by the next hamjet. All of this is done
// under the directory's lock (see DirectoryLock), but for `is_ready`.

namespace hamjet::io {

/// The set that is being written.
class PreparedSet {
 public:
  explicit PreparedSet(std::filesystem::path directory);
  /// Removes what has not been decided.
  ~PreparedSet();
  PreparedSet(const PreparedSet&) = delete;
  PreparedSet& operator=(const PreparedSet&) = delete;

  /// Throws Error(input_output), naming the file in its final place.
  void write(const std::filesystem::path& relative, std::string_view content);
  /// Seals the summary, decides, and puts all in place. Returns the summary as it was written.
  std::string commit(const std::filesystem::path& name, std::string_view summary);

 private:
  std::filesystem::path directory_;
  std::vector<FileRecord> files_;
  std::vector<std::filesystem::path> created_;  ///< folders, outermost first
};

/// Removes what a process that was killed left of a set that is not decided.
void remove_unfinished(const std::filesystem::path& directory);

/// Whether a set is decided and not yet in place.
bool is_ready(const std::filesystem::path& directory);

/// Puts a set that is decided in its place, from wherever an earlier attempt was broken off:
/// removes the files of the earlier set of this name that the new one has not and that are still as
/// they were written, then the earlier summary; then moves the files, the summary last. Throws
/// Error(input_output); nothing is lost then.
void put_in_place(const std::filesystem::path& directory);

}  // namespace hamjet::io
