#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hamjet::io {

/// A JSON value in the form in which all files and outputs have it. JSON has no numbers that are
/// not finite: they become the strings "inf", "-inf" and "nan"; null means not computed. Characters
/// that control a terminal are escaped. `indent` is that of nlohmann's dump.
std::string json_text(nlohmann::ordered_json value, int indent = 2);

}  // namespace hamjet::io
