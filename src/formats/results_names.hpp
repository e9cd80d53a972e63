#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet::io {

/// Names of the 2n variables of a generating function: final ones, then initial ones with a 0
/// behind.
std::vector<std::string> generating_function_variables(const PropagationResult& result,
                                                       const GeneratingFunctionKind& kind);

/// The name of a kind in files and tables: as the scene wrote it, and for `auto` the kind it chose.
std::string kind_name(const KindResult& kind);

/// What the names of such folders begin with.
inline constexpr std::string_view time_folder_head = "time-";
/// The folder of a run's jet at the time of this index, beside its other files.
std::string time_folder(std::size_t index);

/// Whether a residual says no more than its rounding floor: within a factor of ten, for that is
/// itself one sample of round-off.
bool is_at_floor(const ExactnessEntry& entry);

}  // namespace hamjet::io
