#include "comparison_charts.hpp"

#include "../drawing/along_time_charts.hpp"

namespace hamjet::io {

std::vector<Chart> comparison_charts(const ComparisonResult& result) {
  std::vector<Chart> charts = {
      work_precision_chart(result),
      exactness_chart(result),
      symplecticity_chart(result),
      exactness_along_time_chart(result.scene, result.kind, result.along_time),
      energy_along_time_chart(result.scene, result.along_time),
      cost_chart(result),
      convergence_chart(result)};
  for (Chart& chart : charts) fit(chart);
  return charts;
}

}  // namespace hamjet::io
