#pragma once

#include <string>

#include "attacked_run.hpp"

namespace hamjet::attack {

/// The results of the program for a scene.
struct CommandRun {
  std::string difference;  ///< difference between the program's exit code or numbers of
                           ///< coefficients and the library's; or empty
  FlowJet<Extended> jet;   ///< the jet in jet.csv
};

/// Runs the program on a scene that the library has run in this process.
CommandRun run_command(const std::string& program, const std::string& toml,
                       const AttackedRun& attacked);

}  // namespace hamjet::attack
