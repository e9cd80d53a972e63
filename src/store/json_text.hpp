#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hamjet::io {

/// A value as all files and outputs have it. JSON has no numbers that are not finite: they stand
/// there as the strings "inf", "-inf" and "nan", wherever they come from; null is what was not
/// computed. Characters that drive a terminal are escaped. `indent` as nlohmann's dump has it.
std::string json_text(nlohmann::ordered_json value, int indent = 2);

}  // namespace hamjet::io
