#include "hamjet/charts/charted_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "orbits.hpp"

namespace hamjet {
namespace {

using test::bound_orbits;
using test::ChiefOrbit;

FlowMap<double> jet_of(const ChiefOrbit& orbit, double time, int order) {
  FlowProblem<double> problem{zonal_gravity(orbit.field), SeriesSpace::create(6, order),
                              {0, 1, 2, 3, 4, 5},         {orbit.start.begin(), orbit.start.end()},
                              ClockTime::epoch(),         time};
  GaussSettings settings;
  settings.tolerance = 1e-13;
  IntegrationStatistics statistics;
  return FlowMap<double>(integrate_gauss<double>(problem, settings, statistics));
}

SixNumbers<double> end_of(const FlowMap<double>& jet) {
  SixNumbers<double> end;
  for (std::size_t i = 0; i < 6; ++i) end[i] = jet.jet()[i][0];
  return end;
}

/// The largest coefficient of a degree over all components.
double largest(const FlowMap<double>& jet, int degree) {
  double size = 0;
  for (const auto& component : jet.jet()) {
    for (const double c : component.slice(degree)) size = std::max(size, std::abs(c));
  }
  return size;
}

// A map into the charts and out again is the identity, and a canonical chart keeps a jet
// symplectic. Both hold to rounding, which the compositions amplify as the coefficients grow with
// the degree.
TEST(ChartedMap, IsInvertibleAndKeepsTheJetSymplectic) {
  for (const ChiefOrbit& orbit : {bound_orbits()[0], bound_orbits()[1], bound_orbits()[4]}) {
    const FlowMap<double> jet = jet_of(orbit, 0.6 * orbit.period, 3);
    for (const ChartName name : all_charts) {
      SCOPED_TRACE(name_of(name));
      try {
        CanonicalChart<double>(name, end_of(jet), 1.0);
        CanonicalChart<double>(name, orbit.start, 1.0);
      } catch (const Error&) {
        continue;
      }
      const CanonicalChart<double> start(name, orbit.start, 1.0);
      const CanonicalChart<double> end(name, end_of(jet), 1.0);
      const FlowMap<double> charted = in_charts(jet, start, orbit.start, end);
      for (const SymplecticityDefect& defect : charted.symplecticity()) {
        EXPECT_LT(defect.scaled, 1e-9) << defect.degree;
      }
      const FlowMap<double> back = out_of_charts(charted, start, orbit.start, end);
      for (int degree = 0; degree <= 3; ++degree) {
        double miss = 0;
        for (std::size_t i = 0; i < 6; ++i) {
          for (std::size_t k = jet.space()->first(degree); k < jet.space()->first(degree + 1);
               ++k) {
            miss = std::max(miss, std::abs(back.jet()[i][k] - jet.jet()[i][k]));
          }
        }
        EXPECT_LT(miss, 1e-8 * largest(jet, degree)) << degree;
      }
    }
  }
}

// Near the chief all coordinates give the same prediction; the difference comes from their missing
// degrees.
TEST(ChartedMap, PredictsWhatTheJetDoesNearTheChief) {
  const ChiefOrbit orbit = test::orbit_of(10000, 0.3, 60, 20, 40, 10);
  const FlowMap<double> jet = jet_of(orbit, 0.6 * orbit.period, 3);
  const auto plain = cartesian_deputy_flow(jet);
  std::mt19937_64 generator(1);
  for (const ChartName name : all_charts) {
    const CanonicalChart<double> start(name, orbit.start, 1.0);
    const CanonicalChart<double> end(name, end_of(jet), 1.0);
    const auto flow = charted_deputy_flow(start, orbit.start, end, end_of(jet),
                                          in_charts(jet, start, orbit.start, end));
    for (int k = 0; k < 5; ++k) {
      const auto deviation = test::random_deviation(generator, 1e-5);
      const auto a = plain->predict(deviation, 3);
      const auto b = flow->predict(deviation, 3);
      for (std::size_t i = 0; i < 6; ++i) {
        // The bound covers fourth powers of 1e-5 times coefficients of some 1e5, and the rounding
        // of whole states.
        EXPECT_NEAR(b.deviation[i], a.deviation[i], 3e-14) << name_of(name);
      }
    }
    const Matrix<double> linear =
        flow->exit_derivative() * linear_part(flow->polynomials()) * flow->entry_derivative();
    EXPECT_LT((linear - jet.linear_part()).cwiseAbs().maxCoeff(), 1e-11) << name_of(name);
  }
}

TEST(ChartedMap, RefusesMapsOfOtherSizes) {
  const ChiefOrbit orbit = bound_orbits()[1];
  const CanonicalChart<double> chart(ChartName::spherical, orbit.start, 1.0);
  const FlowMap<double> small({Series<double>(SeriesSpace::create(2, 2))});
  EXPECT_THROW(in_charts(small, chart, orbit.start, chart), Error);
  EXPECT_THROW(out_of_charts(small, chart, orbit.start, chart), Error);
  EXPECT_THROW(cartesian_deputy_flow(small), Error);
}

}  // namespace
}  // namespace hamjet
