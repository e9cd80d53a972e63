#pragma once

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// Adds the work of an integration to the sum over several that continue each other. Findings about
/// a single integration (estimates, lines, tolerances) are not added.
inline void add_integration(IntegrationStatistics& total, const IntegrationStatistics& one) {
  total.steps += one.steps;
  total.rejected_steps += one.rejected_steps;
  total.vector_field_evaluations += one.vector_field_evaluations;
  total.nominal_evaluations += one.nominal_evaluations;
  total.wall_seconds += one.wall_seconds;
}

}  // namespace hamjet
