#include "file_system.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <memory>
#include <system_error>

#include "../text/whole_number.hpp"
#include "hamjet/error.hpp"
#include "text_file.hpp"

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

std::string host_name() {
  std::array<char, 64> host{};
  ::gethostname(host.data(), host.size() - 1);
  return host.data();
}

struct CloseDirectory {
  void operator()(DIR* directory) const { ::closedir(directory); }
};

void add_entries_below(const fs::path& folder, std::vector<fs::path>& entries) {
  const std::unique_ptr<DIR, CloseDirectory> directory(::opendir(folder.c_str()));
  if (!directory) return;
  while (const dirent* entry = ::readdir(directory.get())) {
    const std::string_view name = entry->d_name;
    if (name == "." || name == "..") continue;
    const fs::path path = folder / name;
    entries.push_back(path);
    std::error_code error;
    if (fs::is_directory(fs::symlink_status(path, error))) add_entries_below(path, entries);
  }
}

/// Whether to wait until the disk has what was written.
enum class Flush { no, yes };

void write_file(const fs::path& path, std::string_view content, const fs::path& shown,
                Flush flush) {
  Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open()) throw_file_error(shown, "cannot be written", errno_text());
  while (!content.empty()) {
    const ssize_t written = ::write(file.value(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      throw_file_error(shown, fmt::format("cannot be written ({} bytes left)", content.size()),
                       errno_text());
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (flush == Flush::yes && ::fsync(file.value()) != 0 && errno != EINVAL) {
    throw_file_error(shown, "cannot be flushed", errno_text());
  }
  if (!file.close()) throw_file_error(shown, "cannot be closed", errno_text());
}

/// Writes a file beside `path`, then renames it to `path`.
void replace_file(const fs::path& path, std::string_view content, Flush flush) {
  const fs::path folder = folder_of(path);
  const auto created = create_folders(folder, "the directory cannot be created");
  const fs::path temporary = temporary_beside(path);
  try {
    write_file(temporary, content, path, flush);
    if (::rename(temporary.c_str(), path.c_str()) != 0) {
      throw_file_error(path, "cannot be put in its place", errno_text());
    }
  } catch (...) {
    ::unlink(temporary.c_str());
    remove_empty(created);
    throw;
  }
}

}  // namespace

Descriptor::Descriptor(const fs::path& path, int flags)
    : value_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}

bool Descriptor::close() { return !is_open() || ::close(std::exchange(value_, -1)) == 0; }

void throw_file_error(const fs::path& path, std::string_view what, std::string_view reason) {
  throw Error(ErrorKind::input_output,
              fmt::format("{}: {}: {}", printable_path(path), what, reason));
}

std::string errno_text() { return std::generic_category().message(errno); }

void write_and_flush(const fs::path& path, std::string_view content, const fs::path& shown) {
  write_file(path, content, shown, Flush::yes);
}

void flush_folder(const fs::path& folder) {
  const Descriptor directory(folder, O_RDONLY | O_DIRECTORY);
  if (directory.is_open()) ::fsync(directory.value());
}

std::vector<fs::path> create_folders(const fs::path& folder, std::string_view problem) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path p = folder; !p.empty() && !fs::exists(p, error); p = p.parent_path()) {
    missing.insert(missing.begin(), p);
    if (p == p.parent_path()) break;
  }
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder, error)) return missing;
  const std::string reason = error ? error.message() : "something else has this name";
  remove_empty(missing);
  throw_file_error(folder, problem, reason);
}

std::vector<fs::path> entries_below(const fs::path& folder) {
  std::vector<fs::path> entries;
  add_entries_below(folder, entries);
  return entries;
}

void remove_empty(const std::vector<fs::path>& folders) {
  // rmdir is used, not fs::remove, which would remove a file that has taken the folder's place.
  for (auto p = folders.rbegin(); p != folders.rend(); ++p) ::rmdir(p->c_str());
}

void require_writable(const fs::path& folder) {
  const auto created = create_folders(folder, "the directory cannot be created");
  const fs::path probe = folder / fmt::format(".hamjet-{}.tmp", ::getpid());
  try {
    write_and_flush(probe, "", probe);
  } catch (...) {
    remove_empty(created);
    throw;
  }
  ::unlink(probe.c_str());
  remove_empty(created);
}

fs::path temporary_beside(const fs::path& path) {
  fs::path temporary = path;
  // Machines that share a folder may have the same process numbers.
  temporary += fmt::format(".{}-{}.tmp", host_name(), ::getpid());
  return temporary;
}

std::optional<TemporaryWriter> temporary_writer(const fs::path& temporary) {
  const std::string name = temporary.stem().string();
  const std::size_t dash = name.rfind('-');
  if (dash == std::string::npos) return std::nullopt;
  const auto process = whole_number<pid_t>(std::string_view(name).substr(dash + 1));
  if (!process || *process <= 0) return std::nullopt;
  const bool is_of_this_machine =
      std::string_view(name).substr(0, dash).ends_with("." + host_name());
  const bool is_running = ::kill(*process, 0) == 0 || errno == EPERM;
  return TemporaryWriter{is_of_this_machine, is_of_this_machine && is_running};
}

void replace_sealed_file(const fs::path& path, std::string_view content) {
  replace_file(path, content, Flush::no);
}

void write_whole_file(const fs::path& path, std::string_view content) {
  replace_file(path, content, Flush::yes);
  flush_folder(folder_of(path));
}

}  // namespace hamjet::io
