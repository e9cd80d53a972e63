#pragma once

#include <string>

namespace hamjet::cli {

/// Prints what scenes may name: `what` is systems, integrators, kinds or keys. Returns the exit
/// code.
int list(const std::string& what);

}  // namespace hamjet::cli
