#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// A set of results is described by one JSON file of its own (`summary.json`, `compare.json`). Its
// last two keys are written here: "files" lists all other files of the set with size and CRC-32,
// and "crc32", the last line, is the CRC-32 of all bytes before that line. (It is the CRC-32 of
// zlib, PNG and IEEE 802.3, which detects every error of up to 32 neighbouring bits.)

namespace hamjet::io {

/// A file of a set as it was written.
struct FileRecord {
  std::string path;  ///< path relative to the directory, with slashes
  std::uintmax_t bytes = 0;
  std::uint32_t crc32 = 0;
};

FileRecord record_of(const std::filesystem::path& relative, std::string_view content);

/// The JSON object `summary` with the keys "files" and "crc32" added.
std::string seal(std::string_view summary, const std::vector<FileRecord>& files);

/// Whether the text is, byte by byte, what `seal` returned.
bool is_sealed(std::string_view text);

/// The records in a sealed text; empty for any other text. Records whose path leads out of the
/// directory are left out.
std::vector<FileRecord> sealed_files(std::string_view text);

}  // namespace hamjet::io
