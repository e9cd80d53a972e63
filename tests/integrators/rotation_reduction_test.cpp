#include "integrators/symmetry/rotation_reduction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"
#include "hamjet/integrators/symmetric_composition.hpp"
#include "hamjet/maps/symplecticity.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"

// The jet with the rotation left out of the integration and put back is that of the same numerical
// map: in extended precision to its rounding, and in double precision with the same accuracy as the
// jet that is integrated in all variables.

namespace hamjet {
namespace {

using test::Flow;

/// The field of the tests: J2 to J4 of the Earth, in units of its radius.
DynamicalSystem earth() {
  ZonalGravity field{.mu = 1, .radius = 1};
  field.J[2] = 1.0826e-3;
  field.J[3] = -2.53e-6;
  field.J[4] = -1.62e-6;
  return zonal_gravity(field);
}

struct NamedStart {
  const char* name;
  std::vector<double> state;
};

/// Orbits of all inclinations and places: low, eccentric, polar above the pole, retrograde.
const std::vector<NamedStart>& starts() {
  static const std::vector<NamedStart> all = {
      {"low", {1.1, 0.1, -0.2, 0.05, 0.6, 0.75}},
      {"eccentric, from perigee", {0.3, -1.0, 0.4, 1.05, 0.4, 0.35}},
      {"polar, above the pole", {0.01, -0.02, 1.2, 0.6, 0.7, 0.03}},
      {"retrograde, nearly equatorial", {-1.3, 0.4, 0.02, 0.3, 0.8, -0.01}}};
  return all;
}

template <class Real>
Flow<Real> flow_from(const NamedStart& start, int order, double duration) {
  return {earth(), {start.state.begin(), start.state.end()}, Real(duration), order, {}};
}

/// Integrates with or without the rotation.
template <class Real, class Integrate>
FlowJet<Real> with(FlowSymmetry symmetry, FlowProblem<Real> problem, const Integrate& integrate) {
  problem.symmetry = symmetry;
  IntegrationStatistics statistics;
  FlowJet<Real> jet = integrate(problem, statistics);
  EXPECT_EQ(statistics.left_out, symmetry);
  return jet;
}

/// The methods that can leave out the rotation, with fixed steps.
template <class Real>
using Method = std::function<FlowJet<Real>(const FlowProblem<Real>&, IntegrationStatistics&)>;
template <class Real>
std::vector<Method<Real>> methods() {
  return {[](const auto& problem, auto& statistics) {
            return integrate_gauss<Real>(problem, test::fixed_step(8, 0.25), statistics);
          },
          [](const auto& problem, auto& statistics) {
            return integrate_gauss<Real>(problem, test::fixed_step(1, 0.1), statistics);
          },
          [](const auto& problem, auto& statistics) {
            return integrate_stormer<Real>(problem, {0.1}, statistics);
          },
          [](const auto& problem, auto& statistics) {
            return integrate_velocity_verlet<Real>(problem, {0.1}, statistics);
          },
          [](const auto& problem, auto& statistics) {
            return integrate_symmetric_composition<Real>(problem, {4, 0.1}, statistics);
          }};
}

TEST(RotationReduction, IsTheSameNumericalMap) {
  for (const NamedStart& start : starts()) {
    for (const double duration : {0.5, -0.4}) {
      std::size_t number = 0;
      for (const auto& method : methods<Extended>()) {
        SCOPED_TRACE(std::string(start.name) + ", method " + std::to_string(number++));
        const auto problem = test::problem_of(flow_from<Extended>(start, 4, duration));
        const auto whole = with(FlowSymmetry::none, problem, method);
        const auto reduced = with(FlowSymmetry::rotation, problem, method);
        for (int d = 0; d <= 4; ++d) {
          // The bound is 113 bits and a factor of a thousand for the terms of the steps that
          // cancel.
          EXPECT_LE(test::relative_error(reduced, whole, d), 1e3 * 0x1p-112) << d;
        }
      }
    }
  }
}

TEST(RotationReduction, RoundsNoMoreThanTheWholeJet) {
  for (const NamedStart& start : starts()) {
    const auto method = methods<double>()[0];
    const auto problem = test::problem_of(flow_from<double>(start, 4, 12));
    const auto exact =
        test::reference_jet(flow_from<Extended>(start, 4, 12), test::fixed_step(8, 0.25));
    const auto error = [&](FlowSymmetry symmetry, int d) {
      const auto jet = convert_map<Extended>(with(symmetry, problem, method));
      return static_cast<double>(test::relative_error(jet, exact, d));
    };
    for (int d = 0; d <= 4; ++d) {
      // One draw of rounding can be smaller than another by this factor.
      const double allowed = 10 * std::max(error(FlowSymmetry::none, d), 0x1p-52);
      EXPECT_LE(error(FlowSymmetry::rotation, d), allowed) << start.name << ", degree " << d;
    }
  }
}

TEST(RotationReduction, LeavesTheJetSymplectic) {
  for (const NamedStart& start : starts()) {
    const auto problem = test::problem_of(flow_from<double>(start, 4, 6));
    const auto defect = [&](FlowSymmetry symmetry) {
      double largest = 0;
      for (const SymplecticityDefect& entry : symplecticity_by_degree(
               convert_map<Extended>(with(symmetry, problem, methods<double>()[0])))) {
        largest = test::larger(largest, entry.scaled);
      }
      return largest;
    };
    EXPECT_LE(defect(FlowSymmetry::rotation), 10 * defect(FlowSymmetry::none)) << start.name;
  }
}

TEST(RotationReduction, TakesTheSameSteps) {
  const auto problem = test::problem_of(flow_from<double>(starts()[1], 4, 20));
  auto whole = problem;
  whole.symmetry = FlowSymmetry::none;
  IntegrationStatistics reduced_statistics;
  IntegrationStatistics whole_statistics;
  const auto reduced_jet = integrate_gauss(problem, test::adaptive(), reduced_statistics);
  const auto whole_jet = integrate_gauss(whole, test::adaptive(), whole_statistics);
  EXPECT_EQ(reduced_statistics.steps, whole_statistics.steps);
  EXPECT_EQ(reduced_statistics.step_tolerance, whole_statistics.step_tolerance);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(reduced_jet[i][0], whole_jet[i][0]);
}

/// The jet along a line of deviations is that of the composition with numbers: every variable and
/// every order of variables.
TEST(RotationReduction, TakesVariablesInAnyOrder) {
  auto flow = flow_from<Extended>(starts()[0], 3, 2);
  const auto sorted = with(FlowSymmetry::none, test::problem_of(flow), methods<Extended>()[0]);
  flow.variables = {5, 1, 3, 0, 2, 4};
  const auto jet = with(FlowSymmetry::rotation, test::problem_of(flow), methods<Extended>()[0]);
  const SeriesSpace& space = jet[0].space();
  for (std::size_t k = 0; k < space.size(); ++k) {
    std::vector<std::uint8_t> exponents(6);
    for (std::size_t v = 0; v < 6; ++v) exponents[flow.variables[v]] = space.exponents(k)[v];
    const std::size_t place = space.index(exponents);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_LE(abs(jet[i][k] - sorted[i][place]), 1e-29 * (1 + abs(sorted[i][place])));
    }
  }
}

TEST(RotationReduction, TakesAPlaneWithoutAxis) {
  // The equatorial plane alone, in which a rotation turns all coordinates.
  const std::vector<std::size_t> plane = {0, 1};
  ZonalGravity field{.mu = 1, .radius = 1};
  field.J[2] = 1.0826e-3;
  const Flow<Extended> flow{
      restrict_system(zonal_gravity(field), plane), {1.1, 0.2, -0.1, 0.9}, Extended(3), 5, {}};
  const auto problem = test::problem_of(flow);
  const auto whole = with(FlowSymmetry::none, problem, methods<Extended>()[0]);
  const auto reduced = with(FlowSymmetry::rotation, problem, methods<Extended>()[0]);
  for (int d = 0; d <= 5; ++d) {
    EXPECT_LE(test::relative_error(reduced, whole, d), 1e3 * 0x1p-112) << d;
  }
}

TEST(RotationReduction, ObserverSeesWholeJets) {
  const auto problem = test::problem_of(flow_from<double>(starts()[0], 2, 2));
  const auto last_seen = [&](bool constants_alone) {
    FlowJet<double> seen;
    auto watched = problem;
    watched.observes_constant_terms = constants_alone;
    IntegrationStatistics statistics;
    const auto jet =
        integrate_gauss<double>(watched, test::adaptive(), statistics,
                                [&](double, const FlowJet<double>& now) { seen = now; });
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(seen[i][0], jet[i][0]);
    return seen;
  };
  IntegrationStatistics statistics;
  const auto jet = integrate_gauss(problem, test::adaptive(), statistics);
  const auto seen = last_seen(false);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_TRUE(std::ranges::equal(seen[i].coefficients(), jet[i].coefficients()));
  }
  EXPECT_EQ(last_seen(true)[0].space().variables(), 5U);
}

TEST(RotationReduction, StaysWhereThereIsNone) {
  const auto is_left_out = [](const FlowProblem<double>& problem) {
    return RotationReduction<double>::of(problem).has_value();
  };
  const auto problem = test::problem_of(flow_from<double>(starts()[0], 2, 2));
  EXPECT_TRUE(is_left_out(problem));
  auto asked_for_none = problem;
  asked_for_none.symmetry = FlowSymmetry::none;
  EXPECT_FALSE(is_left_out(asked_for_none));
  auto going_on = problem;
  going_on.initial_jet = starting_jet(problem);
  EXPECT_FALSE(is_left_out(going_on));
  auto nominal_alone = test::problem_of(flow_from<double>(starts()[0], 0, 2));
  EXPECT_FALSE(is_left_out(nominal_alone));
  // Position and momentum are along the axis.
  auto on_axis = problem;
  on_axis.initial_state = {0.01, 0, 1.2, 0, 0.01, 0.8};
  EXPECT_FALSE(is_left_out(on_axis));
  auto partial = flow_from<double>(starts()[0], 2, 2);
  partial.variables = {0, 2, 3, 4};
  EXPECT_FALSE(is_left_out(test::problem_of(partial)));
  partial.variables = {0, 1, 3, 4};
  EXPECT_TRUE(is_left_out(test::problem_of(partial)));
}

/// Two masses on a plane each, drawn to the origin and to each other: turned together.
struct TwoBodies {
  double asymmetry = 0;

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    const T first = q[0] * q[0] + q[1] * q[1];
    const T second = q[2] * q[2] + q[3] * q[3];
    const T between = square(q[0] - q[2]) + square(q[1] - q[3]);
    const T kinetic = (square(p[0]) + square(p[1]) + square(p[2]) + square(p[3])) / T(2);
    return kinetic + first + square(second) + square(between) / T(3) + T(asymmetry) * q[0];
  }
};

TEST(RotationReduction, TakesASystemOfOnesOwn) {
  const DynamicalSystem bare = make_system("two bodies", 4, TwoBodies{});
  const DynamicalSystem system = with_rotation(bare, {{0, 1}, {2, 3}});
  const std::vector<Extended> start = {1, 0.2, -0.5, 0.4, 0.1, 0.3, 0.2, -0.6};
  const auto problem = test::problem_of(Flow<Extended>{system, start, Extended(1), 3, {}});
  const auto whole = with(FlowSymmetry::none, problem, methods<Extended>()[0]);
  const auto reduced = with(FlowSymmetry::rotation, problem, methods<Extended>()[0]);
  for (int d = 0; d <= 3; ++d) {
    EXPECT_LE(test::relative_error(reduced, whole, d), 1e3 * 0x1p-112) << d;
  }
}

TEST(RotationReduction, RefusesWhatIsNoSymmetry) {
  const auto declare = [](double asymmetry, std::vector<std::array<std::size_t, 2>> planes) {
    return with_rotation(make_system("two bodies", 4, TwoBodies{asymmetry}), std::move(planes));
  };
  EXPECT_NO_THROW(declare(0, {{0, 1}, {2, 3}}));
  test::expect_error(ErrorKind::usage, "must stay as it is", [&] { declare(0, {{0, 1}}); });
  test::expect_error(ErrorKind::usage, "must stay as it is", [&] {
    declare(1e-14, {{0, 1}, {2, 3}});
  });
  test::expect_error(ErrorKind::usage, "stands twice", [&] { declare(0, {{0, 1}, {1, 3}}); });
  test::expect_error(ErrorKind::usage, "out of range", [&] { declare(0, {{0, 4}}); });
}

/// The declarations of systems are true: with_rotation checks them.
TEST(RotationReduction, DeclaredOnesAreSymmetries) {
  for (const DynamicalSystem& system : {earth(), kepler(1)}) {
    ASSERT_EQ(system.rotated_planes.size(), 2U);
    EXPECT_EQ(with_rotation(system, {{0, 1}}).rotated_planes, system.rotated_planes);
  }
}

}  // namespace
}  // namespace hamjet
