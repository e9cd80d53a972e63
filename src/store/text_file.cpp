#include "text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include "../text/scene_message.hpp"
#include "file_system.hpp"
#include "hamjet/error.hpp"
#include "input_stream.hpp"

namespace hamjet::io {
namespace {

/// The reason, from errno, why the last system call failed.
FileContent failed_content() {
  const bool is_missing = errno == ENOENT;
  return {{}, errno_text(), false, is_missing};
}

FileContent too_large(std::uintmax_t bytes, std::size_t most_bytes) {
  return {{},
          fmt::format("it is too large, got {} bytes, must be at most {}", bytes, most_bytes),
          true};
}

}  // namespace

void throw_unreadable(const std::filesystem::path& file) {
  const FileContent content = failed_content();
  throw_no_content(file, content, ErrorKind::input_output,
                   fmt::format("{}: cannot be read: {}", printable_path(file), content.problem));
}

const char* kind_of_file(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return S_ISREG(mode) ? "a regular file" : "of a special kind";
}

FileContent read_regular_file(const std::filesystem::path& file, std::size_t most_bytes) {
  // Without O_NONBLOCK, opening a pipe would wait until another process opens it for writing.
  const Descriptor descriptor(file, O_RDONLY | O_NONBLOCK);
  if (!descriptor.is_open()) return failed_content();
  struct stat status {};
  if (::fstat(descriptor.value(), &status) != 0) return failed_content();
  if (!S_ISREG(status.st_mode)) {
    return {{}, fmt::format("it is {}, not a regular file", kind_of_file(status.st_mode))};
  }
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size > most_bytes) return too_large(size, most_bytes);
  std::string text;
  std::array<char, 65536> buffer;
  while (true) {
    const ssize_t count = ::read(descriptor.value(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failed_content();
    if (count == 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(count));
    // The file may have grown since its size was read.
    if (text.size() > most_bytes) return too_large(text.size(), most_bytes);
  }
  // Half of an old file followed by half of a new one can look like a valid file.
  struct stat now {};
  if (::fstat(descriptor.value(), &now) != 0) return failed_content();
  const bool is_as_before = now.st_size == status.st_size &&
                            now.st_mtim.tv_sec == status.st_mtim.tv_sec &&
                            now.st_mtim.tv_nsec == status.st_mtim.tv_nsec;
  if (!is_as_before || text.size() != static_cast<std::size_t>(now.st_size)) {
    return {{}, "it changed meanwhile; run again when it is saved"};
  }
  return {std::move(text), {}};
}

void throw_no_content(const std::filesystem::path& file, const FileContent& content, ErrorKind kind,
                      const std::string& message) {
  if (content.is_missing) throw MissingFile(file, message);
  throw Error(kind, message);
}

std::string printable_path(const std::filesystem::path& file) {
  return printable(file.string(), std::string::npos);
}

std::string require_regular_file(const std::filesystem::path& file, std::size_t most_bytes) {
  FileContent content = read_regular_file(file, most_bytes);
  if (!content.problem.empty()) {
    throw_no_content(file, content,
                     content.is_too_large ? ErrorKind::too_large : ErrorKind::input_output,
                     fmt::format("{}: cannot be read: {}", printable_path(file), content.problem));
  }
  return std::move(content.text);
}

std::string read_text_file(const std::filesystem::path& file, std::size_t most_bytes) {
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) return require_regular_file(file, most_bytes);
  InputStream stream(file);
  std::string text;
  std::array<char, 65536> buffer;
  while (const std::size_t count = stream.read(buffer)) {
    text.append(buffer.data(), count);
    if (text.size() > most_bytes) {
      throw Error(ErrorKind::too_large, fmt::format("{}: cannot be read: {}", printable_path(file),
                                                    too_large(text.size(), most_bytes).problem));
    }
  }
  return text;
}

void split_line(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace hamjet::io
