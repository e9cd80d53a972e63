#pragma once

#include <string>

#include "attacked_run.hpp"

namespace hamjet::attack {

/// Runs the program on the scene and compares exit code and jet.csv, number by number, with what
/// the library made of it in this process; empty if they agree.
std::string difference_of_command(const std::string& program, const std::string& toml,
                                  const AttackedRun& attacked);

}  // namespace hamjet::attack
