#pragma once

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// Adds what an integration took to the sum over several that go on from each other; what is said
/// of one alone (estimates, lines, tolerances) is no part of it.
inline void add_integration(IntegrationStatistics& total, const IntegrationStatistics& one) {
  total.steps += one.steps;
  total.rejected_steps += one.rejected_steps;
  total.vector_field_evaluations += one.vector_field_evaluations;
  total.nominal_evaluations += one.nominal_evaluations;
  total.wall_seconds += one.wall_seconds;
}

}  // namespace hamjet
