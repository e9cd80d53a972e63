// Loaded into the command before it starts: lets one call that writes to the disk fail, as a full
// or broken disk does, one that takes memory, or one that starts a thread. HAMJET_FAILING_CALL
// names it and says which of these calls, counted from 1: "write:3", "malloc:200". Of those with a
// descriptor the ones on files that were opened for writing alone are counted; a write that fails
// has written half of what it should. "stall:3" is the third flush, which never ends.
// HAMJET_NO_UNNAMED_FILES stands for a file system that has no files without a name, and
// HAMJET_NO_EXCLUSIVE_RENAME for one that cannot rename without replacing.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::array<bool, 1024> is_written{};

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// Whether this call is the one.
bool must_fail(const char* name) {
  static int calls = 0;
  const char* wanted = std::getenv("HAMJET_FAILING_CALL");
  const std::size_t length = std::strlen(name);
  if (wanted == nullptr || std::strncmp(wanted, name, length) != 0 || wanted[length] != ':') {
    return false;
  }
  if (++calls != std::atoi(wanted + length + 1)) return false;
  errno = ENOSPC;
  return true;
}

bool is_counted(int descriptor) {
  return descriptor >= 0 && descriptor < static_cast<int>(is_written.size()) &&
         is_written[static_cast<std::size_t>(descriptor)];
}

}  // namespace

extern "C" {

void* __libc_malloc(size_t bytes);  // NOLINT: the GNU library's name

void* malloc(size_t bytes) noexcept {
  if (!must_fail("malloc")) return __libc_malloc(bytes);
  errno = ENOMEM;
  return nullptr;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) noexcept {
  if (must_fail("pthread_create")) return EAGAIN;
  return next<decltype(&pthread_create)>("pthread_create")(thread, attributes, start, argument);
}

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const bool is_unnamed = (flags & O_TMPFILE) == O_TMPFILE;
  const mode_t mode = (flags & O_CREAT) != 0 || is_unnamed ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  if (is_unnamed && std::getenv("HAMJET_NO_UNNAMED_FILES") != nullptr) {
    errno = EOPNOTSUPP;
    return -1;
  }
  const bool is_output = (flags & O_ACCMODE) == O_WRONLY;
  if (is_output && must_fail("open")) return -1;
  const int descriptor = next<int (*)(const char*, int, mode_t)>("open")(path, flags, mode);
  if (descriptor >= 0 && descriptor < static_cast<int>(is_written.size())) {
    is_written[static_cast<std::size_t>(descriptor)] = is_output;
  }
  return descriptor;
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  static const auto original = next<ssize_t (*)(int, const void*, size_t)>("write");
  static bool is_full = false;
  if (is_counted(descriptor) && (is_full || must_fail("write"))) {
    errno = ENOSPC;
    if (is_full) return -1;
    is_full = true;
    return count < 2 ? -1 : original(descriptor, bytes, count / 2);
  }
  return original(descriptor, bytes, count);
}

int fsync(int descriptor) {
  if (is_counted(descriptor) && must_fail("fsync")) return -1;
  if (is_counted(descriptor) && must_fail("stall")) {
    while (true) ::sleep(1000);
  }
  return next<int (*)(int)>("fsync")(descriptor);
}

int close(int descriptor) {
  const bool fails = is_counted(descriptor) && must_fail("close");
  const int error = errno;
  if (is_counted(descriptor)) is_written[static_cast<std::size_t>(descriptor)] = false;
  const int result = next<int (*)(int)>("close")(descriptor);
  if (!fails) return result;
  errno = error;
  return -1;
}

int rename(const char* from, const char* to) noexcept {
  if (must_fail("rename")) return -1;
  return next<int (*)(const char*, const char*)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  if (flags != 0 && std::getenv("HAMJET_NO_EXCLUSIVE_RENAME") != nullptr) {
    errno = EINVAL;
    return -1;
  }
  return next<decltype(&renameat2)>("renameat2")(from_folder, from, to_folder, to, flags);
}

int mkdir(const char* path, mode_t mode) noexcept {
  if (must_fail("mkdir")) return -1;
  return next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}
}
