#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hamjet/dynamics/osculating_elements.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "support/flow.hpp"

// The tolerance of a Gauss method is the relative error of every degree of the jet. Expected values
// are jets in double-double numbers with other stages and steps.

namespace hamjet {
namespace {

/// Zonal coefficients of the Earth to degree 20, of the size of EGM96's and with its signs.
ZonalCoefficients earth_zonals(int highest) {
  const ZonalCoefficients all = {{2, 1.0826e-3},  {3, -2.533e-6},  {4, -1.620e-6},  {5, -2.273e-7},
                                 {6, 5.407e-7},   {7, -3.524e-7},  {8, -2.048e-7},  {9, -1.206e-7},
                                 {10, -2.411e-7}, {11, 2.444e-7},  {12, -1.886e-7}, {13, -2.198e-7},
                                 {14, 1.308e-7},  {15, -8.172e-9}, {16, 2.808e-8},  {17, -1.126e-7},
                                 {18, -3.748e-8}, {19, 2.157e-8},  {20, -1.389e-7}};
  ZonalCoefficients result;
  for (int n = 2; n <= highest; ++n) result[n] = all[n];
  return result;
}

struct Orbit {
  double a_km = 0;
  double e = 0;
  double i_deg = 0;
  double ta_deg = 0;
  double revolutions = 0;
};

/// The flow on an orbit in canonical units, expanded in the radius and the transversal velocity,
/// which change the energy.
template <class Real>
test::Flow<Real> flow_on(const Orbit& orbit, int highest_zonal, int order) {
  constexpr double mu = 398600.4415;
  const CartesianState state =
      state_from_elements({orbit.a_km, orbit.e, orbit.i_deg, 20, 40, orbit.ta_deg}, mu);
  double square = 0;
  for (const Extended& x : state.position_km) square += std::pow(static_cast<double>(x), 2);
  const double length = std::sqrt(square);
  const double speed = std::sqrt(mu / length);
  test::Flow<Real> flow{
      zonal_gravity({1, 6378.1363 / length, earth_zonals(highest_zonal)}),
      {},
      Real(2 * std::numbers::pi * orbit.revolutions * std::pow(orbit.a_km / length, 1.5)),
      order,
      {0, 4}};
  for (const Extended& x : state.position_km) {
    flow.start.emplace_back(static_cast<double>(x) / length);
  }
  for (const Extended& v : state.velocity_km_s) {
    flow.start.emplace_back(static_cast<double>(v) / speed);
  }
  return flow;
}

/// What a tolerance promises: at most 100 tolerances a revolution at every degree, and ten floors.
/// A floor is the largest error of jets by other numbers of stages, whose truncation is promised to
/// be as small, so that what they have in common with this one is rounding; in double-double
/// numbers there is next to none, and the promise holds alone.
void expect_errors_within(const Orbit& orbit, int highest_zonal, int order,
                          const GaussSettings& settings, bool is_rounding_sampled = false) {
  const auto extended = flow_on<Extended>(orbit, highest_zonal, order);
  const auto flow = flow_on<double>(orbit, highest_zonal, order);
  const auto exact =
      test::reference_jet(extended, test::adaptive(settings.stages == 14 ? 16 : 14, 1e-17));
  std::vector<FlowJet<double>> others;
  for (const int stages : {5, 6, 7, 9, 10, 11, 12, 13}) {
    if (!is_rounding_sampled) break;
    others.push_back(test::run_gauss(flow, test::adaptive(stages, *settings.tolerance)));
  }
  const auto jet = test::run_gauss(flow, settings);
  const auto unrounded =
      is_rounding_sampled ? test::reference_jet(extended, settings) : FlowJet<Extended>{};
  const double promised = 100 * *settings.tolerance * std::max(1.0, orbit.revolutions);
  for (int d = 0; d <= order; ++d) {
    double floor = 0;
    for (const auto& other : others) floor = std::max(floor, test::relative_error(other, exact, d));
    EXPECT_LE(test::relative_error(jet, exact, d), promised + 10 * floor)
        << "e = " << orbit.e << ", degree " << d << ", tolerance " << *settings.tolerance;
    if (is_rounding_sampled) {
      EXPECT_LE(test::relative_error(unrounded, exact, d), promised)
          << "e = " << orbit.e << ", degree " << d << ", double-double";
    }
  }
}

TEST(GaussTolerance, HoldsAtEveryDegreeOnEccentricOrbits) {
  // From perigee to apogee, where the coefficients of degree d are smaller than on the way by the
  // 1.5 d-th power of the ratio of the radii: steps chosen on the nominal alone miss degree 4 by
  // 1e-4 at e = 0.9.
  expect_errors_within({70000, 0.9, 63, 0, 1.5}, 3, 4, test::adaptive(8, 1e-9), true);
  expect_errors_within({70000, 0.9, 63, 0, 1.5}, 3, 4, test::adaptive(8, 1e-13), true);
  expect_errors_within({26600, 0.74, 63, 0, 1.5}, 3, 4, test::adaptive(8, 1e-13), true);
}

TEST(GaussTolerance, IsOfRoundingOnlyWhereRoundingLimits) {
  IntegrationStatistics mild;
  test::run_gauss(flow_on<double>({10000, 0.3, 60, 0, 2}, 3, 4), test::adaptive(8, 1e-12), &mild);
  EXPECT_TRUE(mild.rounding_by_degree.empty());
  EXPECT_EQ(mild.step_tolerance, 1e-12);
  // On a circular orbit the largest entry of the gravity gradient, 3 cos^2 - 1 or 3 sin cos of the
  // direction times the squared mean motion, lies between 1.4 and 2.
  IntegrationStatistics circular;
  test::run_gauss(flow_on<double>({10000, 0, 60, 0, 2}, 0, 2), test::adaptive(8, 1e-12), &circular);
  EXPECT_GT(circular.periods, 2 * std::sqrt(1.4));
  EXPECT_LT(circular.periods, 2 * std::sqrt(2.0));
  IntegrationStatistics hard;
  test::run_gauss(flow_on<double>({70000, 0.9, 63, 0, 1.5}, 3, 4), test::adaptive(8, 1e-13), &hard);
  ASSERT_EQ(hard.rounding_by_degree.size(), 5U);
  EXPECT_LT(*hard.step_tolerance, 1e-13);
  EXPECT_LT(hard.rounding_by_degree[1], 1e-10);
  EXPECT_GT(hard.rounding_by_degree[4], 1e-12);
}

TEST(GaussTolerance, TakesNoErrorOfCoarseStepsForRounding) {
  // With three stages and a hundredth as the tolerance the first steps leave degree 4 no digit, and
  // shorter ones little more: not because of rounding, which leaves two digits here (with eight
  // stages and a tolerance of 1e-13 the error is 2e-3).
  const auto flow = flow_on<double>({140000, 0.95, 63, 90, 2.5}, 0, 4);
  IntegrationStatistics coarse;
  const auto jet = test::run_gauss(flow, test::adaptive(3, 1e-2), &coarse);
  for (const double error : coarse.rounding_by_degree) EXPECT_LE(error, 1e-2);
  const auto extended = flow_on<Extended>({140000, 0.95, 63, 90, 2.5}, 0, 4);
  const auto exact = test::reference_jet(extended, test::adaptive(14, 1e-17));
  for (int d = 0; d <= 4; ++d) EXPECT_LE(test::relative_error(jet, exact, d), 100 * 1e-2 * 2.5);
}

TEST(GaussTolerance, HoldsInAFieldOfShortWaves) {
  // The zonals of degree 10 and above are a millionth of the field and have waves shorter than a
  // step that suits the rest: the position was wrong by 1e-7 at a tolerance of 1e-11.
  for (const int stages : {6, 8, 12}) {
    for (const int order : {0, 2}) {
      expect_errors_within({6800, 0.001, 90, 0, 1.5}, 20, order, test::adaptive(stages, 1e-11));
    }
  }
}

TEST(GaussTolerance, HoldsWhereStepsGrowFourfold) {
  // Away from a perigee each step is four times the last, and its slopes are extrapolated from
  // there by a polynomial of degree 15: a guess beyond all bounds, whose size must not count as
  // that of the stages (three steps, a position wrong by 1e-3).
  for (const int stages : {8, 12, 14, 16}) {
    for (const double tolerance : {1e-8, 1e-11}) {
      expect_errors_within({70000, 0.957, 51, 82.8, 0.104}, 2, 2,
                           test::adaptive(stages, tolerance));
    }
  }
}

TEST(GaussTolerance, NeverUndersamplesTheShortestWave) {
  // Pi stages a wave, where Legendre expansions begin to converge: 20 waves a revolution, 8 stages,
  // so at least 7.9 steps, however loose the tolerance.
  auto flow = flow_on<double>({6800, 0, 90, 0, 1}, 20, 0);
  IntegrationStatistics statistics;
  test::run_gauss(flow, test::adaptive(8, 0.5), &statistics);
  EXPECT_GE(statistics.steps, 8);
  flow.system = zonal_gravity({1, 6378.1363 / 6800, earth_zonals(3)});
  test::run_gauss(flow, test::adaptive(8, 0.5), &statistics);
  EXPECT_LT(statistics.steps, 5);
}

}  // namespace
}  // namespace hamjet
