#pragma once

#include <string>

#include "table_description.hpp"

namespace hamjet::io {

/// All keys of a scene, and of a study of `hamjet sweep`, with unit, range and default as a page in
/// Markdown, from what the tables declare. data/scenes/keys/README.md holds it.
std::string key_reference(const TableDescription& sweep_study);

}  // namespace hamjet::io
