#pragma once

#include <string_view>

namespace hamjet::io {

/// Scans the tokens of the text outside strings and comments. Throws Error(scene) with line and
/// column for a number out of range, for nesting that is too deep, and for a character that is not
/// ASCII (see `check_scene_text`). Other errors of syntax are left to the TOML parser. `source` is
/// the name for messages.
void check_tokens(std::string_view text, std::string_view source);

}  // namespace hamjet::io
