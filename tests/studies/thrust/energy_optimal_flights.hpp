#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "../formation_scenes.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/transfer.hpp"

// Kepler's problem under the thrust of least energy, written by hand for the tests, in long double.

namespace hamjet::thrusted {

using Numbers = std::array<long double, 13>;  ///< q, v, their costates, and the energy so far

/// The paper's orbit and a deputy that comes from `separation_m` to rest beside the chief.
inline Scene thrust_scene(double separation_m, std::vector<double> times) {
  Scene scene = kepler_chief(0.3, 7000, std::sqrt(7000.0 * 7000 * 7000 / 398600.4405), 2);
  scene.nominal = {1, 0, 0, 0, 0.57, 0.98};
  TransferSettings settings;
  settings.start.position_m = Eigen::Vector3d(0.6, -0.7, 0.4).normalized() * separation_m;
  settings.start.velocity_m_s = Eigen::Vector3d(0.2, 0.1, -0.3) * (separation_m / 1000);
  settings.end.position_m = {0, 50, 0};
  settings.times = std::move(times);
  settings.thrust = TransferThrust::energy_optimal;
  settings.refined_miss_m = 1e-4;
  scene.transfer = settings;
  return scene;
}

inline MetricUnits units_of(const Scene& scene) {
  return {scene.units.length_km * 1000, scene.units.time_s};
}

/// What a canonical integral of |u|^2 is in m^2/s^3.
inline double energy_unit(const Scene& scene) {
  const MetricUnits units = units_of(scene);
  return units.velocity_m_s() * units.velocity_m_s() / units.time_s;
}

/// With g = -q/r^3, q'' = g + u, u = -lambda_v, lambda_q' = -(dg/dq) lambda_v, lambda_v' =
/// -lambda_q, where (dg/dq) a = -a/r^3 + 3 q (q.a)/r^5.
inline Numbers derivative(const Numbers& z) {
  Numbers d{};
  const long double r2 = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
  const long double r3 = r2 * std::sqrt(r2);
  const long double along = z[0] * z[9] + z[1] * z[10] + z[2] * z[11];
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = z[3 + i];
    d[3 + i] = -z[i] / r3 - z[9 + i];
    d[6 + i] = z[9 + i] / r3 - 3 * z[i] * along / (r2 * r3);
    d[9 + i] = -z[6 + i];
    d[12] += z[9 + i] * z[9 + i] / 2;
  }
  return d;
}

/// Flies by Fehlberg's method of order 8, which the study does not use, with steps for 1e-16. A
/// flight that would take more than any that is asked for ends in no number.
template <class State, class Rate>
void fly(const Rate& rate, State& z, long double time) {
  namespace odeint = boost::numeric::odeint;
  auto stepper =
      odeint::make_controlled(1e-16L, 1e-16L, odeint::runge_kutta_fehlberg78<State, long double>());
  long double now = 0;
  long double step = 0.01L;
  for (int trials = 0; now < time; ++trials) {
    if (trials > 20000) {
      z.fill(std::numeric_limits<long double>::quiet_NaN());
      return;
    }
    step = std::min(step, time - now);
    stepper.try_step(rate, z, now, step);
  }
}

inline Numbers flown(Numbers z, long double time) {
  fly([](const Numbers& x, Numbers& d, long double) { d = derivative(x); }, z, time);
  return z;
}

inline Numbers start_of(const Scene& scene, const RelativeState& relative,
                        const std::vector<double>& costates) {
  const std::vector<double> deviation =
      ChiefFrame(scene.nominal, units_of(scene), scene.transfer->frame).deviation(relative);
  Numbers z{};
  for (std::size_t i = 0; i < 6; ++i) {
    z[i] = static_cast<long double>(scene.nominal[i]) + deviation[i];
    z[6 + i] = costates[i];
  }
  return z;
}

inline std::vector<double> state_of(const Numbers& z) {
  std::vector<double> state;
  for (std::size_t i = 0; i < 6; ++i) state.push_back(static_cast<double>(z[i]));
  return state;
}

/// The state to which the scene's end wants the deputy at a time.
inline Numbers wanted_end(const Scene& scene, double time) {
  Numbers end = flown(start_of(scene, RelativeState(), std::vector<double>(6)), time);
  const std::vector<double> deviation =
      scene.transfer->end.deviation(state_of(end), units_of(scene), scene.transfer->frame);
  for (std::size_t i = 0; i < 6; ++i) end[i] += deviation[i];
  return end;
}

}  // namespace hamjet::thrusted
