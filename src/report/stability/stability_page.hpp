#pragma once

#include <string>
#include <vector>

#include "../../studies/stability/stability.hpp"
#include "../drawing/chart_drawer.hpp"
#include "hamjet/detail/report/report_origin.hpp"

namespace hamjet::io {

/// The outcome of a suite: "63 cases: 40 right, 15 refused, 8 marked, none wrong."
std::string stability_verdict(const std::vector<StabilityResult>& results);

/// The page `stability.html`.
std::string stability_page(const std::vector<StabilityResult>& results, const ReportOrigin& origin,
                           ChartDrawer& drawer);

}  // namespace hamjet::io
