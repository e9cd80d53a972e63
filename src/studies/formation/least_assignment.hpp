#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hamjet {

/// The assignment of each row of a square matrix to a column of its own with the least sum; an
/// infinite entry is no pair. Nothing if there is none that gives every row a column. Sums are
/// compared to a part in 10^9 of the largest entry (the flow is computed in integers; Boost Graph,
/// successive shortest paths).
std::optional<std::vector<std::size_t>> least_assignment(
    const std::vector<std::vector<double>>& costs);

}  // namespace hamjet
