#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/maps/symplecticity.hpp"
#include "integrators/small_systems.hpp"
#include "integrators/symmetry/symmetry_reduction.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"

// A jet with the shift in time left out of the integration and put back. The flow commutes with the
// shift and a numerical map only to its error, so that it is compared with the jet in all variables
// where both have converged, and with the error where they have not.

namespace hamjet {
namespace {

using test::Flow;

DynamicalSystem oblate_earth() {
  ZonalGravity field{.mu = 1, .radius = 1};
  field.J[2] = 1.0826e-3;
  field.J[3] = -2.53e-6;
  return zonal_gravity(field);
}

template <class Real>
FlowProblem<Real> problem_from(const DynamicalSystem& system, const std::vector<double>& from,
                               int order, double duration, FlowSymmetry symmetry) {
  auto problem =
      test::problem_of(Flow<Real>{system, {from.begin(), from.end()}, Real(duration), order, {}});
  problem.symmetry = symmetry;
  return problem;
}

struct Integrated {
  FlowJet<Extended> jet;
  FlowSymmetry left_out = FlowSymmetry::none;
};

template <class Real>
Integrated integrated(const FlowProblem<Real>& problem, const GaussSettings& settings) {
  IntegrationStatistics statistics;
  auto jet = convert_map<Extended>(integrate_gauss<Real>(problem, settings, statistics));
  return {std::move(jet), statistics.left_out};
}

double largest_defect(const FlowJet<Extended>& jet) {
  double largest = 0;
  for (const SymplecticityDefect& entry : symplecticity_by_degree(jet)) {
    largest = test::larger(largest, entry.scaled);
  }
  return largest;
}

struct Case {
  const char* name;
  DynamicalSystem system;
  std::vector<double> start;
  FlowSymmetry left_out;
};

/// Orbits of several inclinations and places in them, and systems of their own.
std::vector<Case> cases() {
  const auto both = FlowSymmetry::rotation_and_time;
  return {{"low", oblate_earth(), {1.1, 0.1, -0.2, 0.05, 0.6, 0.75}, both},
          {"eccentric, from perigee", oblate_earth(), {0.3, -1.0, 0.4, 1.05, 0.4, 0.35}, both},
          {"polar, above the pole", oblate_earth(), {0.01, -0.02, 1.2, 0.6, 0.7, 0.03}, both},
          {"eccentric, in the equator", oblate_earth(), {0.8, 0.6, 0, -0.1, 1.05, 0.1}, both},
          {"pendulum", test::pendulum(), {0.3, 1.2}, FlowSymmetry::time},
          {"coupled", test::coupled_masses(), {0.4, -0.3, 0.5, 0.2}, FlowSymmetry::time}};
}

/// Expected: the flow's jet, of which both have the error of 8 stages; it is measured against a jet
/// of half the steps, whose own is 2^16 times smaller.
TEST(TimeReduction, IsTheFlow) {
  double duration = 1;
  for (const Case& one : cases()) {
    duration = -duration;  // there and back
    SCOPED_TRACE(one.name);
    const auto with = [&](FlowSymmetry symmetry, double step) {
      return integrated(problem_from<Extended>(one.system, one.start, 3, duration, symmetry),
                        test::fixed_step(8, step));
    };
    const Integrated whole = with(FlowSymmetry::none, 0.25);
    const Integrated finer = with(FlowSymmetry::none, 0.125);
    const Integrated reduced = with(FlowSymmetry::rotation_and_time, 0.25);
    EXPECT_EQ(reduced.left_out, one.left_out);
    for (int d = 0; d <= 3; ++d) {
      const double error = test::relative_error(whole.jet, finer.jet, d);
      // The reduced jet has the errors of other coefficients. They are divided by a part of the
      // speed that is 1/4 or more, up to three times, which is a factor of 64.
      EXPECT_LE(test::relative_error(reduced.jet, finer.jet, d), 64 * error) << d;
    }
  }
}

/// In double precision what is put together rounds no more than what is integrated. Steps of 1/16
/// leave rounding alone.
TEST(TimeReduction, RoundsNoMoreThanTheWholeJet) {
  for (const Case& one : cases()) {
    const auto run = [&](auto real, FlowSymmetry symmetry) {
      return integrated(problem_from<decltype(real)>(one.system, one.start, 3, 2, symmetry),
                        test::fixed_step(8, 0.0625));
    };
    const Integrated exact = run(Extended(), FlowSymmetry::rotation_and_time);
    const Integrated whole = run(0.0, FlowSymmetry::none);
    const Integrated reduced = run(0.0, FlowSymmetry::rotation_and_time);
    for (int d = 0; d <= 3; ++d) {
      // One draw of rounding can be smaller than another by this factor. The composition also sums
      // some 50 terms for a coefficient of degree 3, whose roundings add up to 4 units as likely as
      // not.
      const double allowed =
          10 * std::max(test::relative_error(whole.jet, exact.jet, d), 4 * 0x1p-52);
      EXPECT_LE(test::relative_error(reduced.jet, exact.jet, d), allowed)
          << one.name << ", degree " << d;
    }
  }
}

/// The defect of the brackets is that of the integration's error: it is there with steps that are
/// too long, while the jet in all variables is symplectic to rounding, and falls with the sixth
/// power of the step for three stages (2^6 in the limit; half of that as steps are not yet short).
TEST(TimeReduction, IsSymplecticToTheErrorAlone) {
  const std::vector<double> from = {1.1, 0.1, -0.2, 0.05, 0.6, 0.75};
  const auto defect = [&](FlowSymmetry symmetry, double step) {
    return largest_defect(integrated(problem_from<Extended>(oblate_earth(), from, 2, 2, symmetry),
                                     test::fixed_step(3, step))
                              .jet);
  };
  EXPECT_LE(defect(FlowSymmetry::none, 0.2), 1e4 * 0x1p-112);
  const double coarse = defect(FlowSymmetry::rotation_and_time, 0.2);
  const double fine = defect(FlowSymmetry::rotation_and_time, 0.1);
  EXPECT_GT(coarse, 1e-12);
  EXPECT_GT(coarse / fine, 32);
}

/// The nominal and its steps are the same as for the jet in all variables.
TEST(TimeReduction, TakesTheSameSteps) {
  const std::vector<double> from = {0.3, -1.0, 0.4, 1.05, 0.4, 0.35};
  const auto run = [&](FlowSymmetry symmetry, IntegrationStatistics& statistics) {
    return integrate_gauss(problem_from<double>(oblate_earth(), from, 4, 20, symmetry),
                           test::adaptive(8, 1e-12), statistics);
  };
  IntegrationStatistics whole;
  IntegrationStatistics reduced;
  const auto whole_jet = run(FlowSymmetry::none, whole);
  const auto reduced_jet = run(FlowSymmetry::rotation_and_time, reduced);
  EXPECT_EQ(reduced.left_out, FlowSymmetry::rotation_and_time);
  EXPECT_EQ(reduced.steps, whole.steps);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(reduced_jet[i][0], whole_jet[i][0]);
}

FlowSymmetry left_out_of(const FlowProblem<double>& problem) {
  const auto reduction = SymmetryReduction<double>::of(problem);
  return reduction ? reduction->left_out() : FlowSymmetry::none;
}

TEST(TimeReduction, StaysWhereThereIsNone) {
  const auto both = FlowSymmetry::rotation_and_time;
  const auto of = [&](const DynamicalSystem& system, const std::vector<double>& from) {
    return left_out_of(problem_from<double>(system, from, 2, 1, both));
  };
  // If the rotation stops the nominal, a shift in time is a rotation.
  EXPECT_EQ(of(kepler(1), {1, 0, 0, 0, 1, 0}), FlowSymmetry::rotation);
  EXPECT_EQ(of(test::pendulum(), {0, 0}), FlowSymmetry::none);
  auto problem =
      problem_from<double>(oblate_earth(), {1.1, 0.1, -0.2, 0.05, 0.6, 0.75}, 2, 1, both);
  EXPECT_EQ(left_out_of(problem), both);
  problem.symmetry = FlowSymmetry::rotation;
  EXPECT_EQ(left_out_of(problem), FlowSymmetry::rotation);
  // From a point on an axis the section is along it, and what crosses it is rounding.
  problem = problem_from<double>(oblate_earth(), {1.1, 0, 0.2, 0.3, 0.6, 0.7}, 5, 1, both);
  EXPECT_EQ(left_out_of(problem), both);
  // The flow leaves the variables that are expanded in.
  auto partial = test::problem_of(
      Flow<double>{oblate_earth(), {1.1, 0.1, -0.2, 0.05, 0.6, 0.75}, 1, 2, {0, 1, 3, 4}});
  partial.symmetry = both;
  EXPECT_EQ(left_out_of(partial), FlowSymmetry::rotation);
}

/// In the equatorial plane without J3 four variables are enough: the flow stays in it.
TEST(TimeReduction, TakesAPlaneThatTheFlowStaysIn) {
  ZonalGravity field{.mu = 1, .radius = 1};
  field.J[2] = 1.0826e-3;
  auto problem = test::problem_of(Flow<Extended>{
      zonal_gravity(field), {0.8, 0.6, 0, -0.1, 1.05, 0}, Extended(2), 3, {0, 1, 3, 4}});
  const auto whole = integrated(problem, test::fixed_step(16, 0.0625));
  problem.symmetry = FlowSymmetry::rotation_and_time;
  const auto reduced = integrated(problem, test::fixed_step(16, 0.0625));
  EXPECT_EQ(whole.left_out, FlowSymmetry::rotation);
  EXPECT_EQ(reduced.left_out, FlowSymmetry::rotation_and_time);
  // Both results have an error of 0.06^32, and rounding.
  for (int d = 0; d <= 3; ++d) {
    EXPECT_LE(test::relative_error(reduced.jet, whole.jet, d), 1e5 * 0x1p-112) << d;
  }
}

}  // namespace
}  // namespace hamjet
