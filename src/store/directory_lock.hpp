#pragma once

#include <filesystem>
#include <vector>

#include "file_system.hpp"

namespace hamjet::io {

/// Keeps all other processes out of a directory during its lifetime; the directory is created if
/// need be. The lock is on the file `.hamjet-lock` in the directory and belongs to the kernel, so
/// that the lock of a killed process is free again, even if the file is still there. At the end the
/// file is removed, and so are the folders that were made for it if they are empty. On a file
/// system without locks there is no protection.
class DirectoryLock {
 public:
  /// Throws Error(input_output) if the directory cannot be created or written to, or if another
  /// process holds the lock; the message has the number of that process.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// False if the directory has been removed or replaced since.
  bool is_in_place() const;

  /// What a sudden end of the process would leave: the file, then the folders made for it,
  /// innermost first.
  std::vector<std::filesystem::path> leftovers() const;

 private:
  std::filesystem::path file_;
  Descriptor descriptor_;
  std::vector<std::filesystem::path> created_;  ///< folders that were created, outermost first
};

}  // namespace hamjet::io
