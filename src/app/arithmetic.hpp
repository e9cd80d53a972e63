#pragma once

namespace hamjet::cli {

/// Puts the processor into the state in which it rounds to nearest and keeps denormal numbers: a
/// library that was loaded with the program may have changed that (one linked with -ffast-math
/// does). Threads that are started later inherit it. Throws Error(numerical) if the state cannot be
/// set.
void reset_arithmetic();

}  // namespace hamjet::cli
