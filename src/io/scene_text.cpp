#include "scene_text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <hamjet/error.hpp>
#include <system_error>

#include "file_system.hpp"
#include "scene_message.hpp"
#include "scene_token_scanner.hpp"
#include "text_file.hpp"

namespace hamjet::io {
namespace {

[[noreturn]] void throw_unreadable(const std::filesystem::path& file, const std::string& reason) {
  throw Error(ErrorKind::input_output,
              fmt::format("{}: the scene cannot be read: {}", printable_path(file), reason));
}

[[noreturn]] void throw_unreadable(const std::filesystem::path& file, int error_number) {
  throw_unreadable(file, std::generic_category().message(error_number));
}

[[noreturn]] void throw_too_long(std::string_view source, std::uintmax_t bytes) {
  throw_scene_error(source, fmt::format("the scene is too large, got {} bytes, must be at most {}",
                                        bytes, largest_scene_bytes));
}

const char* kind_of_file(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return "not a regular file";
}

void check_encoding(std::string_view text, std::string_view source) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw_scene_error(source,
                      "not UTF-8, got a UTF-16 byte order mark at byte offset 0, must be UTF-8");
  }
  for (std::size_t offset = 0; offset < text.size();) {
    const std::size_t length = utf8_sequence_length(text.substr(offset));
    if (length == 0) {
      throw_scene_error(source,
                        fmt::format("not UTF-8, got the byte 0x{:02x} at byte offset {}, must be "
                                    "UTF-8",
                                    static_cast<unsigned char>(text[offset]), offset));
    }
    if (text[offset] == '\0') {
      throw_scene_error(
          source,
          fmt::format("not a text, got a NUL byte at byte offset {}, must be TOML", offset));
    }
    offset += length;
  }
}

}  // namespace

std::string read_scene_file(const std::filesystem::path& file) {
  // Without O_NONBLOCK, opening a pipe would wait for its writer for ever.
  const Descriptor descriptor(file, O_RDONLY | O_NONBLOCK);
  if (!descriptor.is_open()) throw_unreadable(file, errno);
  struct stat status {};
  if (::fstat(descriptor.value(), &status) != 0) throw_unreadable(file, errno);
  if (!S_ISREG(status.st_mode)) {
    throw_unreadable(file, fmt::format("it is {}", kind_of_file(status.st_mode)));
  }
  if (status.st_size > static_cast<off_t>(largest_scene_bytes)) {
    throw_too_long(printable_path(file), static_cast<std::uintmax_t>(status.st_size));
  }
  std::string text;
  std::array<char, 65536> buffer;
  while (true) {
    const ssize_t count = ::read(descriptor.value(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw_unreadable(file, errno);
    if (count == 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(count));
    // The file may have grown since its size was asked for.
    if (text.size() > largest_scene_bytes) throw_too_long(printable_path(file), text.size());
  }
  // Half of an old scene and half of a new one can be a scene.
  struct stat now {};
  if (::fstat(descriptor.value(), &now) != 0) throw_unreadable(file, errno);
  const bool is_as_before = now.st_size == status.st_size &&
                            now.st_mtim.tv_sec == status.st_mtim.tv_sec &&
                            now.st_mtim.tv_nsec == status.st_mtim.tv_nsec;
  if (!is_as_before || text.size() != static_cast<std::size_t>(now.st_size)) {
    throw_unreadable(file, "it changed meanwhile; run again when it is saved");
  }
  return text;
}

std::string_view check_scene_text(std::string_view text, std::string_view source) {
  if (text.size() > largest_scene_bytes) throw_too_long(source, text.size());
  check_encoding(text, source);
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  check_tokens(text, source);
  return text;
}

}  // namespace hamjet::io
