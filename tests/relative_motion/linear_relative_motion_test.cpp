#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

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

/// Solutions of Tschauner and Hempel's equations at a true anomaly, as columns: in the plane
/// (x, z, x', z') with x along the motion and z to the centre, in the variables scaled by
/// rho = 1 + e cos, derivatives by the anomaly; J is the integral of the time. Source: Yamanaka and
/// Ankersen, J. Guidance, Control, and Dynamics 25 (2002), eq. 82.
Eigen::Matrix4d in_plane_solutions(double e, double anomaly, double J) {
  const double rho = 1 + e * std::cos(anomaly);
  const double s = rho * std::sin(anomaly);
  const double c = rho * std::cos(anomaly);
  const double ds = std::cos(anomaly) + e * std::cos(2 * anomaly);
  const double dc = -(std::sin(anomaly) + e * std::sin(2 * anomaly));
  Eigen::Matrix4d phi;
  phi << 1, -c * (1 + 1 / rho), s * (1 + 1 / rho), 3 * rho * rho * J,  //
      0, s, c, 2 - 3 * e * s * J,                                      //
      0, 2 * s, 2 * c - e, 3 * (1 - 2 * e * s * J),                    //
      0, ds, dc, -3 * e * (ds * J + s / (rho * rho));
  return phi;
}

TEST(LinearRelativeMotion, YamanakaAnkersenOnAnEccentricOrbit) {
  // mu = 1, perigee at 1; from the true anomaly 0.7 through a revolution and more.
  const double e = 0.4;
  const double p = 1 + e;
  const double h = std::sqrt(p);
  const double start_anomaly = 0.7;
  const auto state_at = [&](double anomaly) {
    const double r = p / (1 + e * std::cos(anomaly));
    return std::vector<double>{r * std::cos(anomaly),  r * std::sin(anomaly),       0,
                               -std::sin(anomaly) / h, (e + std::cos(anomaly)) / h, 0};
  };
  const auto time_at = [&](double anomaly) {  // Kepler's equation
    const double a = p / (1 - e * e);
    const double turns = std::floor((anomaly + M_PI) / (2 * M_PI));
    const double rest = anomaly - 2 * M_PI * turns;
    const double E = 2 * std::atan(std::sqrt((1 - e) / (1 + e)) * std::tan(rest / 2));
    return std::pow(a, 1.5) * (E - e * std::sin(E) + 2 * M_PI * turns);
  };
  for (const double end_anomaly : {2.0, 4.5, 8.9}) {
    const double duration = time_at(end_anomaly) - time_at(start_anomaly);
    const Matrix6 flow = relative_flow(state_at(start_anomaly), duration, {1, 1});
    const double k2 = h / (p * p);  // the anomaly's rate is k^2 rho^2
    /// (x, z, x', z') scaled, from the unscaled (x, z, dx/dt, dz/dt).
    const auto scaling = [&](double anomaly) {
      const double rho = 1 + e * std::cos(anomaly);
      Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
      m.topLeftCorner<2, 2>() = rho * Eigen::Matrix2d::Identity();
      m.bottomLeftCorner<2, 2>() = -e * std::sin(anomaly) * Eigen::Matrix2d::Identity();
      m.bottomRightCorner<2, 2>() = 1 / (k2 * rho) * Eigen::Matrix2d::Identity();
      return m;
    };
    const Eigen::Matrix4d plane =
        scaling(end_anomaly).inverse() * in_plane_solutions(e, end_anomaly, k2 * duration) *
        in_plane_solutions(e, start_anomaly, 0).inverse() * scaling(start_anomaly);
    // x = T, z = -R.
    const std::vector<std::pair<Eigen::Index, double>> ours = {{1, 1}, {0, -1}, {4, 1}, {3, -1}};
    for (Eigen::Index i = 0; i < 4; ++i) {
      for (Eigen::Index j = 0; j < 4; ++j) {
        const auto [row, row_sign] = ours[static_cast<std::size_t>(i)];
        const auto [column, column_sign] = ours[static_cast<std::size_t>(j)];
        EXPECT_NEAR(flow(row, column) * row_sign * column_sign, plane(i, j),
                    1e-11 * plane.lpNorm<Eigen::Infinity>())
            << end_anomaly << ' ' << i << ' ' << j;
      }
    }
    // Across the plane a harmonic oscillation in the anomaly, scaled alike.
    const auto scaled = [&](double anomaly) {
      const double rho = 1 + e * std::cos(anomaly);
      Eigen::Matrix2d m;
      m << rho, 0, -e * std::sin(anomaly), 1 / (k2 * rho);
      return m;
    };
    const double angle = end_anomaly - start_anomaly;
    Eigen::Matrix2d turn;
    turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    const Eigen::Matrix2d across = scaled(end_anomaly).inverse() * turn * scaled(start_anomaly);
    EXPECT_NEAR(flow(2, 2), across(0, 0), 1e-11);
    EXPECT_NEAR(flow(2, 5), across(0, 1), 1e-11);
    EXPECT_NEAR(flow(5, 2), across(1, 0), 1e-11);
    EXPECT_NEAR(flow(5, 5), across(1, 1), 1e-11);
  }
}

}  // namespace
}  // namespace hamjet
