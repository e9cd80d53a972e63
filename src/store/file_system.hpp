#pragma once

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
  /// all, as far as the umask allows. Children do not inherit it.
  Descriptor(const std::filesystem::path& path, int flags);
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

/// Writes a file and flushes it to the disk. `shown` is the path that errors name.
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

/// Throws if no file can be created in the folder, which need not exist. Leaves nothing behind.
void require_writable(const std::filesystem::path& folder);

/// The file beside `path` that write_whole_file() writes, and then renames to `path`.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

/// The process that writes a temporary file.
struct TemporaryWriter {
  bool is_of_this_machine = false;
  bool is_running = false;  ///< known of this machine's processes only
};

/// The writer of a temporary file, by its name; no value if the name is not one.
std::optional<TemporaryWriter> temporary_writer(const std::filesystem::path& temporary);

/// Writes one file in full, or leaves what was there untouched; its folder is created. Does not
/// wait for the disk: after a power failure the file may be cut or missing, so it must have a seal.
void replace_sealed_file(const std::filesystem::path& path, std::string_view content);

/// Writes one file in full, or leaves what was there untouched, and waits for the disk: after a
/// power failure it is there, whole.
void write_whole_file(const std::filesystem::path& path, std::string_view content);

}  // namespace hamjet::io
