#include "text_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "hamjet/error.hpp"
#include "scene_message.hpp"

namespace hamjet::io {
namespace {

[[noreturn]] void throw_unreadable(const std::filesystem::path& file) {
  throw Error(ErrorKind::input_output, fmt::format("{}: cannot be read: {}", printable_path(file),
                                                   std::generic_category().message(errno)));
}

}  // namespace

std::string printable_path(const std::filesystem::path& file) {
  return printable(file.string(), std::string::npos);
}

std::string read_text_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw_unreadable(file);
  std::string text;
  std::array<char, 65536> buffer;
  do {
    stream.read(buffer.data(), buffer.size());
    text.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
  } while (stream);
  if (stream.bad()) throw_unreadable(file);
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
