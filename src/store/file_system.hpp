#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Files on the disk, written so that a full disk or a power failure shows as an error or leaves no
// trace. Errors are Error(input_output) with path and reason.

namespace hamjet::io {

/// A file descriptor that is closed in the destructor.
class Descriptor {
 public:
  Descriptor() = default;
  /// Opens a file; the descriptor is -1, with errno set, if that fails. Unless `mode` says
  /// otherwise, a new file may be read by all users, as far as the umask allows. Child processes do
  /// not inherit the descriptor.
  Descriptor(const std::filesystem::path& path, int flags, mode_t mode = 0644);
  /// Takes over an open descriptor.
  explicit Descriptor(int value) : value_(value) {}
  /// Makes another descriptor of the same open file; it is -1, with errno set, if that fails.
  static Descriptor duplicate(int of);
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }

  int value() const { return value_; }
  bool is_open() const { return value_ >= 0; }
  /// Closes the file now and returns whether that worked: some errors of a full disk show only
  /// here.
  bool close();

 private:
  int value_ = -1;
};

[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view what,
                                   std::string_view reason);

/// The text of `errno`.
std::string errno_text();

/// Writes all of the text to an open file. `shown` is the path that error messages name.
void write_all(const Descriptor& file, std::string_view content,
               const std::filesystem::path& shown);

/// Waits until the content of the file is on the disk.
void flush(const Descriptor& file, const std::filesystem::path& shown);

/// Writes a new file and flushes it to the disk. There must be no file or link of this name.
/// `shown` is the path that error messages name.
void write_and_flush(const std::filesystem::path& path, std::string_view content,
                     const std::filesystem::path& shown);

/// Makes renames in a folder durable. Some file systems refuse this, which is ignored.
void flush_folder(const std::filesystem::path& folder);

/// Creates the folder with its parents and returns the new folders, outermost first. If it throws
/// (with `problem`), it leaves none of them.
std::vector<std::filesystem::path> create_folders(const std::filesystem::path& folder,
                                                  std::string_view problem);

/// Everything below a folder, each folder before its content; links are not followed. The list is
/// empty where the folder does not exist, and leaves out what cannot be read. The recursive
/// iterator of the standard library is not used, because libstdc++ declares its step noexcept but
/// allocates in it, so that the program ends where memory runs out.
std::vector<std::filesystem::path> entries_below(const std::filesystem::path& folder);

/// Removes the empty folders of the list, from the last to the first; a folder with files in it
/// stays.
void remove_empty(const std::vector<std::filesystem::path>& folders);

/// The first symbolic link on the way from the directory down to a file; empty if there is none.
/// Files behind such a link do not belong to the directory. (The directory itself may be a link.)
std::filesystem::path link_on_the_way(const std::filesystem::path& directory,
                                      const std::filesystem::path& relative);

/// Throws for a file with a symbolic link on its way (see link_on_the_way).
void refuse_link_on_the_way(const std::filesystem::path& directory,
                            const std::filesystem::path& relative);

/// An unpredictable name in the folder, for a file that is written under this name and then
/// renamed.
std::filesystem::path temporary_in(const std::filesystem::path& folder);

/// A file without a name, for writing and reading, which disappears when it is closed; `folder`
/// becomes the folder in which it is: TMPDIR, or /tmp. Throws Error(input_output).
Descriptor unnamed_temporary_file(std::filesystem::path& folder);

/// The process that writes a temporary file.
struct TemporaryWriter {
  bool is_of_this_machine = false;
  bool is_running = false;  ///< known for processes of this machine only
};

/// The process that writes a temporary file, from the file's name; no value if the name is not that
/// of a temporary file.
std::optional<TemporaryWriter> temporary_writer(const std::filesystem::path& temporary);

}  // namespace hamjet::io
