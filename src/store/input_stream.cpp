#include "input_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "hamjet/error.hpp"
#include "text_file.hpp"

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

/// Opens a file or a pipe. Devices are recognised by their name before opening, because opening a
/// device may already have an effect.
Descriptor open_file_or_pipe(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) throw_unreadable(file);
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) {
    throw_file_error(
        file, "cannot be read",
        fmt::format("it is {}, must be a file or a pipe", kind_of_file(status.st_mode)));
  }
  Descriptor descriptor(file, O_RDONLY);
  if (!descriptor.is_open()) throw_unreadable(file);
  return descriptor;
}

}  // namespace

InputStream::InputStream(std::string name, Descriptor file)
    : name_(std::move(name)), file_(std::move(file)), opened_{} {
  if (!file_.is_open() || ::fstat(file_.value(), &opened_) != 0) {
    throw_file_error(name_, "cannot be read", errno_text());
  }
}

InputStream::InputStream(const fs::path& file)
    : InputStream(printable_path(file), open_file_or_pipe(file)) {}

InputStream InputStream::standard_input() {
  return {"standard input", Descriptor::duplicate(STDIN_FILENO)};
}

std::size_t InputStream::read(std::span<char> bytes) {
  while (true) {
    const ssize_t count = ::read(file_.value(), bytes.data(), bytes.size());
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) throw_file_error(name_, "cannot be read", errno_text());
  }
}

void InputStream::keep() {
  if (S_ISREG(opened_.st_mode)) return;
  fs::path folder;
  Descriptor copy = unnamed_temporary_file(folder);
  std::array<char, 65536> buffer;
  while (const std::size_t count = read(buffer)) {
    write_all(copy, {buffer.data(), count}, folder);
  }
  file_ = std::move(copy);
  ::fstat(file_.value(), &opened_);
  rewind();
}

void InputStream::rewind() {
  if (::lseek(file_.value(), 0, SEEK_SET) != 0) {
    throw_file_error(name_, "cannot be read again", errno_text());
  }
}

void InputStream::require_unchanged() const {
  struct stat now {};
  if (!S_ISREG(opened_.st_mode)) return;
  const bool is_as_before = ::fstat(file_.value(), &now) == 0 && now.st_size == opened_.st_size &&
                            now.st_mtim.tv_sec == opened_.st_mtim.tv_sec &&
                            now.st_mtim.tv_nsec == opened_.st_mtim.tv_nsec;
  if (is_as_before) return;
  throw_file_error(name_, "cannot be read", "it changed meanwhile; run again when it is saved");
}

}  // namespace hamjet::io
