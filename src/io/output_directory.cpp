#include "hamjet/io/output_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

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

/// Removes the folders of the list that are empty, the last first; one with files in it stays.
void remove_empty(const std::vector<fs::path>& folders) {
  std::error_code ignored;
  for (auto p = folders.rbegin(); p != folders.rend(); ++p) fs::remove(*p, ignored);
}

/// Creates the folder with those above it and returns the new ones, outermost first.
std::vector<fs::path> create_folders(const fs::path& folder, const std::string& problem) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path p = folder; !p.empty() && !fs::exists(p, error); p = p.parent_path()) {
    missing.insert(missing.begin(), p);
    if (p == p.parent_path()) break;
  }
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder, error)) return missing;
  remove_empty(missing);
  fail(folder, problem, error ? error.message() : "something else has this name");
}

}  // namespace

OutputDirectory::OutputDirectory(fs::path path) : path_(std::move(path)) {
  const auto created = create_folders(path_, "the output directory cannot be created");
  const fs::path probe = path_ / fmt::format(".hamjet-{}.tmp", ::getpid());
  try {
    write_all(probe, "");
  } catch (...) {
    remove_empty(created);
    throw;
  }
  std::error_code ignored;
  fs::remove(probe, ignored);
  remove_empty(created);
}

OutputDirectory::~OutputDirectory() {
  std::error_code ignored;
  for (const Pending& file : pending_) fs::remove(file.temporary, ignored);
  remove_empty(created_directories_);
}

void OutputDirectory::write(const fs::path& relative, std::string_view content) {
  const fs::path target = path_ / relative;
  const auto created = create_folders(target.parent_path(), "the directory cannot be created");
  created_directories_.insert(created_directories_.end(), created.begin(), created.end());
  // A rename over it would fail after others have been done.
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) fail(target, "cannot be written", "it is a directory");
  fs::path temporary = target;
  temporary += fmt::format(".{}.tmp", ::getpid());
  const bool is_new = std::none_of(pending_.begin(), pending_.end(),
                                   [&](const Pending& file) { return file.target == target; });
  if (is_new) pending_.push_back({temporary, target});
  write_all(temporary, content);
}

void OutputDirectory::replace(const fs::path& relative) { earlier_.push_back(path_ / relative); }

void OutputDirectory::commit() {
  for (const Pending& file : pending_) {
    std::error_code error;
    fs::rename(file.temporary, file.target, error);
    if (error) fail(file.target, "cannot be put in its place", error.message());
    flush_directory(file.target.parent_path());
    std::erase(earlier_, file.target);
  }
  pending_.clear();
  for (const fs::path& file : earlier_) {
    std::error_code ignored;
    if (fs::remove(file, ignored)) remove_empty({file.parent_path()});
  }
  earlier_.clear();
}

}  // namespace hamjet::io
