#pragma once

#include <vector>

#include "least_time.hpp"

namespace hamjet {

/// The spans of time in which transfers cost no more than the scene's budget and may be the least
/// (TransferPoint::is_candidate). The end of a span lies between a time inside and one outside,
/// which are listed times or the time of the least answer between them; bisection finds it. Adds
/// the times that were answered to the result.
std::vector<BudgetWindow> find_budget_windows(TransferResult& result, TransferPoints& points,
                                              const IntegratorSettings& integrator,
                                              const RelativeTransfer& ends,
                                              const ProgressCallback& progress);

}  // namespace hamjet
