#include "result_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "directory_lock.hpp"
#include "file_system.hpp"
#include "prepared_set.hpp"
#include "sealed_summary.hpp"
#include "text_file.hpp"

namespace hamjet::io {
namespace {

constexpr const char* remedy = "run the scene again";

constexpr std::uintmax_t small_change = 4096;  ///< a small change of a file's size, in bytes

}  // namespace

bool has_whole_results(const std::filesystem::path& directory, const std::string& name) {
  const std::string summary = read_regular_file(directory / name, largest_summary_bytes).text;
  if (!is_sealed(summary)) return false;
  const auto json = nlohmann::json::parse(summary, nullptr, false);
  return json.is_object() && !(json.contains("exit_code") &&
                               json["exit_code"] == static_cast<int>(ErrorKind::numerical));
}

ResultSet::ResultSet(std::filesystem::path directory, std::string name)
    : directory_(std::move(directory)), name_(std::move(name)) {
  if (is_ready(directory_)) {
    const DirectoryLock lock(directory_);
    put_in_place(directory_);
  }
  // Reading a pipe in the place of a result would wait for a process that writes to it.
  summary_ = require_regular_file(path(), largest_summary_bytes);
}

std::string ResultSet::read(const std::string& relative) {
  const auto files = sealed_files(summary_);
  const auto entry = std::find_if(files.begin(), files.end(),
                                  [&](const FileRecord& file) { return file.path == relative; });
  const std::filesystem::path file = directory_ / relative;
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  // A file whose size has changed little is read all the same, so that its reader can say what is
  // wrong in it.
  if (!none && entry != files.end() && size > 2 * entry->bytes + small_change) {
    throw_file_error(
        file,
        fmt::format("was changed after it was written: {} bytes, must be {}", size, entry->bytes),
        remedy);
  }
  std::string text = require_regular_file(file, largest_jet_bytes);
  const FileRecord found = record_of(relative, text);
  std::string problem;
  if (entry == files.end()) {
    problem = fmt::format("is not of the set of results that {} describes", name_);
  } else if (found.bytes != entry->bytes || found.crc32 != entry->crc32) {
    problem = fmt::format(
        "was changed after it was written: {} bytes with CRC-32 {:08x}, must be "
        "{} bytes with {:08x}",
        found.bytes, found.crc32, entry->bytes, entry->crc32);
  }
  read_.push_back({relative, std::move(problem)});
  return text;
}

void ResultSet::verify() const {
  if (!is_sealed(summary_)) {
    throw_file_error(path(), "its checksum is wrong or missing, so it was cut or changed", remedy);
  }
  for (const FileRead& file : read_) {
    if (!file.problem.empty()) throw_file_error(directory_ / file.path, file.problem, remedy);
  }
}

}  // namespace hamjet::io
