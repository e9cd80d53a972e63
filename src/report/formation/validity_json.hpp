#pragma once

#include <nlohmann/json.hpp>

#include "hamjet/studies/validity.hpp"

namespace hamjet::io {

/// What a validity study found, as a part of a summary.
nlohmann::ordered_json validity_json(const ValidityResult& result);
/// `summary.json` of a validity study.
nlohmann::ordered_json validity_report_json(const ValidityResult& result);

}  // namespace hamjet::io
