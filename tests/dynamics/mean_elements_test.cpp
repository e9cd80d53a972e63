#include "hamjet/dynamics/mean_elements.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "hamjet/error.hpp"

// Mean elements are compared with averages of osculating elements along numerical orbits, with a
// closed form on circular orbits, and with each other. The integrator and the force of the orbits
// share nothing with the code under test. The terms that mean elements leave out are of second
// order in J2.

namespace hamjet {
namespace mean_elements_test {

constexpr double mu = 398600.4418, radius = 6378.137, pi = std::numbers::pi, degree = pi / 180;

using State = std::array<double, 6>;

OblateBody earth(double J2 = 1.08262668e-3) { return {mu, radius, J2}; }

CartesianState cartesian(const State& x) { return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}}; }

State numbers(const CartesianState& state) {
  State x;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = convert<double>(state.position_km[i]);
    x[3 + i] = convert<double>(state.velocity_km_s[i]);
  }
  return x;
}

/// Elements that are also defined on circles: a, e cos w, e sin w, i, node, w + M.
std::array<double, 6> elements_of(const State& x) {
  const double r = std::hypot(x[0], x[1], x[2]);
  const double v2 = x[3] * x[3] + x[4] * x[4] + x[5] * x[5];
  const double h[] = {x[1] * x[5] - x[2] * x[4], x[2] * x[3] - x[0] * x[5],
                      x[0] * x[4] - x[1] * x[3]};
  const double size = std::hypot(h[0], h[1], h[2]);
  const double a = 1 / (2 / r - v2 / mu);
  const double node = std::atan2(h[0], -h[1]);
  const double i = std::acos(h[2] / size);
  const double along[] = {std::cos(node), std::sin(node), 0};
  const double across[] = {-std::cos(i) * std::sin(node), std::cos(i) * std::cos(node),
                           std::sin(i)};
  const double radial_rate = (x[0] * x[3] + x[1] * x[4] + x[2] * x[5]);
  double ex = 0, ey = 0, rx = 0, ry = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double e = (v2 / mu - 1 / r) * x[k] - radial_rate / mu * x[3 + k];
    ex += e * along[k];
    ey += e * across[k];
    rx += x[k] * along[k];
    ry += x[k] * across[k];
  }
  const double e = std::hypot(ex, ey), w = std::atan2(ey, ex), u = std::atan2(ry, rx);
  const double E = 2 * std::atan2(std::sqrt(1 - e) * std::sin((u - w) / 2),
                                  std::sqrt(1 + e) * std::cos((u - w) / 2));
  return {a, ex, ey, i, node, w + E - e * std::sin(E)};
}

/// The acceleration by a point mass and J2, in Cartesian form.
void accelerate(const State& x, State& rate, double J2) {
  const double r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2], r = std::sqrt(r2);
  const double k = 1.5 * J2 * mu * radius * radius / (r2 * r2 * r);
  const double z2 = 5 * x[2] * x[2] / r2;
  const double factors[] = {z2 - 1, z2 - 1, z2 - 3};
  for (std::size_t i = 0; i < 3; ++i) {
    rate[i] = x[3 + i];
    rate[3 + i] = (-mu / (r2 * r) + k * factors[i]) * x[i];
  }
}

/// States at equal time steps over one osculating revolution, without the end.
std::vector<State> revolution(const State& start, int count, double J2) {
  namespace odeint = boost::numeric::odeint;
  const double a = elements_of(start)[0];
  const double step = 2 * pi * std::sqrt(a * a * a / mu) / count;
  std::vector<State> states = {start};
  State x = start;
  for (int k = 1; k < count; ++k) {
    odeint::integrate_adaptive(
        odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(1e-12, 1e-13),
        [J2](const State& at, State& rate, double) { accelerate(at, rate, J2); }, x, 0.0, step,
        step / 4);
    states.push_back(x);
  }
  return states;
}

State start_of(double a, double e, double i, double node, double w, double f) {
  return numbers(state_from_elements({a, e, i, node, w, f}, mu));
}

struct Orbit {
  const char* name;
  State start;
};

std::vector<Orbit> orbits() {
  return {{"sun-synchronous", start_of(7078, 0.001, 98.2, 30, 90, 10)},
          {"circle", start_of(7200, 0, 51.6, 10, 0, 70)},
          {"nearly equatorial", start_of(7500, 0.02, 0.01, 200, 40, 130)},
          {"eccentric", start_of(24400, 0.73, 7, 200, 178, 45)},
          {"critical", start_of(26600, 0.74, 63.4349, 227, 281.5, 123)},
          {"retrograde", start_of(9000, 0.2, 140, -60, 250, 300)}};
}

/// The size of the first-order effect of J2 on angles, which goes with the square of the parameter,
/// and on the semi-major axis, which goes with the energy at perigee.
struct FirstOrder {
  double angles = 0;
  double axis = 0;
};

FirstOrder first_order(const State& start, double J2) {
  const auto x = elements_of(start);
  const double e = std::hypot(x[1], x[2]), p = x[0] * (1 - e * e), perigee = x[0] * (1 - e);
  const double k = 1.5 * J2 * radius * radius;
  return {k / (p * p), k * x[0] / (perigee * perigee * perigee)};
}

/// The largest allowed ratio of second-order terms to the product of two first-order sizes: the
/// terms of Brouwer's second order have coefficients up to 10.
constexpr double most_times = 10;

TEST(MeanElements, BothWaysAreInverseToRounding) {
  for (const Orbit& orbit : orbits()) {
    const CartesianState start = cartesian(orbit.start);
    const CartesianState back = osculating_of_mean(mean_of_osculating(start, earth()), earth());
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(abs(back.position_km[i] - start.position_km[i]), 1e-26) << orbit.name;
      EXPECT_LE(abs(back.velocity_km_s[i] - start.velocity_km_s[i]), 1e-29) << orbit.name;
    }
  }
}

// Along a revolution the mean a, e, i, node and w are constant except for second-order terms and
// the secular motion of node and perigee, while the osculating elements vary by first-order terms.
TEST(MeanElements, StayAlongARevolution) {
  for (const Orbit& orbit : orbits()) {
    const double J2 = earth().J2;
    const FirstOrder first = first_order(orbit.start, J2);
    std::vector<std::array<double, 6>> mean, osculating;
    for (const State& x : revolution(orbit.start, 64, J2)) {
      osculating.push_back(elements_of(x));
      mean.push_back(elements_of(numbers(mean_of_osculating(cartesian(x), earth()))));
    }
    const auto swing = [](const auto& list, std::size_t k) {
      const auto [least, most] = std::minmax_element(
          list.begin(), list.end(), [k](const auto& a, const auto& b) { return a[k] < b[k]; });
      return (*most)[k] - (*least)[k];
    };
    const double a = osculating[0][0];
    EXPECT_LE(swing(mean, 0) / a, most_times * first.angles * first.axis) << orbit.name;
    EXPECT_LE(swing(mean, 3), most_times * first.angles * first.angles) << orbit.name;
    EXPECT_GT(swing(osculating, 0) / a, 100 * swing(mean, 0) / a) << orbit.name;
  }
}

// The average of osculating elements over a revolution is what Kozai calls mean; Brouwer's differ
// by averages of the periodic terms, which vanish with e, and in a by nothing: a is averaged here,
// and on orbits that are nearly circular e cos w, e sin w and the inclination.
TEST(MeanElements, AreAveragesOfTheOsculatingOnes) {
  for (const Orbit& orbit : orbits()) {
    const double J2 = earth().J2;
    const auto start = elements_of(orbit.start);
    const double e = std::hypot(start[1], start[2]);
    const FirstOrder first = first_order(orbit.start, J2);
    std::array<double, 6> average{};
    const std::vector<State> states = revolution(orbit.start, 512, J2);
    for (const State& x : states) {
      const auto elements = elements_of(x);
      for (std::size_t k = 0; k < 6; ++k) {
        average[k] += elements[k] / static_cast<double>(states.size());
      }
    }
    const auto mean = elements_of(numbers(mean_of_osculating(cartesian(orbit.start), earth())));
    EXPECT_LE(std::abs(average[0] - mean[0]) / mean[0], most_times * first.angles * first.axis)
        << orbit.name;
    if (e > 0.005) continue;
    const double with_e = most_times * first.angles * (first.angles + e);
    EXPECT_NEAR(average[3], mean[3], with_e) << orbit.name;
    EXPECT_NEAR(average[1], mean[1], with_e) << orbit.name;
    EXPECT_NEAR(average[2], mean[2], with_e) << orbit.name;
  }
}

// The remaining terms are of second order: with half of J2 the mean semi-major axis varies along a
// revolution by a quarter as much.
TEST(MeanElements, LeaveOutSecondOrder) {
  for (const Orbit& orbit : orbits()) {
    const auto swing = [&](double J2) {
      double least = 1e9, most = 0;
      for (const State& x : revolution(orbit.start, 64, J2)) {
        const double a = elements_of(numbers(mean_of_osculating(cartesian(x), earth(J2))))[0];
        least = std::min(least, a);
        most = std::max(most, a);
      }
      return most - least;
    };
    EXPECT_NEAR(swing(4e-3) / swing(2e-3), 4, 0.6) << orbit.name;
  }
}

// While the perigee turns by a quarter of a revolution, so that cos 2w goes from 1 to -1, the
// average eccentricity of each revolution swings by twice
//
//   gamma_2' e eta^2 / 8 (1 - 11 c^2 - 40 c^4 / (1 - 5 c^2))             (Brouwer 1959, p. 395)
//   - 3 gamma_2' eta^2 s^2 / e (b^2 (1 + 2 eta) - e^2 - e b^3 (1 + 3 eta) / 3) / 2 ,
//
// the second the average of the terms of short period, with that of cos j f, (-b)^j (1 + j eta), b
// = e / (1 + eta). The mean eccentricity stays.
TEST(MeanElements, AreWithoutTheTermsOfThePerigeesPeriod) {
  constexpr double J2 = 1.08262668e-3, e = 0.3, a = 10000, i = 55;
  const double eta2 = 1 - e * e, c2 = std::pow(std::cos(i * degree), 2);
  const double gamma = J2 * radius * radius / (2 * a * a * eta2 * eta2);
  const double eta = std::sqrt(eta2), b = e / (1 + eta);
  const double long_period = e / 8 * (1 - 11 * c2 - 40 * c2 * c2 / (1 - 5 * c2));
  const double short_period =
      -1.5 * (1 - c2) / e * (b * b * (1 + 2 * eta) - e * e - e * b * b * b * (1 + 3 * eta) / 3);
  const double swing = 2 * gamma * eta2 * (long_period + short_period);
  State now = start_of(a, e, i, 0, 0, 0);
  double least = 1, most = 0, least_mean = 1, most_mean = 0, w = 0;
  constexpr int revolutions_between = 60;
  for (int sample = 0; sample < 40 && w < pi / 2; ++sample) {
    double average = 0;
    constexpr int points = 64;
    const std::vector<State> states = revolution(now, points, J2);
    for (const State& x : states) {
      const auto one = elements_of(x);
      average += std::hypot(one[1], one[2]) / points;
      w = std::atan2(one[2], one[1]);
    }
    const auto mean = elements_of(numbers(mean_of_osculating(cartesian(now), earth(J2))));
    const double e_mean = std::hypot(mean[1], mean[2]);
    least = std::min(least, average);
    most = std::max(most, average);
    least_mean = std::min(least_mean, e_mean);
    most_mean = std::max(most_mean, e_mean);
    for (int k = 0; k < revolutions_between; ++k) now = revolution(now, 2, J2).back();
    for (int k = 0; k < revolutions_between; ++k) now = revolution(now, 2, J2).back();
  }
  EXPECT_GE(w, pi / 2);
  const FirstOrder first = first_order(now, J2);
  EXPECT_NEAR(most - least, swing, 0.05 * swing);
  EXPECT_LE(most_mean - least_mean, most_times * first.angles * first.angles);
  EXPECT_LE(most_mean - least_mean, 0.2 * swing);
}

TEST(MeanElements, AreOsculatingWithoutFlattening) {
  const CartesianState start = cartesian(orbits()[0].start);
  const CartesianState mean = mean_of_osculating(start, earth(0));
  EXPECT_EQ(mean.position_km, start.position_km);
  EXPECT_EQ(mean.velocity_km_s, start.velocity_km_s);
}

TEST(MeanElements, RefusesWhatHasNone) {
  EXPECT_THROW(mean_of_osculating(cartesian({7000, 0, 0, 0, 12, 0}), earth()), Error);
  EXPECT_THROW(mean_of_osculating(cartesian({7000, 0, 0, 1, 0, 0}), earth()), Error);
  EXPECT_THROW(mean_of_osculating(cartesian(orbits()[0].start), earth(0.9)), Error);
}

}  // namespace mean_elements_test
}  // namespace hamjet
