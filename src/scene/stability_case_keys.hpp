#pragma once

#include <string_view>
#include <vector>

// Keys of the table `[case]`, which `hamjet stability` reads and other commands only check.

namespace hamjet::io {

/// The keys of every case, of one that is refused, of one that is marked, and of what is measured.
inline const std::vector<std::string_view> common_case_keys = {"group", "why", "outcome"};
inline const std::vector<std::string_view> refusal_case_keys = {"exit_code", "message"};
inline const std::vector<std::string_view> mark_case_keys = {"mark"};
inline const std::vector<std::string_view> reference_case_keys = {
    "source", "state", "matrix", "tolerance", "twin", "condition", "growth", "round_trip"};

}  // namespace hamjet::io
