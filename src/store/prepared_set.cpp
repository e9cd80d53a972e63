#include "prepared_set.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

#include "file_system.hpp"
#include "hamjet/error.hpp"
#include "text_file.hpp"
#include "whole_file.hpp"

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

fs::path unfinished(const fs::path& directory) { return directory / ".hamjet-new"; }
fs::path ready(const fs::path& directory) { return directory / ".hamjet-ready"; }

void remove_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

/// The regular files below a folder, relative to it; empty if the folder does not exist.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::path& entry : entries_below(folder)) {
    if (!fs::is_regular_file(fs::symlink_status(entry, error))) continue;
    files.push_back(entry.lexically_relative(folder));
  }
  return files;
}

void flush_folders_below(const fs::path& folder) {
  flush_folder(folder);
  std::error_code error;
  for (const fs::path& entry : entries_below(folder)) {
    if (fs::is_directory(entry, error)) flush_folder(entry);
  }
}

/// Throws where a later rename would fail because a directory has the file's name, or a file that
/// of a folder. Without this check other files would already have been renamed.
void require_place(const fs::path& directory, const fs::path& relative) {
  const fs::path target = directory / relative;
  refuse_link_on_the_way(directory, relative);
  refuse_replacing_link(target);
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) {
    throw_file_error(target, "cannot be written", "it is a directory");
  }
  for (fs::path p = target.parent_path(); p != directory && !p.empty(); p = p.parent_path()) {
    if (fs::exists(p, ignored) && !fs::is_directory(p, ignored)) {
      throw_file_error(target, "cannot be written",
                       fmt::format("{} is not a directory", printable_path(p)));
    }
  }
}

void move_file(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) == 0) return;
  if (errno == EXDEV) {  // another file system is mounted in the folder
    write_whole_file(to, read_text_file(from, std::numeric_limits<std::size_t>::max()));
    ::unlink(from.c_str());
    return;
  }
  throw_file_error(to, "cannot be put in its place",
                   errno_text() + "; the next hamjet in this directory tries again");
}

/// The text of a regular file of at most `most_bytes`; empty if the file cannot be read.
std::string text_if_any(const fs::path& file, std::size_t most_bytes) {
  std::error_code ignored;
  if (!fs::is_regular_file(fs::symlink_status(file, ignored))) return "";
  return read_regular_file(file, most_bytes).text;
}

/// Throws for a decided set that does not belong to this user: whoever may create folders in the
/// directory could otherwise make this user put foreign files anywhere.
void require_own(const fs::path& folder) {
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0 || status.st_uid == ::geteuid()) return;
  throw_file_error(folder, "holds results that another user is putting in place",
                   fmt::format("user {}; remove it, or choose another directory", status.st_uid));
}

void remove_earlier(const fs::path& directory, const fs::path& name,
                    const std::vector<FileRecord>& successors) {
  for (const FileRecord& file :
       sealed_files(text_if_any(directory / name, largest_summary_bytes))) {
    const bool has_successor =
        std::any_of(successors.begin(), successors.end(),
                    [&](const FileRecord& successor) { return successor.path == file.path; });
    if (has_successor || !link_on_the_way(directory, file.path).empty()) continue;
    const fs::path path = directory / file.path;
    const FileRecord found = record_of(file.path, text_if_any(path, file.bytes));
    // A file that somebody has changed since then belongs to them and stays.
    if (found.bytes != file.bytes || found.crc32 != file.crc32) continue;
    ::unlink(path.c_str());
    if (path.parent_path() != directory) remove_empty({path.parent_path()});
  }
  ::unlink((directory / name).c_str());
  flush_folder(directory);
}

}  // namespace

PreparedSet::PreparedSet(fs::path directory) : directory_(std::move(directory)) {
  const fs::path folder = unfinished(directory_);
  // Whatever has this name now is a leftover, or somebody's link to another place.
  remove_folder(folder);
  if (::mkdir(folder.c_str(), 0777) != 0) {
    throw_file_error(directory_, "the results cannot be prepared", errno_text());
  }
}

PreparedSet::~PreparedSet() {
  remove_folder(unfinished(directory_));
  remove_empty(created_);
}

void PreparedSet::write(const fs::path& relative, std::string_view content) {
  require_place(directory_, relative);
  const fs::path file = unfinished(directory_) / "files" / relative;
  create_folders(file.parent_path(), "the directory cannot be created");
  FileRecord record = record_of(relative, content);
  const auto before =
      std::erase_if(files_, [&](const FileRecord& other) { return other.path == record.path; });
  if (before > 0) ::unlink(file.c_str());
  write_and_flush(file, content, directory_ / relative);
  files_.push_back(std::move(record));
}

std::string PreparedSet::commit(const fs::path& name, std::string_view summary) {
  require_place(directory_, name);
  std::string sealed = seal(summary, files_);
  const fs::path file = unfinished(directory_) / "summary" / name;
  create_folders(file.parent_path(), "the directory cannot be created");
  write_and_flush(file, sealed, directory_ / name);
  // Folders are made before the set is decided, because they need space on the disk.
  for (const FileRecord& record : files_) {
    const auto folders =
        create_folders((directory_ / record.path).parent_path(), "the directory cannot be created");
    created_.insert(created_.end(), folders.begin(), folders.end());
  }
  flush_folders_below(unfinished(directory_));
  if (::rename(unfinished(directory_).c_str(), ready(directory_).c_str()) != 0) {
    throw_file_error(directory_, "the results cannot be put in place", errno_text());
  }
  flush_folder(directory_);
  files_.clear();
  put_in_place(directory_);
  return sealed;
}

void remove_unfinished(const fs::path& directory) { remove_folder(unfinished(directory)); }

bool is_ready(const fs::path& directory) {
  std::error_code ignored;
  return fs::is_directory(fs::symlink_status(ready(directory), ignored));
}

void put_in_place(const fs::path& directory) {
  require_own(ready(directory));
  const fs::path files = ready(directory) / "files";
  const fs::path summaries = ready(directory) / "summary";
  for (const fs::path& name : files_below(summaries)) {
    const auto successors = sealed_files(text_if_any(summaries / name, largest_summary_bytes));
    remove_earlier(directory, name, successors);
    std::set<fs::path> folders = {directory};
    for (const fs::path& file : files_below(files)) {
      refuse_link_on_the_way(directory, file);
      const fs::path target = directory / file;
      create_folders(target.parent_path(), "the directory cannot be created");
      move_file(files / file, target);
      folders.insert(target.parent_path());
    }
    for (const fs::path& folder : folders) flush_folder(folder);
    move_file(summaries / name, directory / name);
    flush_folder(directory);
  }
  remove_folder(ready(directory));
}

}  // namespace hamjet::io
