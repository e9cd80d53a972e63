#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hamjet {

/// The column that is assigned to each row of a matrix; no value for a row without one.
using Assignment = std::vector<std::optional<std::size_t>>;

/// The assignment of rows to columns with the least sum. Each row and column is used at most once,
/// and there are as many pairs as the smaller side has; an infinite entry cannot be a pair. No
/// value if there are not that many pairs. Sums are compared to a part in 10^9 of the largest entry
/// (the flow is computed in integers; Boost Graph, successive shortest paths). Precondition: all
/// rows have the same length.
std::optional<Assignment> least_assignment(const std::vector<std::vector<double>>& costs);

}  // namespace hamjet
