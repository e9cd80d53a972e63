#pragma once

#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet::benchmarks {

/// The paper's Earth orbit in canonical units, over 10 pi.
inline const ZonalGravity paper_field{
    1.0, 6378.137 / 7000, {{2, 1.082626675e-3}, {3, 2.532436e-6}}};
inline constexpr double paper_duration = 31.41592653589793;

/// A problem with its system at hand.
struct Case {
  DynamicalSystem system;
  SpacePointer space;
  std::vector<std::size_t> variables;
  std::vector<double> nominal;
  double duration = paper_duration;

  FlowProblem<double> problem() const {
    return {system, space, variables, nominal, ClockTime::epoch(), duration};
  }
};

/// The paper's orbit with a field, an order, all six variables.
Case paper_case(const ZonalGravity& field, int order);

/// An equatorial orbit of the same size without J3, reduced to its plane: four variables.
Case planar_case(int order);

/// The largest error of a coefficient over all degrees, each relative to the largest coefficient of
/// its degree in the extended-precision reference.
double worst_error(const FlowJet<double>& jet, const FlowJet<Extended>& reference);

/// The reference: Gauss with 16 stages in extended precision.
FlowJet<Extended> reference_jet(const Case& c);

// The benchmarks, each printing its table.
void benchmark_integrators();
void benchmark_products();
void benchmark_evaluation();
void benchmark_inversion();
void benchmark_orders();
void benchmark_savings();
void benchmark_zonals();
void benchmark_own();
void benchmark_fields();
void benchmark_earth_maps();
void benchmark_arcs();
void benchmark_many();

}  // namespace hamjet::benchmarks
