#pragma once

#include <string>
#include <vector>

#include "hamjet/studies/validity.hpp"

namespace hamjet::io {

/// The first that a reader sees: how far each order carries at the last time.
std::string validity_verdict(const ValidityResult& result);

/// Why no separation could be proved in some order, where there is one, as a sentence after a
/// space.
std::string unproved_text(const ValidityResult& result);

/// What limits a reach in cells of a table: the degree in which the miss grows, how much of it is
/// of which coordinate of the deviation, and how much of the miss is in which coordinate of the
/// end.
inline const std::vector<std::string> limit_head = {"degree", "at the start", "at the end"};
std::vector<std::string> limit_cells(const ReachLimit& limit);

/// The same as a line for the highest order at the last time; empty where nothing limits it.
std::string reach_limit_text(const ValidityResult& result);

}  // namespace hamjet::io
