#pragma once

#include <optional>
#include <string>

#include "hamjet/formats/jet_file.hpp"

namespace CLI {
class App;
}

namespace hamjet::cli {

struct ConvertOptions {
  std::string from;  ///< results of `hamjet run`, or a file of a jet
  std::string to;    ///< .h5, .dace or .csv
  std::optional<std::string> run;
  std::optional<std::string> time;             ///< time of the jet in seconds; absent: the end
  std::optional<std::string> coordinates;      ///< coordinates at both ends; absent: as they are
  std::optional<std::string> end_coordinates;  ///< coordinates at the end alone
  std::optional<std::string> scene;            ///< scene of the jet, for the field of flow boxes
  io::JetDescription foreign;                  ///< what is told of a jet from elsewhere
};

CLI::App* add_convert_command(CLI::App& app, ConvertOptions& options);

/// Writes a stored jet in another format; returns the exit code.
int convert(const ConvertOptions& options);

}  // namespace hamjet::cli
