#pragma once

#include <string>
#include <string_view>

#include "quantity_text.hpp"

namespace hamjet::io {

/// Escapes a text so that HTML and XML show it literally, in elements and in attributes.
std::string escape_html(std::string_view text);

}  // namespace hamjet::io
