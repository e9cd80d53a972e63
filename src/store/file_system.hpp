#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Files on the disk, written so that a full disk or a power failure shows as an error or not at
// all. Errors are Error(input_output) with path and reason.

namespace hamjet::io {

/// A file descriptor that is closed when the object goes.
class Descriptor {
 public:
  Descriptor() = default;
  /// Opens a file; the descriptor is -1, with errno set, if that fails. New files may be read by
  /// all, as far as the umask allows, unless told otherwise. Children do not inherit it.
  Descriptor(const std::filesystem::path& path, int flags, mode_t mode = 0644);
  /// Takes over one that is open.
  explicit Descriptor(int value) : value_(value) {}
  /// Another descriptor of the same open file; -1, with errno set, if that fails.
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
  /// Closes now and tells whether that worked: a full disk can show here only.
  bool close();

 private:
  int value_ = -1;
};

[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view what,
                                   std::string_view reason);

/// The text of `errno`.
std::string errno_text();

/// Writes all of the text to an open file. `shown` is the path that errors name.
void write_all(const Descriptor& file, std::string_view content,
               const std::filesystem::path& shown);

/// Waits until the disk has what was written.
void flush(const Descriptor& file, const std::filesystem::path& shown);

/// Writes a file, of whose name there must be none and no link either, and flushes it to the disk.
/// `shown` is the path that errors name.
void write_and_flush(const std::filesystem::path& path, std::string_view content,
                     const std::filesystem::path& shown);

/// Makes renames in a folder durable. Some file systems refuse that, which loses nothing else.
void flush_folder(const std::filesystem::path& folder);

/// Creates the folder with those above it and returns the new ones, outermost first. Throws with
/// `problem`, leaving none.
std::vector<std::filesystem::path> create_folders(const std::filesystem::path& folder,
                                                  std::string_view problem);

/// Everything below a folder, each folder before what is in it; links are not followed. Nothing
/// where the folder is not there; what cannot be read is left out. It is no recursive iterator of
/// the standard library, for libstdc++ declares its step noexcept and allocates in it, so that the
/// program ends where memory runs out.
std::vector<std::filesystem::path> entries_below(const std::filesystem::path& folder);

/// Removes the folders that are empty, the last of the list first; one with files in it stays.
void remove_empty(const std::vector<std::filesystem::path>& folders);

/// The first folder from the directory down to a file that is a symbolic link; empty if none is.
/// Files behind it are not the directory's. (The directory itself may be a link.)
std::filesystem::path link_on_the_way(const std::filesystem::path& directory,
                                      const std::filesystem::path& relative);

/// Throws for a file with such a link on its way.
void refuse_link_on_the_way(const std::filesystem::path& directory,
                            const std::filesystem::path& relative);

/// A name in the folder that nobody can foretell, for a file that is written there and then
/// renamed.
std::filesystem::path temporary_in(const std::filesystem::path& folder);

/// A file without a name, to be written and read, which is gone when it is closed; and the folder
/// that has room for it: TMPDIR, or /tmp. Throws Error(input_output).
Descriptor unnamed_temporary_file(std::filesystem::path& folder);

/// The process that writes a temporary file.
struct TemporaryWriter {
  bool is_of_this_machine = false;
  bool is_running = false;  ///< known of this machine's processes only
};

/// The writer of a temporary file, by its name; no value if the name is not one.
std::optional<TemporaryWriter> temporary_writer(const std::filesystem::path& temporary);

}  // namespace hamjet::io
