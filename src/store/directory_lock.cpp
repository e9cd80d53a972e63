#include "directory_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <string>

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

/// If somebody removes the file while it is being opened, another attempt is needed.
constexpr int most_attempts = 100;

/// Whether the path still leads to the open file.
bool leads_to(const fs::path& path, int descriptor) {
  struct stat open_file {};
  struct stat named_file {};
  return ::fstat(descriptor, &open_file) == 0 && ::lstat(path.c_str(), &named_file) == 0 &&
         open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
}

/// The holder as "process 1234", from the content of the lock file.
std::string holder(int descriptor) {
  std::array<char, 32> text;
  const ssize_t length = ::pread(descriptor, text.data(), text.size(), 0);
  pid_t process = 0;
  if (length > 0) std::from_chars(text.data(), text.data() + length, process);
  return process > 0 ? fmt::format("process {}", process) : "a process that has just begun";
}

void write_holder(int descriptor) {
  // The name may be a hard link to a file of the user with content of its own, which must not be
  // overwritten.
  struct stat status {};
  const bool is_ours =
      ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1;
  if (!is_ours) return;
  // The number serves messages only, so that a full disk does not matter here.
  const std::string text = fmt::format("{}\n", ::getpid());
  [[maybe_unused]] const bool is_written =
      ::ftruncate(descriptor, 0) == 0 && ::pwrite(descriptor, text.data(), text.size(), 0) > 0;
}

/// Takes the lock; false if another process has it.
bool try_to_lock(int descriptor) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return false;
    if (errno != EINTR) return true;  // the file system has no locks
  }
  return true;
}

}  // namespace

DirectoryLock::DirectoryLock(const fs::path& directory) : file_(directory / ".hamjet-lock") {
  for (int attempt = 1;; ++attempt) {
    const auto folders = create_folders(directory, "the output directory cannot be created");
    created_.insert(created_.end(), folders.begin(), folders.end());
    descriptor_ = Descriptor(file_, O_RDWR | O_CREAT | O_NOFOLLOW);
    if (!descriptor_.is_open()) {
      if (errno == ENOENT && attempt < most_attempts) continue;
      const std::string reason = errno_text();
      remove_empty(created_);
      throw_file_error(directory, "the output directory cannot be written", reason);
    }
    if (!try_to_lock(descriptor_.value())) {
      throw_file_error(directory, "the output directory is in use by another hamjet",
                       holder(descriptor_.value()) + "; wait for its end or choose another -o");
    }
    // The last holder may have removed the file just before the lock was taken.
    if (leads_to(file_, descriptor_.value()) || attempt >= most_attempts) break;
  }
  write_holder(descriptor_.value());
}

DirectoryLock::~DirectoryLock() {
  // The file is removed while it is locked: a process that has opened it meanwhile finds that its
  // name is gone, and tries again.
  if (is_in_place()) ::unlink(file_.c_str());
  remove_empty(created_);
}

bool DirectoryLock::is_in_place() const { return leads_to(file_, descriptor_.value()); }

std::vector<fs::path> DirectoryLock::leftovers() const {
  std::vector<fs::path> paths = {file_};
  paths.insert(paths.end(), created_.rbegin(), created_.rend());
  return paths;
}

}  // namespace hamjet::io
