#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "../store/file_system.hpp"
#include "../store/json_text.hpp"
#include "../store/json_values.hpp"
#include "../store/sealed_summary.hpp"
#include "../store/text_file.hpp"
#include "../store/whole_file.hpp"
#include "hamjet/error.hpp"
#include "sweep_items.hpp"

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "manifest.json";
/// File systems slow down where a folder holds very many.
constexpr std::size_t items_in_a_folder = 1000;

/// The text of a file of at most `most_bytes`; no value if there is no file.
std::optional<std::string> text_of(const fs::path& file, std::size_t most_bytes) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return std::nullopt;
    throw_file_error(file, "cannot be read", errno_text());
  }
  return read_text_file(file, most_bytes);
}

/// Whether a process has left a file behind while it wrote. A file that another machine may still
/// be writing counts as left behind after an hour.
bool is_leftover(const fs::path& file) {
  if (file.extension() != ".tmp") return false;
  const auto writer = temporary_writer(file);
  if (writer && writer->is_of_this_machine) return !writer->is_running;
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  return !error && fs::file_time_type::clock::now() - written > std::chrono::hours(1);
}

/// What differs between two studies, for a message.
std::string difference(const SweepStudy& there, const SweepStudy& here) {
  if (there.version != here.version) {
    return fmt::format("it was made by hamjet {}, this is {}", there.version, here.version);
  }
  if (there.scene_text != here.scene_text || there.scene != here.scene) {
    return "the base scene has changed";
  }
  const auto names = [](const SweepStudy& study) {
    std::vector<std::string> result;
    for (const SweepKey& key : study.keys) result.push_back(key.name);
    return result;
  };
  if (names(there) != names(here) || there.items != here.items) return "its items differ";
  if (there.title != here.title || there.name != here.name) return "its name or title differs";
  return "its command, set, columns or map differ";
}

nlohmann::ordered_json value_json(const SweepValue& value) {
  if (const bool* truth = std::get_if<bool>(&value)) return *truth;
  if (const double* number = std::get_if<double>(&value)) return *number;
  if (const std::string* text = std::get_if<std::string>(&value)) return *text;
  return nullptr;
}

SweepValue value_of(const nlohmann::json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return {};
}

}  // namespace

SweepDirectory::SweepDirectory(fs::path path, const SweepStudy& study)
    : path_(std::move(path)), columns_(study.columns.size()) {
  const std::string manifest = sweep_manifest(study);
  checksum_ = fmt::format("{:08x}", record_of("", manifest).crc32);
  const fs::path file = path_ / manifest_name;
  if (!text_of(file, largest_manifest_bytes)) write_whole_file(file, manifest);
  // The manifest is read again: another process may have been faster, with another study.
  const std::string there = text_of(file, largest_manifest_bytes).value_or("");
  if (there == manifest) return;
  throw Error(ErrorKind::usage,
              fmt::format("{}: belongs to another study: {}; choose another -o, or remove the "
                          "directory to start anew",
                          printable_path(file),
                          difference(parse_sweep_manifest(there, printable_path(file)), study)));
}

SweepStudy SweepDirectory::study_in(const fs::path& path) {
  const fs::path file = path / manifest_name;
  const auto text = text_of(file, largest_manifest_bytes);
  if (!text) {
    throw Error(
        ErrorKind::input_output,
        fmt::format("{}: is not there, so there is no sweep to merge", printable_path(file)));
  }
  return parse_sweep_manifest(*text, printable_path(file));
}

fs::path SweepDirectory::file_of(std::size_t item) const {
  return path_ / "rows" / fmt::format("{:03}", item / items_in_a_folder) /
         fmt::format("{:06}.json", item);
}

void SweepDirectory::write(const SweepRow& row) const {
  nlohmann::ordered_json json = {{"item", row.item},
                                 {"manifest", checksum_},
                                 {"exit_code", row.exit_code},
                                 {"error", text_or_null(row.error)}};
  json["values"] = nlohmann::ordered_json::array();
  for (const SweepValue& value : row.values) json["values"].push_back(value_json(value));
  const fs::path file = file_of(row.item);
  refuse_link_on_the_way(path_, file.lexically_relative(path_));
  // A row that a power failure takes away or cuts is computed again: waiting for the disk each time
  // would cost more than quick items do.
  replace_sealed_file(file, seal(json_text(json), {}));
}

std::optional<SweepRow> SweepDirectory::read(std::size_t item, RowState* state) const {
  const auto end_as = [&](RowState found) {
    if (state != nullptr) *state = found;
    return std::nullopt;
  };
  const auto text = text_of(file_of(item), largest_sweep_row_bytes);
  if (!text) return end_as(RowState::missing);
  if (!is_sealed(*text)) return end_as(RowState::damaged);
  try {
    const auto json = nlohmann::json::parse(*text);
    SweepRow row;
    row.item = json.at("item");
    row.exit_code = json.at("exit_code");
    if (!json.at("error").is_null()) row.error = json.at("error");
    for (const auto& value : json.at("values")) row.values.push_back(value_of(value));
    const bool is_ours =
        json.at("manifest") == checksum_ && row.item == item && row.values.size() == columns_;
    if (!is_ours) return end_as(RowState::foreign);
    if (state != nullptr) *state = RowState::whole;
    return row;
  } catch (const nlohmann::json::exception&) {
    return end_as(RowState::foreign);  // sealed, yet no row
  }
}

void SweepDirectory::remove_leftovers() const {
  std::error_code ignored;
  for (const fs::path& entry : entries_below(path_ / "rows")) {
    if (is_leftover(entry)) fs::remove(entry, ignored);
  }
}

}  // namespace hamjet::io
