#pragma once

#include <vector>

#include "least_time.hpp"

namespace hamjet {

/// The spans of time whose transfers take no more than the scene's budget and may be the least
/// (TransferPoint::is_candidate). Each begins and ends between a listed time, or that of the least
/// between them, that is in it and one that is not; bisection finds where. Adds the times answered
/// to the result.
std::vector<BudgetWindow> find_budget_windows(TransferResult& result, TransferPoints& points,
                                              const IntegratorSettings& integrator,
                                              const RelativeTransfer& ends,
                                              const ProgressCallback& progress);

}  // namespace hamjet
