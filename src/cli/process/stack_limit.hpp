#pragma once

namespace hamjet::cli {

/// Throws Error(too_large) if the system grants less stack (ulimit -s) than the program needs,
/// which would end it in the midst of the work without a word.
void require_stack();

}  // namespace hamjet::cli
