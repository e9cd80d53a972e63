#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/formats/stored_jet.hpp"
#include "stored_coefficients.hpp"

namespace hamjet::io {

/// A format of jets or nominals beside CSV and JSON, as scenes, results and `hamjet convert` know
/// it: its header and source say it once, and the list in output_formats.cpp names it. What a
/// format does not do is left null or empty.
struct OutputFormat {
  /// In `[output]`, where formats of one name are asked for together; empty: it is not asked for
  /// there, results always have it.
  std::string_view name = {};
  std::string_view help = {};  ///< for people: what a file of it is; empty where the ending says it
  std::string_view file;       ///< its name in the results, or in the folder of each run
  /// The ending of the jet files that `hamjet convert` writes and reads.
  std::string_view ending = {};
  int digits = 0;  ///< that a coefficient has at most; 0: all

  /// The library that a build may lack, and whether this build has it.
  std::string_view library = {};
  bool (*is_built)() = [] { return true; };
  bool needs_orbit = false;  ///< whether only models of orbits have it
  bool needs_date = false;   ///< whether the scene must have `[ephemeris]`

  /// One file of all runs; null: each run has its own file, of the jet or of the nominal.
  std::string (*of_results)(const PropagationResult&) = nullptr;
  std::string (*of_jet)(const StoredJet&) = nullptr;
  std::string (*of_nominal)(const PropagationResult&, const RunResult&) = nullptr;

  /// Reads a file that says itself what it holds.
  StoredJet (*read)(const std::string& name, std::string_view bytes,
                    const std::optional<std::string>& label) = nullptr;
  /// Reads coefficients whose `summary.json` says what they are of.
  FlowJet<Extended> (*read_coefficients)(const CoefficientFile&, std::string_view text) = nullptr;
  /// Reads coefficients by themselves, of as many variables and orders as they have.
  std::vector<Series<double>> (*read_polynomials)(const std::string& name,
                                                  std::string_view text) = nullptr;
};

/// All formats.
const std::vector<const OutputFormat*>& output_formats();
/// Those that the scene's `[output]` asks for.
std::vector<const OutputFormat*> wanted_formats(const Scene& scene);
/// The endings of jet files: ".h5, .dace or .csv"; with help ".h5 (HDF5), ...".
std::string jet_file_endings(bool with_help = false);

}  // namespace hamjet::io
