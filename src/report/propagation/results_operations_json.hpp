#pragma once

#include <nlohmann/json.hpp>

#include "hamjet/studies/propagation.hpp"

namespace hamjet::io {

/// What a run did: counts that were kept where the work is done.
nlohmann::ordered_json operations_json(const PropagationResult& result, const RunResult& run);

/// What was done for all runs together and for none of them alone.
nlohmann::ordered_json operations_json(const PropagationResult& result);

/// What was not done because the scene does not need it, and why.
nlohmann::ordered_json skipped_json(const PropagationResult& result);

}  // namespace hamjet::io
