#pragma once

#include <string>

#include "attacked_run.hpp"

namespace hamjet::attack {

/// What the program made of a scene.
struct CommandRun {
  std::string
      difference;         ///< of exit codes or numbers of coefficients from the library's; or empty
  FlowJet<Extended> jet;  ///< as jet.csv has it
};

/// Runs the program on a scene that the library has run in this process.
CommandRun run_command(const std::string& program, const std::string& toml,
                       const AttackedRun& attacked);

}  // namespace hamjet::attack
