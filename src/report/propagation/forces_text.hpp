#pragma once

#include <string>

#include "hamjet/studies/propagation.hpp"

namespace hamjet::io {

/// By degree, what forces that are none of a Hamiltonian leave of symplecticity and exactness in a
/// run, and what the integration adds. Empty for other systems.
std::string forces_lines(const PropagationResult& result, const RunResult& run);

}  // namespace hamjet::io
