#pragma once

#include <algorithm>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// The states carried along the flow by times that vanish at the chief, by one step of a Gauss
/// method. The end of the step is needed as a polynomial in the step of no higher degree than the
/// series'; a method of s stages is exact up to its order, degree 2 s.
template <class Real>
SixNumbers<Series<Real>> carried(const SharedSystem& crossing, const SixNumbers<Series<Real>>& z,
                                 const Series<Real>& time) {
  const SpacePointer& space = time.space_pointer();
  FlowProblem<Real> flow{crossing, space, {}, {}, ClockTime::epoch()};
  // The variables of a flow that goes on from a jet are only counted.
  flow.variables.assign(space->variables(), 0);
  flow.duration = Real(1);
  flow.symmetry = FlowSymmetry::none;
  flow.initial_jet = FlowJet<Real>{z[0], z[1], z[2], time, z[3], z[4], z[5], Series<Real>(space)};
  for (const auto& component : *flow.initial_jet) flow.initial_state.push_back(component[0]);
  GaussSettings settings;
  settings.stages = std::clamp(space->order(), 2, 16);
  settings.step = 1;
  IntegrationStatistics statistics;
  const FlowJet<Real> end = integrate_gauss<Real>(flow, settings, statistics);
  return {end[0], end[1], end[2], end[4], end[5], end[6]};
}

}  // namespace hamjet
