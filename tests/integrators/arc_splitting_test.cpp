#include "hamjet/integrators/arc_splitting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "dynamics/double_well.hpp"
#include "dynamics/fermi_pasta_ulam.hpp"
#include "dynamics/oscillator_pair.hpp"
#include "hamjet/maps/symplecticity.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"

// Jets of one arc in pieces: the same map as in one piece, to the same error, whatever the number
// of threads.

namespace hamjet {
namespace {

using test::adaptive;
using test::fixed_step;
using test::Flow;

template <class Real>
FlowJet<Real> split(const FlowProblem<Real>& problem, const SplittableMethod& method,
                    std::size_t arcs, std::size_t threads = 1, ArcStatistics* arc_statistics = {},
                    IntegrationStatistics* statistics = {}) {
  IntegrationStatistics own;
  ArcStatistics own_arcs;
  return integrate_in_arcs<Real>(problem, method, {arcs, threads},
                                 statistics != nullptr ? *statistics : own,
                                 arc_statistics != nullptr ? *arc_statistics : own_arcs);
}

template <class Real>
FlowJet<Real> unsplit(const FlowProblem<Real>& problem, const SplittableMethod& method,
                      IntegrationStatistics* statistics = {}) {
  IntegrationStatistics own;
  IntegrationStatistics& filled = statistics != nullptr ? *statistics : own;
  if (const auto* m = std::get_if<GaussSettings>(&method)) {
    return integrate_gauss(problem, *m, filled);
  }
  if (const auto* m = std::get_if<StormerSettings>(&method)) {
    return integrate_stormer(problem, *m, filled);
  }
  if (const auto* m = std::get_if<VelocityVerletSettings>(&method)) {
    return integrate_velocity_verlet(problem, *m, filled);
  }
  return integrate_symmetric_composition(problem, std::get<SymmetricCompositionSettings>(method),
                                         filled);
}

/// Whether all coefficients have the same bits.
template <class Real>
bool is_same(const FlowJet<Real>& a, const FlowJet<Real>& b) {
  bool result = a.size() == b.size();
  for (std::size_t i = 0; result && i < a.size(); ++i) {
    for (std::size_t k = 0; k < a[i].size(); ++k) result = result && a[i][k] == b[i][k];
  }
  return result;
}

template <class Real>
double worst_difference(const FlowJet<Real>& a, const FlowJet<Real>& b) {
  double worst = 0;
  for (int d = 0; d <= a[0].order(); ++d)
    worst = test::larger(worst, test::relative_error(a, b, d));
  return worst;
}

const std::vector<SplittableMethod>& all_methods() {
  static const std::vector<SplittableMethod> methods = {adaptive(8, 1e-12),
                                                        fixed_step(4, 0.2),
                                                        fixed_step(1, 0.05),
                                                        adaptive(12, 1e-13),
                                                        StormerSettings{0.02},
                                                        VelocityVerletSettings{0.02},
                                                        SymmetricCompositionSettings{6, 0.1}};
  return methods;
}

Flow<double> short_orbit(int order, double duration = 5) {
  Flow<double> flow = test::flow_of(test::paper_orbit(), order);
  flow.duration = duration;
  return flow;
}

TEST(ArcSplitting, HasTheSameBitsOnAnyNumberOfThreads) {
  const auto flow = short_orbit(3, 12);
  const auto problem = test::problem_of(flow);
  for (const SplittableMethod& method : all_methods()) {
    for (const std::size_t arcs : {2U, 3U, 5U}) {
      ArcStatistics statistics;
      const auto one = split(problem, method, arcs, 1, &statistics);
      EXPECT_EQ(statistics.plan.arcs, arcs);
      EXPECT_EQ(statistics.compositions, static_cast<long>(arcs) - 1);
      for (const std::size_t threads : {2U, 4U, 7U}) {
        EXPECT_TRUE(is_same(split(problem, method, arcs, threads), one))
            << "method " << method.index() << ", arcs " << arcs << ", threads " << threads;
      }
    }
  }
}

TEST(ArcSplitting, HasTheStepsAndTheNominalOfTheUnsplitRunBitForBit) {
  for (const double duration : {5.0, -5.0}) {
    const auto flow = short_orbit(2, duration);
    const auto problem = test::problem_of(flow);
    for (const SplittableMethod& method : all_methods()) {
      IntegrationStatistics whole;
      IntegrationStatistics in_arcs;
      const auto jet = unsplit(problem, method, &whole);
      const auto pieces = split(problem, method, 4, 2, nullptr, &in_arcs);
      EXPECT_EQ(test::final_state(pieces), test::final_state(jet)) << method.index();
      EXPECT_EQ(in_arcs.steps, whole.steps);
      EXPECT_EQ(in_arcs.rejected_steps, whole.rejected_steps);
      EXPECT_EQ(in_arcs.most_newton_iterations, whole.most_newton_iterations);
      EXPECT_EQ(in_arcs.largest_step_error, whole.largest_step_error);
      EXPECT_GE(in_arcs.vector_field_evaluations, whole.vector_field_evaluations);
      EXPECT_LE(worst_difference(pieces, jet), 2e-12) << method.index();
    }
  }
}

TEST(ArcSplitting, OneArcIsTheUnsplitRunBitForBit) {
  for (const int order : {1, 3}) {
    const auto flow = short_orbit(order);
    auto problem = test::problem_of(flow);
    problem.symmetry = FlowSymmetry::none;  // arcs are integrated in all variables
    for (const SplittableMethod& method : all_methods()) {
      IntegrationStatistics statistics;
      ArcStatistics arcs;
      EXPECT_TRUE(
          is_same(split(problem, method, 1, 2, &arcs, &statistics), unsplit(problem, method)))
          << "method " << method.index() << ", order " << order;
      EXPECT_EQ(arcs.compositions, 0);
      EXPECT_EQ(arcs.plan.speed_ups, (std::array<double, 3>{1, 1, 1}));
    }
  }
}

TEST(ArcSplitting, HasTheErrorOfTheUnsplitRun) {
  const auto flow = test::flow_of(test::paper_orbit(), 4);
  const auto problem = test::problem_of(flow);
  const auto whole = unsplit(problem, adaptive(8, 1e-13));
  for (const std::size_t arcs : {2U, 5U, 8U}) {
    const auto jet = split(problem, adaptive(8, 1e-13), arcs);
    for (int d = 0; d <= 4; ++d) {
      const double error = test::relative_error(jet, test::paper_orbit_reference(), d);
      const double unsplit_error = test::relative_error(whole, test::paper_orbit_reference(), d);
      // The rounding differs, and its size is given separately.
      EXPECT_LE(error, 3 * unsplit_error + 2e-13) << "degree " << d << ", arcs " << arcs;
      EXPECT_LE(error, 2e-12) << "degree " << d << ", arcs " << arcs;
    }
  }
}

TEST(ArcSplitting, KeepsItsDigitsOverManyRevolutions) {
  // In the variables themselves the composition of two halves is wrong by 5e-2 at degree 4: terms
  // of the 8th power of the elapsed time cancel to one of the 4th. The unsplit run has an error of
  // 7e-11 there.
  Flow<double> flow = test::flow_of(test::paper_orbit(), 4);
  flow.duration *= 20;
  const auto problem = test::problem_of(flow);
  const auto whole = unsplit(problem, adaptive(8, 1e-13));
  for (const std::size_t arcs : {2U, 8U}) {
    const auto jet = split(problem, adaptive(8, 1e-13), arcs);
    for (int d = 1; d <= 4; ++d) {
      EXPECT_LE(test::relative_error(jet, whole, d), 5e-10) << "degree " << d << ", arcs " << arcs;
    }
  }
}

TEST(ArcSplitting, StaysSymplectic) {
  const auto flow = short_orbit(4, 12);
  const auto problem = test::problem_of(flow);
  for (const SplittableMethod& method :
       {SplittableMethod(adaptive(8, 1e-13)), SplittableMethod(fixed_step(2, 0.4)),
        SplittableMethod(SymmetricCompositionSettings{4, 0.1})}) {
    const auto jet = split(problem, method, 4);
    for (const auto& entry : symplecticity_by_degree(jet)) {
      EXPECT_LE(entry.scaled, 2e-14) << "degree " << entry.degree << ", " << method.index();
    }
  }
}

TEST(ArcSplitting, OfSomeVariablesOnly) {
  // Later arcs vary in all six variables, the jet in two.
  Flow<double> flow = short_orbit(4);
  flow.variables = {1, 3};
  const auto problem = test::problem_of(flow);
  const auto jet = split(problem, adaptive(8, 1e-13), 3, 2);
  ASSERT_EQ(jet[0].space().variables(), 2U);
  EXPECT_LE(worst_difference(jet, unsplit(problem, adaptive(8, 1e-13))), 1e-12);
}

TEST(ArcSplitting, OfOtherSystems) {
  const Flow<double> well{double_well(), {0.9, 0.1}, 8, 6, {}};
  const Flow<double> pair{oscillator_pair(1, 1, 2), {1, 0.5, 0, 0}, 8, 4, {}};
  // At rest the energy cannot be a coordinate.
  const Flow<double> bottom{double_well(), {std::sqrt(0.5), 0}, 3, 4, {}};
  for (const Flow<double>& flow : {well, pair, bottom}) {
    const auto problem = test::problem_of(flow);
    for (const SplittableMethod& method :
         {SplittableMethod(adaptive(8, 1e-13)), SplittableMethod(VelocityVerletSettings{0.01})}) {
      EXPECT_LE(worst_difference(split(problem, method, 3, 2), unsplit(problem, method)), 1e-11)
          << flow.system.name << ", method " << method.index();
    }
  }
}

/// At every degree the error against double-double numbers is at most ten times the unsplit run's
/// own error, or that of rounding alone.
void expect_loses_nothing(const Flow<double>& flow, const std::vector<std::size_t>& numbers) {
  const auto problem = test::problem_of(flow);
  const GaussSettings settings = adaptive(8, 1e-13);
  Flow<Extended> exact_flow{flow.system,
                            {flow.start.begin(), flow.start.end()},
                            Extended(flow.duration),
                            flow.order,
                            flow.variables};
  const auto exact = test::reference_jet(exact_flow, adaptive(16, 1e-18));
  const auto whole = unsplit(problem, settings);
  for (const std::size_t arcs : numbers) {
    ArcStatistics statistics;
    const auto pieces = split(problem, settings, arcs, 2, &statistics);
    EXPECT_EQ(statistics.plan.arcs, arcs);
    for (int d = 0; d <= flow.order; ++d) {
      const double own = std::max(test::relative_error(whole, exact, d), 1e-15);
      EXPECT_LE(test::relative_error(pieces, exact, d), 10 * own)
          << flow.system.name << ", " << arcs << " arcs, degree " << d;
    }
  }
}

TEST(ArcSplitting, DoesNotDependOnTheUnitOfLength) {
  // Kepler's orbit with e = 0.1 in units from 1 km to 1 AU, its own being 9500 km: positions and
  // momenta are of sizes 1e4 and 1e-2 at one end and 1e-4 and 1e2 at the other.
  for (const double length_km : {1.0, 100.0, 9500.0, 1e6, 1.5e8}) {
    const double r = 8550 / length_km;
    const double v = std::sqrt(1.1 / r);
    const Flow<double> flow{
        kepler(), {r, 0, 0, 0, 0.6 * v, 0.8 * v}, 19 * std::pow(9500 / length_km, 1.5), 3, {0, 4}};
    expect_loses_nothing(flow, {2, 4});
  }
}

TEST(ArcSplitting, DoesNotDependOnHowNearToRestOrHowEccentric) {
  // Cases in which the energy is not a coordinate beyond 1e-8: an escape, and a fall from apogee
  // past a perigee of a thousandth.
  expect_loses_nothing({double_well(), {1e-8, 0}, 3, 5, {}}, {3});
  expect_loses_nothing({double_well(), {0.2, 0}, 3, 5, {}}, {3});
  expect_loses_nothing(
      {fermi_pasta_ulam(50, 2), {3e-10, 6e-10, 9e-10, 1.2e-9, 0, 0, 0, 0}, 3, 2, {0, 1, 5}}, {2});
  expect_loses_nothing({kepler(), {1, 0, 0, 0, 1.5648, 0.1}, 37000, 3, {0, 1, 4}}, {4});
  expect_loses_nothing({kepler(), {1, 0, 0, 0, 0.02236, 0.01}, 6.5, 3, {0, 1, 4}}, {3});
}

TEST(ArcSplitting, InExtendedPrecision) {
  Flow<Extended> flow = test::flow_of<Extended>(test::paper_orbit(), 2);
  flow.duration = 2;
  const auto problem = test::problem_of(flow);
  const auto whole = unsplit(problem, adaptive(8, 1e-20));
  EXPECT_LE(worst_difference(split(problem, adaptive(8, 1e-20), 3, 2), whole), 1e-30);
}

TEST(ArcSplitting, GoesOnFromAJet) {
  const auto flow = short_orbit(3);
  auto problem = test::problem_of(flow);
  const FlowJet<double> earlier = unsplit(problem, adaptive());
  problem.initial_state = test::final_state(earlier);
  problem.initial_jet = earlier;
  EXPECT_LE(worst_difference(split(problem, adaptive(), 3, 2), unsplit(problem, adaptive())),
            1e-12);
}

TEST(ArcSplitting, TakesNoMoreArcsThanSteps) {
  const auto flow = short_orbit(2, 1);
  const auto problem = test::problem_of(flow);
  ArcStatistics statistics;
  const auto jet = split(problem, fixed_step(8, 0.3), 9, 2, &statistics);
  EXPECT_EQ(statistics.plan.arcs, 4U);
  EXPECT_NE(statistics.plan.reason.find("more than steps"), std::string::npos);
  EXPECT_LE(worst_difference(jet, unsplit(problem, fixed_step(8, 0.3))), 1e-13);
  Flow<double> none = flow;
  none.duration = 0;
  EXPECT_TRUE(is_same(split(test::problem_of(none), adaptive(), 3, 2),
                      starting_jet(test::problem_of(none))));
}

std::string failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(ArcSplitting, FailsWithTheTextOfTheUnsplitRun) {
  // From rest at r = 1 the body is in the centre at pi / (2 sqrt 2) = 1.1107.
  const Flow<double> fall{kepler(), {1, 0, 0, 0, 0, 0}, 2, 2, {}};
  const auto problem = test::problem_of(fall);
  for (const SplittableMethod& method :
       {SplittableMethod(adaptive()), SplittableMethod(fixed_step(1, 0.1))}) {
    const std::string text = failure_of([&] { unsplit(problem, method); });
    EXPECT_NE(text, "none");
    EXPECT_EQ(failure_of([&] { split(problem, method, 2, 2); }), text);
  }
}

struct Stopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

TEST(ArcSplitting, CarriesWhatIsThrownToTheCaller) {
  const auto flow = short_orbit(3, 30);
  const auto problem = test::problem_of(flow);
  IntegrationStatistics statistics;
  ArcStatistics arcs;
  for (const std::size_t threads : {1U, 3U}) {
    // The interruption is tested in the nominal and in the arcs: 6000 steps take long enough for
    // the callback to be called on the way.
    for (const double at : {0.01, 0.06}) {
      double reached = 0;
      EXPECT_THROW(integrate_in_arcs<double>(problem, VelocityVerletSettings{0.005}, {3, threads},
                                             statistics, arcs, {},
                                             [&](double fraction) {
                                               EXPECT_GE(fraction, reached);
                                               reached = fraction;
                                               if (fraction > at) throw Stopped("stopped");
                                             }),
                   Stopped)
          << threads << " threads, at " << at;
    }
    // A failure in an arc itself: the coefficients of degree 3 overflow, but the nominal does not.
    Flow<double> steep{double_well(), {0, 0}, 1000, 3, {}};
    test::expect_error(ErrorKind::numerical, "not finite", [&] {
      integrate_in_arcs<double>(test::problem_of(steep), adaptive(), {3, threads}, statistics,
                                arcs);
    });
  }
}

TEST(ArcSplitting, RefusesWrongNumbers) {
  const auto flow = short_orbit(1);
  const auto problem = test::problem_of(flow);
  test::expect_error(ErrorKind::usage, "at least one is needed",
                     [&] { split(problem, adaptive(), 0); });
  test::expect_error(ErrorKind::usage, "at least one thread",
                     [&] { split(problem, adaptive(), 2, 0); });
  test::expect_error(ErrorKind::usage, "exactly one of step and tolerance",
                     [&] { split(problem, GaussSettings{}, 2); });
  test::expect_error(ErrorKind::usage, "step must be positive",
                     [&] { split(problem, StormerSettings{0}, 2); });
}

}  // namespace
}  // namespace hamjet
