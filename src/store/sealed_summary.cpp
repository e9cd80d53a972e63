#include "sealed_summary.hpp"

#include <fmt/format.h>

#include <boost/crc.hpp>
#include <charconv>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace hamjet::io {
namespace {

std::uint32_t crc32(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return crc.checksum();
}

std::string last_line(std::string_view before) {
  return fmt::format("  \"crc32\": \"{:08x}\"\n}}\n", crc32(before));
}

bool is_below(const std::filesystem::path& path) {
  if (path.empty() || path.is_absolute()) return false;
  for (const auto& part : path) {
    if (part.empty() || part == "." || part == "..") return false;
  }
  return true;
}

}  // namespace

FileRecord record_of(const std::filesystem::path& relative, std::string_view content) {
  return {relative.generic_string(), content.size(), crc32(content)};
}

std::string seal(std::string_view summary, const std::vector<FileRecord>& files) {
  const std::size_t end = summary.find_last_of('}');
  if (end == std::string_view::npos) throw std::logic_error("the summary is no JSON object");
  const std::size_t last = summary.find_last_not_of(" \n", end - 1);
  std::string text(summary.substr(0, last + 1));
  if (!text.ends_with('{')) text += ',';
  text += "\n  \"files\": [";
  const char* separator = "\n";
  for (const FileRecord& file : files) {
    text += fmt::format("{}    {{\"path\": {}, \"bytes\": {}, \"crc32\": \"{:08x}\"}}", separator,
                        nlohmann::json(file.path).dump(), file.bytes, file.crc32);
    separator = ",\n";
  }
  text += files.empty() ? "],\n" : "\n  ],\n";
  return text + last_line(text);
}

bool is_sealed(std::string_view text) {
  static const std::size_t length = last_line("").size();
  if (text.size() < length) return false;
  const std::string_view before = text.substr(0, text.size() - length);
  return text.substr(before.size()) == last_line(before);
}

std::vector<FileRecord> sealed_files(std::string_view text) {
  std::vector<FileRecord> files;
  if (!is_sealed(text)) return files;
  try {
    const auto json = nlohmann::json::parse(text);
    for (const auto& entry : json.at("files")) {
      FileRecord file;
      file.path = entry.at("path");
      file.bytes = entry.at("bytes");
      const std::string digits = entry.at("crc32");
      std::from_chars(digits.data(), digits.data() + digits.size(), file.crc32, 16);
      if (is_below(file.path)) files.push_back(std::move(file));
    }
  } catch (const nlohmann::json::exception&) {
    files.clear();  // sealed, but not with the content that `seal` writes
  }
  return files;
}

}  // namespace hamjet::io
