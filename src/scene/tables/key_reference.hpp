#pragma once

#include <string>

namespace hamjet::io {

/// All keys of a scene with unit, range and default as a page in Markdown, from what the tables
/// declare. data/scenes/keys/README.md holds it.
std::string key_reference();

}  // namespace hamjet::io
