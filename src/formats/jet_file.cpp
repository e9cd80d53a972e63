#include "hamjet/formats/jet_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "../store/result_set.hpp"
#include "../store/sealed_summary.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "dace_text.hpp"
#include "foreign_jet.hpp"
#include "hamjet/error.hpp"
#include "jet_description.hpp"
#include "output_formats.hpp"
#include "results_names.hpp"
#include "stored_jet_source.hpp"

namespace hamjet::io {
namespace {

const OutputFormat* format_of(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  for (const OutputFormat* format : output_formats()) {
    if (!ending.empty() && format->ending == ending) return format;
  }
  return nullptr;
}

bool has_summary(const std::filesystem::path& directory) {
  std::error_code none;
  return std::filesystem::exists(directory / "summary.json", none);
}

/// What the user may give in place of a summary, for formats of polynomials alone.
std::string how_to_describe(const OutputFormat& format) {
  if (format.read_polynomials == nullptr) return "";
  std::vector<std::string> options;
  for (const DescriptionMember& member : description_members()) {
    if (member.is_needed) options.push_back(member.option());
  }
  return fmt::format(", or convert it with {}", fmt::join(options, ", "));
}

StoredJet read_foreign(const std::filesystem::path& file, const OutputFormat* format,
                       const std::optional<std::string>& label, const JetDescription& foreign) {
  const std::string name = printable_path(file);
  if (label) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: a jet from elsewhere has no runs, got the label {}", name,
                            in_quotes(*label)));
  }
  if (format == nullptr || format->read_polynomials == nullptr) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: what is told of a jet from elsewhere is for {} alone, which says "
                            "nothing of it itself",
                            name, dace_format.ending));
  }
  return foreign_jet(name, printable(file.stem().string()), read_text_file(file, largest_jet_bytes),
                     *format, foreign);
}

StoredJet read_beside_summary(const std::filesystem::path& file, const OutputFormat& format,
                              std::optional<std::string> label) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::filesystem::path directory = folder;
  std::string time_folder;
  if (!has_summary(directory)) {
    directory /= "..";
    std::filesystem::path of_run = std::filesystem::canonical(folder);
    const bool is_of_time = of_run.filename().string().starts_with(time_folder_head);
    if (is_of_time) directory /= "..";
    if (!has_summary(directory)) {
      throw Error(ErrorKind::input_output,
                  fmt::format("{}: no summary.json beside it or one folder up, which says what its "
                              "coefficients are of; give the results directory or an .h5 file{}",
                              printable_path(file), how_to_describe(format)));
    }
    if (is_of_time) {
      time_folder = of_run.filename().string();
      of_run = of_run.parent_path();
    }
    if (!label) label = of_run.filename().string();
  }
  ResultSet set(directory, "summary.json");
  const std::string relative = std::filesystem::relative(file, directory).generic_string();
  const auto files = sealed_files(set.summary());
  const bool is_listed = std::any_of(files.begin(), files.end(), [&](const FileRecord& record) {
    return record.path == relative;
  });
  const auto read = [&](const std::filesystem::path& wanted) {
    if (wanted == set.path()) return set.summary();
    return is_listed ? set.read(relative) : read_text_file(wanted, largest_jet_bytes);
  };
  StoredJet stored =
      read_stored_jet(directory, label, read, {file, format.read_coefficients, time_folder});
  if (format.digits > 0) stored.precision = Precision::double_precision;
  set.verify();
  return stored;
}

}  // namespace

const OutputFormat& jet_format(const std::filesystem::path& file) {
  if (const OutputFormat* format = format_of(file)) return *format;
  throw Error(ErrorKind::usage,
              fmt::format("{}: must end in {}", printable_path(file), jet_file_endings()));
}

StoredJet read_jet_file(const std::filesystem::path& path, const std::optional<std::string>& label,
                        const JetDescription& foreign) {
  std::error_code none;
  const OutputFormat* format = format_of(path);
  const bool exists = std::filesystem::exists(path, none);
  if (is_any_given(foreign)) return read_foreign(path, format, label, foreign);
  if (std::filesystem::is_directory(path, none) || (!exists && format == nullptr)) {
    return read_stored_jet(path, label);
  }
  // The ending says that the path means a file, so that the message is about a missing file.
  if (!exists) (void)read_text_file(path, largest_jet_bytes);
  if (format == nullptr) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: is neither a results directory nor a file {}",
                            printable_path(path), jet_file_endings()));
  }
  if (!std::filesystem::is_regular_file(path, none)) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: cannot be read: not a regular file", printable_path(path)));
  }
  if (format->read == nullptr) return read_beside_summary(path, *format, label);
  if (!format->is_built())
    (void)format->read({}, {}, {});  // throws an error that says how to get the library
  return format->read(printable_path(path), read_text_file(path, largest_jet_bytes), label);
}

std::vector<StoredJet> read_jets_at_times(const std::filesystem::path& path,
                                          const std::optional<std::string>& label,
                                          const WantedTimes& wanted) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) return read_stored_jets(path, label, wanted);
  StoredJet stored = read_jet_file(path, label);
  for (const double time_s : wanted.seconds) {
    if (is_at(stored, time_s)) continue;
    throw Error(ErrorKind::usage,
                fmt::format("{}: has the jet at {:.12g} s alone, got the time {:.12g} s; the "
                            "results directory has those of all times",
                            printable_path(path), stored.duration * stored.units.time_s, time_s));
  }
  return {std::max<std::size_t>(wanted.seconds.size(), 1), stored};
}

std::string jet_file_content(const StoredJet& stored, const OutputFormat& format) {
  require_place_for_coordinates(stored, std::string(format.ending));
  return format.of_jet(stored);
}

}  // namespace hamjet::io
