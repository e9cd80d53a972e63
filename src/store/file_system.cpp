#include "file_system.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <memory>
#include <system_error>

#include "../text/whole_number.hpp"
#include "hamjet/error.hpp"
#include "text_file.hpp"

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

Descriptor::Descriptor(const fs::path& path, int flags, mode_t mode)
    : value_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {}

Descriptor Descriptor::duplicate(int of) { return Descriptor(::fcntl(of, F_DUPFD_CLOEXEC, 0)); }

bool Descriptor::close() { return !is_open() || ::close(std::exchange(value_, -1)) == 0; }

void throw_file_error(const fs::path& path, std::string_view what, std::string_view reason) {
  throw Error(ErrorKind::input_output,
              fmt::format("{}: {}: {}", printable_path(path), what, reason));
}

std::string errno_text() { return std::generic_category().message(errno); }

void write_all(const Descriptor& file, std::string_view content, const fs::path& shown) {
  while (!content.empty()) {
    const ssize_t written = ::write(file.value(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      throw_file_error(shown, fmt::format("cannot be written ({} bytes left)", content.size()),
                       errno_text());
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void flush(const Descriptor& file, const fs::path& shown) {
  // Some file systems cannot flush a file, and report EINVAL.
  if (::fsync(file.value()) != 0 && errno != EINVAL) {
    throw_file_error(shown, "cannot be flushed", errno_text());
  }
}

void write_and_flush(const fs::path& path, std::string_view content, const fs::path& shown) {
  Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
  if (!file.is_open()) throw_file_error(shown, "cannot be written", errno_text());
  write_all(file, content, shown);
  flush(file, shown);
  if (!file.close()) throw_file_error(shown, "cannot be closed", errno_text());
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
  // rmdir is used instead of fs::remove, which would remove a file that has taken the folder's
  // place.
  for (auto p = folders.rbegin(); p != folders.rend(); ++p) ::rmdir(p->c_str());
}

fs::path link_on_the_way(const fs::path& directory, const fs::path& relative) {
  std::error_code ignored;
  fs::path folder = directory;
  for (const fs::path& part : relative.parent_path()) {
    folder /= part;
    if (fs::is_symlink(fs::symlink_status(folder, ignored))) return folder;
  }
  return {};
}

void refuse_link_on_the_way(const fs::path& directory, const fs::path& relative) {
  const fs::path link = link_on_the_way(directory, relative);
  if (link.empty()) return;
  throw_file_error(directory / relative, "cannot be written",
                   fmt::format("{} is a symbolic link, which would be followed; remove it, or "
                               "choose another directory",
                               printable_path(link)));
}

fs::path temporary_in(const fs::path& folder) {
  std::uint64_t number = 0;
  if (::getentropy(&number, sizeof number) != 0) {
    throw_file_error(folder, "no file can be named at random", errno_text());
  }
  // Machines that share a folder may have the same process numbers, so that the name has a random
  // number too.
  return folder / fmt::format(".hamjet-{:016x}.{}-{}.tmp", number, host_name(), ::getpid());
}

Descriptor unnamed_temporary_file(fs::path& folder) {
  std::error_code error;
  folder = fs::temp_directory_path(error);
  if (error) folder = "/tmp";
  constexpr mode_t owner_alone = 0600;
  Descriptor file(folder, O_RDWR | O_TMPFILE, owner_alone);
  if (file.is_open()) return file;
  // The file system has no files without a name.
  const fs::path name = temporary_in(folder);
  file = Descriptor(name, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW, owner_alone);
  if (!file.is_open()) throw_file_error(folder, "has no room for temporary files", errno_text());
  ::unlink(name.c_str());
  return file;
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

}  // namespace hamjet::io
