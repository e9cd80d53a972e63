#include "hamjet/relative_motion/chief_frame.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

const MetricUnits metric_units{7e6, 927.5};
const std::vector<double> eccentric = {0.9, 0.3, -0.2, -0.3, 0.8, 0.6};

TEST(ChiefFrame, RtnOnACircularEquatorialOrbitIsPositionVelocityAndPole) {
  // At the x axis, moving along y with unit speed: R = x, T = y, N = z, omega = 1.
  const std::vector<double> chief = {1, 0, 0, 0, 1, 0};
  RelativeState state;
  state.position_m = {7000, 14000, 21000};
  state.velocity_m_s = {1, 2, 3};
  const double unit = metric_units.velocity_m_s();
  const ChiefFrame rotating(chief, metric_units, RelativeFrame::rtn_rotating);
  const std::vector<double> deviation = rotating.deviation(state);
  // v = rho' + N x rho: N x (1, 2, 3) = (-2, 1, 0).
  const std::vector<double> expected = {1e-3,    2e-3, 3e-3, 1 / unit - 2e-3, 2 / unit + 1e-3,
                                        3 / unit};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(deviation[i], expected[i], 1e-18) << i;
  const ChiefFrame inertial(chief, metric_units, RelativeFrame::rtn_inertial);
  EXPECT_NEAR(inertial.deviation(state)[3], 1 / unit, 1e-18);
}

TEST(ChiefFrame, ConvertsThereAndBack) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1e4, 1e4);
  for (const RelativeFrame frame :
       {RelativeFrame::rtn_rotating, RelativeFrame::rtn_inertial, RelativeFrame::inertial}) {
    const ChiefFrame chief(eccentric, metric_units, frame);
    RelativeState state;
    for (int i = 0; i < 3; ++i) {
      state.position_m[i] = uniform(generator);
      state.velocity_m_s[i] = uniform(generator) / 1000;
    }
    const RelativeState back = chief.relative(chief.deviation(state));
    EXPECT_LT((back.position_m - state.position_m).norm(), 1e-11);
    EXPECT_LT((back.velocity_m_s - state.velocity_m_s).norm(), 1e-13);
  }
}

TEST(ChiefFrame, RotatingDerivativeIsThatOfTheRotatingComponents) {
  // Differences of the components along the axes of a chief on Kepler's orbit over a short time:
  // both move freely, the error of the central difference goes as the time squared.
  const double dt = 1e-4;
  const auto moved = [](const std::vector<double>& z, double t) {
    // Taylor's series to t^3 of Kepler's problem with mu = 1: q'' = -q/r^3 and its derivative.
    const Eigen::Vector3d q(z[0], z[1], z[2]);
    const Eigen::Vector3d v(z[3], z[4], z[5]);
    const double r = q.norm();
    const Eigen::Vector3d a = -q / (r * r * r);
    const Eigen::Vector3d jerk = -v / (r * r * r) + 3 * q.dot(v) / std::pow(r, 5) * q;
    const Eigen::Vector3d qt = q + v * t + a * (t * t / 2) + jerk * (t * t * t / 6);
    const Eigen::Vector3d vt = v + a * t + jerk * (t * t / 2);
    return std::vector<double>{qt[0], qt[1], qt[2], vt[0], vt[1], vt[2]};
  };
  const MetricUnits unit{1, 1};
  RelativeState state;
  state.position_m = {1e-3, -2e-3, 3e-3};
  state.velocity_m_s = {2e-3, 1e-3, -1e-3};
  std::vector<double> deputy = eccentric;
  const auto deviation = ChiefFrame(eccentric, unit, RelativeFrame::rtn_rotating).deviation(state);
  for (std::size_t i = 0; i < 6; ++i) deputy[i] += deviation[i];
  const auto position_at = [&](double t) {
    const auto chief = moved(eccentric, t);
    const auto other = moved(deputy, t);
    std::vector<double> difference;
    for (std::size_t i = 0; i < 6; ++i) difference.push_back(other[i] - chief[i]);
    return ChiefFrame(chief, unit, RelativeFrame::rtn_rotating).relative(difference).position_m;
  };
  const Eigen::Vector3d rate = (position_at(dt) - position_at(-dt)) / (2 * dt);
  EXPECT_LT((rate - state.velocity_m_s).norm(), 1e-9);
}

TEST(ChiefFrame, NeedsAnOrbitalPlane) {
  const std::vector<double> fall = {1, 2, 3, -0.1, -0.2, -0.3};
  for (const RelativeFrame frame : {RelativeFrame::rtn_rotating, RelativeFrame::rtn_inertial}) {
    EXPECT_THROW(ChiefFrame(fall, metric_units, frame), Error);
  }
  EXPECT_NO_THROW(ChiefFrame(fall, metric_units, RelativeFrame::inertial));
  EXPECT_THROW(ChiefFrame(std::vector<double>{1, 2}, metric_units, RelativeFrame::inertial), Error);
}

}  // namespace
}  // namespace hamjet
