#include "hamjet/formats/jet_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "../store/result_set.hpp"
#include "../store/sealed_summary.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "dace_text.hpp"
#include "hamjet/error.hpp"
#include "hdf5_jets.hpp"
#include "jet_csv.hpp"
#include "jet_description.hpp"
#include "stored_jet_source.hpp"

namespace hamjet::io {
namespace {

FlowJet<Extended> read_dace_coefficients(const CoefficientFile& file, std::string_view text) {
  // Rows of zeros are left out, but a damaged order could ask for gigabytes.
  constexpr double most_zeros = 1000;
  const double terms = SeriesSpace::monomial_count(file.variables.size(), file.order);
  if (terms > most_zeros * static_cast<double>(text.size() + 1)) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: has far fewer coefficients than order {} in {} variables has",
                            file.name, file.order, file.variables.size()));
  }
  const auto space = SeriesSpace::create(file.variables.size(), file.order);
  const auto polynomials = read_dace_text(file.name, text, space);
  if (polynomials.size() != file.components.size()) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: has {} polynomials, must have {}", file.name, polynomials.size(),
                            file.components.size()));
  }
  FlowJet<Extended> jet;
  for (const Series<double>& polynomial : polynomials) {
    Series<Extended>& series = jet.emplace_back(space);
    std::copy(polynomial.coefficients().begin(), polynomial.coefficients().end(),
              series.coefficients().begin());
  }
  return jet;
}

std::optional<JetFormat> format_of(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".h5") return JetFormat::hdf5;
  if (ending == ".dace") return JetFormat::dace;
  if (ending == ".csv") return JetFormat::csv;
  return std::nullopt;
}

bool has_summary(const std::filesystem::path& directory) {
  std::error_code none;
  return std::filesystem::exists(directory / "summary.json", none);
}

StoredJet read_beside_summary(const std::filesystem::path& file, JetFormat format,
                              std::optional<std::string> label) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::filesystem::path directory = folder;
  if (!has_summary(directory)) {
    directory /= "..";
    if (!has_summary(directory)) {
      throw Error(ErrorKind::input_output,
                  fmt::format("{}: no summary.json beside it or one folder up, which says what its "
                              "coefficients are of; give the results directory or an .h5 file",
                              printable_path(file)));
    }
    if (!label) label = std::filesystem::canonical(folder).filename().string();
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
  StoredJet stored = read_stored_jet(
      directory, label, read,
      {file, format == JetFormat::dace ? read_dace_coefficients : read_coefficients});
  if (format == JetFormat::dace) stored.precision = Precision::double_precision;
  set.verify();
  return stored;
}

}  // namespace

JetFormat jet_format(const std::filesystem::path& file) {
  if (const auto format = format_of(file)) return *format;
  throw Error(ErrorKind::usage,
              fmt::format("{}: must end in .h5, .dace or .csv", printable_path(file)));
}

StoredJet read_jet_file(const std::filesystem::path& path,
                        const std::optional<std::string>& label) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none) || !std::filesystem::exists(path, none)) {
    return read_stored_jet(path, label);
  }
  const auto format = format_of(path);
  if (!format) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: is neither a results directory nor a file .h5, .dace or .csv",
                            printable_path(path)));
  }
  if (!std::filesystem::is_regular_file(path, none)) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: cannot be read: not a regular file", printable_path(path)));
  }
  if (format != JetFormat::hdf5) return read_beside_summary(path, *format, label);
  if (!hdf5_available()) (void)read_jets_hdf5({}, {}, {});  // throws, saying how to get HDF5
  return read_jets_hdf5(printable_path(path), read_text_file(path, largest_jet_bytes), label);
}

std::string jet_file_content(const StoredJet& stored, JetFormat format) {
  switch (format) {
    case JetFormat::hdf5:
      return jets_hdf5(stored);
    case JetFormat::dace:
      return dace_text(stored.jet, jet_notes(stored, stored.order()));
    case JetFormat::csv:
      break;
  }
  return coefficients_csv(stored.variable_names(), stored.components, stored.variables,
                          stored.precision, stored.jet);
}

}  // namespace hamjet::io
