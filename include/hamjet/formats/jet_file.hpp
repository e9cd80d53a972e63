#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/formats/stored_jet.hpp"

// A jet in the formats that hamjet reads and writes: by the ending of the file's name
//   .h5    HDF5, which holds everything;
//   .dace  DACE's text, the polynomials alone, in double precision;
//   .csv   as `jet.csv` of a run: the coefficients alone.
// What the last two leave out stands in the `summary.json` of the results.

namespace hamjet::io {

/// The description of a format; users of the library only pass it on.
struct OutputFormat;

/// The format of a file, by the ending of its name. Throws Error(usage), naming the known endings,
/// for any other.
const OutputFormat& jet_format(const std::filesystem::path& file);

/// What a file of polynomials from another program does not say, in the file's own units. All
/// members but the last are needed; the file must have all components of a state, expanded in all
/// of its variables.
struct JetDescription {
  std::optional<std::string> model = {};  ///< a name of model_names()
  std::optional<double> length_unit_km = {};
  std::optional<double> time_unit_s = {};
  std::optional<double> duration_canonical = {};
  std::optional<std::vector<double>> nominal_initial = {};
  /// Names of the parameters with which the state ends; none without it.
  std::optional<std::vector<std::string>> state_parameters = {};
};

/// Reads the run with this label or, without a label, the first run that has a result, from a
/// results directory, an HDF5 file, or a file of coefficients. Such a file stands beside its
/// `summary.json` or one folder below it; that folder then has the run's name, unless `label` says
/// otherwise. All files that the summary lists must be as they were written. A jet in DACE's text
/// has double precision. If any member of `foreign` is set, the file must be DACE's text from
/// another program; then no summary is looked for, and the jet has the file's name. Throws as
/// read_stored_jet.
StoredJet read_jet_file(const std::filesystem::path& path,
                        const std::optional<std::string>& label = {},
                        const JetDescription& foreign = {});

/// As read_stored_jets, but also for a file. A file has one jet, whose time must be the wanted one,
/// unless all times are wanted.
std::vector<StoredJet> read_jets_at_times(const std::filesystem::path& path,
                                          const std::optional<std::string>& label,
                                          const WantedTimes& wanted);

/// The content of a file in this format. Throws Error(input_output) if the format cannot hold the
/// jet, and Error(usage) for HDF5 in a build without it.
std::string jet_file_content(const StoredJet& stored, const OutputFormat& format);

}  // namespace hamjet::io
