#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/detail/algebra/double_double.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "support/magnitude.hpp"
#include "support/reference_data.hpp"

namespace hamjet::test {

/// A flow whose jet is integrated: the system, the start, the time and the order.
template <class Real>
struct Flow {
  DynamicalSystem system;
  std::vector<Real> start;
  Real duration = 0;
  int order = 1;
  std::vector<std::size_t> variables = {};  ///< if empty, all variables
  ClockTime start_time = ClockTime::epoch();
};

template <class Real = double>
Flow<Real> flow_of(const ReferenceOrbit& orbit, int order) {
  return {zonal_gravity(orbit.field),
          {orbit.start.begin(), orbit.start.end()},
          Real(orbit.duration),
          order,
          {}};
}

template <class Real>
FlowProblem<Real> problem_of(const Flow<Real>& flow) {
  FlowProblem<Real> problem{flow.system,     {},           flow.variables, flow.start,
                            flow.start_time, flow.duration};
  if (flow.variables.empty()) {
    problem.variables.resize(flow.system.dimension());
    std::iota(problem.variables.begin(), problem.variables.end(), std::size_t{0});
  }
  problem.space = SeriesSpace::create(problem.variables.size(), flow.order);
  return problem;
}

inline GaussSettings adaptive(int stages = 8, double tolerance = 1e-14) {
  GaussSettings settings;
  settings.stages = stages;
  settings.tolerance = tolerance;
  return settings;
}
inline GaussSettings fixed_step(int stages, double step) {
  GaussSettings settings;
  settings.stages = stages;
  settings.step = step;
  return settings;
}

/// The jet by a Gauss method; fills `statistics` if it is given.
template <class Real>
FlowJet<Real> run_gauss(const Flow<Real>& flow, const GaussSettings& settings = adaptive(),
                        IntegrationStatistics* statistics = nullptr) {
  IntegrationStatistics own;
  return integrate_gauss(problem_of(flow), settings, statistics != nullptr ? *statistics : own);
}

/// The jet by a Gauss method in the numbers of Real.
template <class Real>
FlowJet<Extended> jet_in(const Flow<Extended>& flow, const GaussSettings& settings,
                         FlowSymmetry symmetry = FlowSymmetry::none) {
  Flow<Real> converted{flow.system,    {}, convert<Real>(flow.duration), flow.order, flow.variables,
                       flow.start_time};
  for (const Extended& x : flow.start) converted.start.push_back(convert<Real>(x));
  FlowProblem<Real> problem = problem_of(converted);
  problem.symmetry = symmetry;
  IntegrationStatistics statistics;
  return convert_map<Extended>(integrate_gauss<Real>(problem, settings, statistics));
}

/// A jet in double-double numbers, to compare those in double precision with. DoubleDoubleGauss
/// compares such jets with those in numbers of 113 bits, which take ten times as long.
inline FlowJet<Extended> reference_jet(const Flow<Extended>& flow, const GaussSettings& settings) {
  return jet_in<DoubleDouble>(flow, settings);
}

/// The paper's orbit of order 4 by 16 stages: the reference for degrees 0..4.
inline const FlowJet<Extended>& paper_orbit_reference() {
  static const FlowJet<Extended> jet =
      reference_jet(flow_of<Extended>(paper_orbit(), 4), adaptive(16, 1e-24));
  return jet;
}

/// The largest error of the coefficients of a degree, relative to the largest reference coefficient
/// of that degree over all components.
template <class Real, class Reference>
double relative_error(const FlowJet<Real>& jet, const FlowJet<Reference>& reference, int degree) {
  double error = 0;
  double scale = 0;
  for (std::size_t i = 0; i < jet.size(); ++i) {
    const SeriesSpace& space = jet[i].space();
    for (std::size_t k = space.first(degree); k < space.first(degree + 1); ++k) {
      const double value =
          std::abs(static_cast<double>(Extended(Extended(jet[i][k]) - Extended(reference[i][k]))));
      error = larger(error, value);
      scale = std::max(scale, std::abs(static_cast<double>(reference[i][k])));
    }
  }
  return scale > 0 ? error / scale : error;
}

/// The constant terms: the nominal's final state.
template <class Real>
std::vector<Real> final_state(const FlowJet<Real>& jet) {
  std::vector<Real> state;
  for (const auto& component : jet) state.push_back(component[0]);
  return state;
}

/// Evaluates a list on numbers.
template <class Real>
std::vector<Real> evaluate_list(const OperationList& list, const std::vector<Real>& inputs) {
  const auto space = SeriesSpace::create(inputs.size(), 0);
  std::vector<Series<Real>> constants;
  for (const Real& x : inputs) constants.emplace_back(space, x);
  std::vector<Real> outputs;
  for (const auto& value : evaluate_on_series<Real>(list, constants)) {
    outputs.push_back(value[0]);
  }
  return outputs;
}

/// The value of the Hamiltonian.
template <class Real>
Real energy(const DynamicalSystem& system, const std::vector<Real>& state) {
  return evaluate_list(system.hamiltonian, state)[0];
}

}  // namespace hamjet::test
