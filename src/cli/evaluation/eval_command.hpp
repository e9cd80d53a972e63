#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../../app/eval_coordinates.hpp"

namespace CLI {
class App;
}

namespace hamjet::cli {

struct EvalOptions {
  std::string directory;  ///< results of `hamjet run`, or a file of theirs; or a scene, or -
  std::optional<std::string>
      standard_input;                     ///< text of standard input, if a scene is read from there
  std::optional<std::string> deviation;   ///< one deviation, numbers between commas
  std::optional<std::string> deviations;  ///< a CSV file of deviations
  std::optional<std::string> deputy;      ///< a scene, whose deputy it is
  std::optional<std::string> run;         ///< label of the integrator's run
  std::vector<std::string> overrides;     ///< key=value, of the scene
  EvalFrames frames;
  std::optional<std::string> time;     ///< times of the jets: seconds between commas, or all
  std::optional<int> degree;           ///< truncates the jet
  std::optional<std::size_t> threads;  ///< absent: as many as the process may use
  std::optional<std::string> output;   ///< CSV file; absent: standard output
  bool json = false;
  bool strict = false;  ///< a row that is not inside makes the exit code 1
  bool quiet = false;
};

CLI::App* add_eval_command(CLI::App& app, EvalOptions& options);

/// Maps deviations through a stored jet, or a scene's polynomials; returns the exit code.
int eval(const EvalOptions& given);

}  // namespace hamjet::cli
