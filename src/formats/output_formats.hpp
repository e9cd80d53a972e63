#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/formats/stored_jet.hpp"
#include "stored_coefficients.hpp"

namespace hamjet::io {

/// A format of jets or nominals beside CSV and JSON. Scenes, results and `hamjet convert` use it.
/// Each format is described once, in its own header and source, and the list in output_formats.cpp
/// names it. Members for what a format does not do are null or empty.
struct OutputFormat {
  /// Name in the table `[output]`, where formats of the same name are requested together. If empty,
  /// the format is not requested: results always have it.
  std::string_view name = {};
  std::string_view help =
      {};  ///< what a file of this format is, for people; empty where the ending says enough
  std::string_view file;  ///< the file's name in the results, or in the folder of each run
  /// The ending of the jet files that `hamjet convert` writes and reads.
  std::string_view ending = {};
  int digits = 0;  ///< largest number of digits of a coefficient; 0 for all

  /// The library that a build may lack, and whether this build has it.
  std::string_view library = {};
  bool (*is_built)() = [] { return true; };
  bool needs_orbit = false;  ///< whether only models of orbits have this format
  bool needs_date = false;   ///< whether the scene must have the table `[ephemeris]`

  /// Makes one file of all runs; if null, each run has its own file, of its jet or nominal.
  std::string (*of_results)(const PropagationResult&) = nullptr;
  std::string (*of_jet)(const StoredJet&) = nullptr;
  std::string (*of_nominal)(const PropagationResult&, const RunResult&) = nullptr;

  /// Reads a file that describes its own content.
  StoredJet (*read)(const std::string& name, std::string_view bytes,
                    const std::optional<std::string>& label) = nullptr;
  /// Reads coefficients that a `summary.json` describes.
  FlowJet<Extended> (*read_coefficients)(const CoefficientFile&, std::string_view text) = nullptr;
  /// Reads coefficients without a description, in as many variables and orders as they have.
  std::vector<Series<double>> (*read_polynomials)(const std::string& name,
                                                  std::string_view text) = nullptr;
};

/// All formats.
const std::vector<const OutputFormat*>& output_formats();
/// The formats that the table `[output]` of a scene requests.
std::vector<const OutputFormat*> wanted_formats(const Scene& scene);
/// The endings of jet files, as ".h5, .dace or .csv", or with explanations: ".h5 (HDF5), ...".
std::string jet_file_endings(bool with_help = false);

}  // namespace hamjet::io
