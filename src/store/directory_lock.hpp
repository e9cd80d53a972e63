#pragma once

#include <filesystem>
#include <vector>

#include "file_system.hpp"

namespace hamjet::io {

/// Keeps all others out of a directory while it lives, which is created if need be. The lock is on
/// the file `.hamjet-lock` in it and belongs to the kernel: that of a process that was killed is
/// free again, whatever file it left. At the end the file is removed, and the folders that were
/// made for it as far as they are empty. On a file system that has no locks there is none.
class DirectoryLock {
 public:
  /// Throws Error(input_output) if the directory cannot be created or written to, or if another
  /// process holds the lock, with its number.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// False if the directory was removed or replaced since.
  bool is_in_place() const;

  /// What a sudden end would leave: the file, then the folders made for it, innermost first.
  std::vector<std::filesystem::path> leftovers() const;

 private:
  std::filesystem::path file_;
  Descriptor descriptor_;
  std::vector<std::filesystem::path> created_;  ///< outermost first
};

}  // namespace hamjet::io
