#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hamjet {

/// The column of each row of a matrix, none where there is none for it.
using Assignment = std::vector<std::optional<std::size_t>>;

/// The assignment of rows to columns, each at most once, of as many pairs as the smaller side has,
/// with the least sum; an infinite entry is no pair. Nothing if there are not so many pairs. Sums
/// are compared to a part in 10^9 of the largest entry (the flow is computed in integers; Boost
/// Graph, successive shortest paths). Precondition: the rows are as long as each other.
std::optional<Assignment> least_assignment(const std::vector<std::vector<double>>& costs);

}  // namespace hamjet
