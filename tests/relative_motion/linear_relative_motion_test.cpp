#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "support/yamanaka_ankersen.hpp"

// Degree 1 of the flow, written in the rotating RTN frame, against the closed forms of linear
// relative motion on Kepler orbits.

namespace hamjet {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The state transition matrix (metres, m/s; R, T, N) of degree 1 from perigee, or from where
/// `start` is.
Matrix6 relative_flow(const std::vector<double>& start, double duration, const MetricUnits& units) {
  const DynamicalSystem system = kepler();
  const FlowProblem<double> problem{system, SeriesSpace::create(6, 1), {0, 1, 2, 3, 4, 5},
                                    start,  ClockTime::epoch(),        duration};
  GaussSettings settings;
  settings.tolerance = 1e-14;
  IntegrationStatistics statistics;
  const FlowJet<double> jet = integrate_gauss<double>(problem, settings, statistics);
  std::vector<double> end;
  for (const auto& component : jet) end.push_back(component[0]);
  const ChiefFrame at_start(start, units, RelativeFrame::rtn_rotating);
  const ChiefFrame at_end(end, units, RelativeFrame::rtn_rotating);
  Matrix6 result;
  for (Eigen::Index j = 0; j < 6; ++j) {
    RelativeState unit;
    (j < 3 ? unit.position_m : unit.velocity_m_s)[j % 3] = 1;
    const std::vector<double> deviation = at_start.deviation(unit);
    std::vector<double> moved(6, 0);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = 0; k < 6; ++k) {
        moved[i] += jet[i][problem.space->linear_index(k)] * deviation[k];
      }
    }
    const RelativeState state = at_end.relative(moved);
    result.col(j) << state.position_m, state.velocity_m_s;
  }
  return result;
}

// Expected: reference values to 15 digits for r = 6677.9933719419 km after 8 h, and the closed form
// (Clohessy and Wiltshire, J. Aerospace Sciences 27 (1960)).
TEST(LinearRelativeMotion, ClohessyWiltshire) {
  const double radius = 6677.9933719419e3;
  const double n = std::sqrt(398600.4415e9 / (radius * radius * radius));
  const double t = 8 * 3600;
  const Matrix6 flow = relative_flow({1, 0, 0, 0, 1, 0}, n * t, {radius, 1 / n});
  EXPECT_NEAR(flow(0, 0), 4.97868541238670, 1e-10);
  EXPECT_NEAR(flow(1, 0), -194.242457498099, 1e-9);
  EXPECT_NEAR(flow(0, 3), 817.081897951423, 1e-7);
  EXPECT_NEAR(flow(0, 4), 2292.70633171889, 1e-7);
  EXPECT_NEAR(flow(1, 4), -83131.6724081943, 1e-6);
  const double s = std::sin(n * t);
  const double c = std::cos(n * t);
  Matrix6 expected;
  expected << 4 - 3 * c, 0, 0, s / n, 2 * (1 - c) / n, 0,                  //
      6 * (s - n * t), 1, 0, 2 * (c - 1) / n, (4 * s - 3 * n * t) / n, 0,  //
      0, 0, c, 0, 0, s / n,                                                //
      3 * n * s, 0, 0, c, 2 * s, 0,                                        //
      6 * n * (c - 1), 0, 0, -2 * s, 4 * c - 3, 0,                         //
      0, 0, -n * s, 0, 0, c;
  // Each entry in its own unit: positions in metres, velocities times 1/n.
  Eigen::Matrix<double, 6, 1> size;
  size << 1, 1, 1, n, n, n;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j) {
      EXPECT_NEAR(flow(i, j) * size[j] / size[i], expected(i, j) * size[j] / size[i], 1e-10)
          << i << ' ' << j;
    }
  }
}

TEST(LinearRelativeMotion, YamanakaAnkersenOnAnEccentricOrbit) {
  // The motion goes from the true anomaly 0.7 through a revolution and more.
  const test::UnitEllipse ellipse(0.4);
  const double start = 0.7;
  for (const double end : {2.0, 4.5, 8.9}) {
    const double duration = ellipse.time_at(end) - ellipse.time_at(start);
    const Matrix6 flow = relative_flow(ellipse.state_at(start), duration, {1, 1});
    const Matrix6 closed_form = ellipse.transition(start, end);
    EXPECT_LT((flow - closed_form).lpNorm<Eigen::Infinity>(),
              1e-11 * closed_form.lpNorm<Eigen::Infinity>())
        << end;
  }
}

}  // namespace
}  // namespace hamjet
