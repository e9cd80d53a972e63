#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet::io {

/// Names of the 2n variables of a generating function: the final variables, then the initial ones
/// with a 0 appended.
std::vector<std::string> generating_function_variables(const PropagationResult& result,
                                                       const GeneratingFunctionKind& kind);

/// The name of a kind in files and tables: as the scene has it and, for `auto`, the kind that was
/// chosen.
std::string kind_name(const KindResult& kind);

/// The beginning of the names of folders for jets at times before the duration.
inline constexpr std::string_view time_folder_head = "time-";
/// The folder of a run's jet at the time with this index, beside the other files of the run.
std::string time_folder(std::size_t index);

/// Whether a residual is no more than its rounding floor, to a factor of ten; the floor itself is a
/// single sample of round-off.
bool is_at_floor(const ExactnessEntry& entry);

}  // namespace hamjet::io
