#include "whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "held_signals.hpp"
#include "text_file.hpp"

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

/// The path by which the kernel gives access to an open file.
std::string name_of_open(const Descriptor& file) {
  return fmt::format("/proc/self/fd/{}", file.value());
}

}  // namespace

WholeFile::WholeFile(fs::path path)
    : path_(std::move(path)), folder_(path_.has_parent_path() ? path_.parent_path() : ".") {
  refuse_replacing_link(path_);
  created_ = create_folders(folder_, "the directory cannot be created");
  try {
    temporary_ = temporary_in(folder_);
    file_ = Descriptor(folder_, O_WRONLY | O_TMPFILE);
    if (file_.is_open() && ::access(name_of_open(file_).c_str(), F_OK) == 0) return;
    file_ = Descriptor(temporary_, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
    if (!file_.is_open()) throw_file_error(path_, "cannot be written", errno_text());
    is_named_ = true;
  } catch (...) {
    remove_empty(created_);
    throw;
  }
}

WholeFile::~WholeFile() {
  if (is_named_) ::unlink(temporary_.c_str());
  remove_empty(created_);
}

void WholeFile::write(std::string_view content) { write_all(file_, content, path_); }

void WholeFile::give_name(Flush flush) {
  if (flush == Flush::yes) io::flush(file_, path_);
  if (!is_named_ && ::linkat(AT_FDCWD, name_of_open(file_).c_str(), AT_FDCWD, temporary_.c_str(),
                             AT_SYMLINK_FOLLOW) != 0) {
    throw_file_error(path_, "cannot be put in its place", errno_text());
  }
  is_named_ = true;
  if (!file_.close()) throw_file_error(path_, "cannot be closed", errno_text());
}

void WholeFile::replace(Flush flush) {
  give_name(flush);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
    throw_file_error(path_, "cannot be put in its place", errno_text());
  }
  is_named_ = false;
  if (flush == Flush::yes) flush_folder(folder_);
}

bool WholeFile::put_where_nothing_is() {
  give_name(Flush::yes);
  int result = ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), RENAME_NOREPLACE);
  if (result == 0) {
    is_named_ = false;
  } else if (errno == EINVAL || errno == ENOSYS) {
    // The file system does not support this kind of rename. A second name (hard link) fails in the
    // same way where a file is there.
    result = ::link(temporary_.c_str(), path_.c_str());
  }
  if (result != 0 && errno == EEXIST) return false;
  if (result != 0) throw_file_error(path_, "cannot be put in its place", errno_text());
  flush_folder(folder_);
  return true;
}

std::vector<fs::path> WholeFile::leftovers() const {
  std::vector<fs::path> paths = {temporary_};
  paths.insert(paths.end(), created_.rbegin(), created_.rend());
  return paths;
}

void refuse_replacing_link(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::read_symlink(path, error);
  if (error) return;
  throw_file_error(path, "cannot be written",
                   fmt::format("it is a symbolic link to {}, which would be replaced; name the "
                               "file itself, or remove the link",
                               printable_path(target)));
}

void require_writable(const fs::path& folder) {
  // Nobody removes what the probe leaves if a signal ends the program within it.
  const HeldSignals held;
  const WholeFile probe(temporary_in(folder));
}

void replace_sealed_file(const fs::path& path, std::string_view content) {
  WholeFile file(path);
  file.write(content);
  file.replace(Flush::no);
}

void write_whole_file(const fs::path& path, std::string_view content) {
  WholeFile file(path);
  file.write(content);
  file.replace(Flush::yes);
}

}  // namespace hamjet::io
