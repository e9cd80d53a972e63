#include "hamjet/io/output_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& what, const std::string& reason) {
  throw Error(ErrorKind::input_output, fmt::format("{}: {}: {}", path.string(), what, reason));
}

std::string errno_text() { return std::strerror(errno); }  // NOLINT(concurrency-mt-unsafe)

/// A file descriptor that is closed when it goes.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : value_(::open(path.c_str(), flags, 0644)) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }
  /// Closes now and tells whether that worked: a full disk can show here only.
  bool close() { return ::close(std::exchange(value_, -1)) == 0; }

 private:
  int value_;
};

void write_all(const fs::path& path, std::string_view content) {
  Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
  if (file.value() < 0) fail(path, "cannot be written", errno_text());
  while (!content.empty()) {
    const ssize_t written = ::write(file.value(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      fail(path, fmt::format("cannot be written ({} bytes left)", content.size()), errno_text());
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(file.value()) != 0 && errno != EINVAL) fail(path, "cannot be flushed", errno_text());
  if (!file.close()) fail(path, "cannot be closed", errno_text());
}

/// Makes renames durable. Some file systems refuse to flush a directory; that loses nothing else.
void flush_directory(const fs::path& path) {
  const Descriptor directory(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory.value() >= 0) ::fsync(directory.value());
}

}  // namespace

OutputDirectory::OutputDirectory(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  // Folders that did not exist are noted, so that a failure leaves none behind.
  std::vector<fs::path> missing;
  for (fs::path p = path_; !p.empty() && !fs::exists(p, error); p = p.parent_path()) {
    missing.insert(missing.begin(), p);
    if (p == p.parent_path()) break;
  }
  fs::create_directories(path_, error);
  if (error) fail(path_, "the output directory cannot be created", error.message());
  if (!fs::is_directory(path_, error)) fail(path_, "the output is not a directory", "choose another");
  created_directories_ = missing;
  const fs::path probe = path_ / fmt::format(".hamjet-{}.tmp", ::getpid());
  try {
    write_all(probe, "");
  } catch (...) {
    for (auto p = missing.rbegin(); p != missing.rend(); ++p) fs::remove(*p, error);
    throw;
  }
  fs::remove(probe, error);
}

OutputDirectory::~OutputDirectory() {
  std::error_code ignored;
  for (const Pending& file : pending_) fs::remove(file.temporary, ignored);
  // Removes folders that stayed empty; a folder with files in it is not removed by this call.
  for (auto p = created_directories_.rbegin(); p != created_directories_.rend(); ++p) {
    fs::remove(*p, ignored);
  }
}

void OutputDirectory::write(const fs::path& relative, std::string_view content) {
  const fs::path target = path_ / relative;
  std::error_code error;
  if (!fs::exists(target.parent_path(), error)) created_directories_.push_back(target.parent_path());
  fs::create_directories(target.parent_path(), error);
  if (error) fail(target.parent_path(), "the directory cannot be created", error.message());
  fs::path temporary = target;
  temporary += fmt::format(".{}.tmp", ::getpid());
  pending_.push_back({temporary, target});
  write_all(temporary, content);
}

void OutputDirectory::commit() {
  for (const Pending& file : pending_) {
    std::error_code error;
    fs::rename(file.temporary, file.target, error);
    if (error) fail(file.target, "cannot be put in its place", error.message());
    flush_directory(file.target.parent_path());
  }
  pending_.clear();
}

}  // namespace hamjet::io
