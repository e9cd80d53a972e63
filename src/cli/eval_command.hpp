#pragma once

#include <optional>
#include <string>

#include "../app/eval_coordinates.hpp"

namespace CLI {
class App;
}

namespace hamjet::cli {

struct EvalOptions {
  std::string directory;                  ///< results of `hamjet run`, or a file of theirs
  std::optional<std::string> deviation;   ///< one deviation, numbers between commas
  std::optional<std::string> deviations;  ///< a CSV file of them
  std::optional<std::string> deputy;      ///< a scene, whose deputy it is
  std::optional<std::string> run;         ///< label of the integrator's run
  EvalFrames frames;
  std::optional<std::string> time;    ///< of the jets: seconds between commas, or all
  std::optional<int> degree;          ///< truncates the jet
  std::optional<std::string> output;  ///< CSV file; absent: standard output
  bool json = false;
  bool strict = false;  ///< a row that is not inside makes the exit code 1
  bool quiet = false;
};

CLI::App* add_eval_command(CLI::App& app, EvalOptions& options);

/// Maps deviations through a stored jet; returns the exit code.
int eval(const EvalOptions& options);

}  // namespace hamjet::cli
