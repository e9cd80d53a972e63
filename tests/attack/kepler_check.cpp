#include "kepler_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "drawn_scene.hpp"
#include "line_reference.hpp"

namespace hamjet::attack {
namespace {

constexpr int order = 4;
using S = LineSeries<DoubleDouble, order>;
using Vector = std::array<S, 3>;

S dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

S minus_one(S a) {
  a[0] -= DoubleDouble(1);
  return a;
}

/// Sine and cosine of a number, from Taylor's series at a 64th of the number, whose angle is then
/// doubled six times.
std::pair<DoubleDouble, DoubleDouble> sine_cosine(const DoubleDouble& x) {
  constexpr int doublings = 6;
  const DoubleDouble two_pi(0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52);
  const DoubleDouble turns(std::round(x.high / two_pi.high));
  const DoubleDouble y = (x - turns * two_pi) * DoubleDouble(1.0 / (1 << doublings));
  DoubleDouble sine, versine,
      term(1);  // versine = 1 - cosine, which is small, so that no digit is lost
  for (int k = 1; k <= 24; ++k) {
    term = term * y / DoubleDouble(k);
    DoubleDouble& sum = k % 2 == 1 ? sine : versine;
    sum = k % 4 == 1 || k % 4 == 2 ? sum + term : sum - term;
  }
  for (int i = 0; i < doublings; ++i) {
    const DoubleDouble cosine = DoubleDouble(1) - versine;
    versine = DoubleDouble(2) * sine * sine;
    sine = DoubleDouble(2) * sine * cosine;
  }
  return {sine, DoubleDouble(1) - versine};
}

/// Sine and cosine of a series, from sin' = x' cos and cos' = -x' sin.
std::pair<S, S> sine_cosine(const S& x) {
  S sine, cosine;
  std::tie(sine[0], cosine[0]) = sine_cosine(x[0]);
  for (int k = 1; k <= order; ++k) {
    for (int j = 1; j <= k; ++j) {
      const DoubleDouble slope = DoubleDouble(j) * x[j] / DoubleDouble(k);
      sine[k] += slope * cosine[k - j];
      cosine[k] -= slope * sine[k - j];
    }
  }
  return {sine, cosine};
}

/// The root x of x - c sin x + s (1 - cos x) = mean: Kepler's equation for the change of the
/// eccentric anomaly, by bisection and then Newton's method on the series.
S eccentric_anomaly(const S& c, const S& s, const S& mean) {
  const double c0 = to_double(c[0]), s0 = to_double(s[0]), mean0 = to_double(mean[0]);
  double low = mean0 - 2, high = mean0 + 2;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (x - c0 * std::sin(x) + s0 * (1 - std::cos(x)) < mean0 ? low : high) = x;
  }
  S x(DoubleDouble(0.5 * (low + high)));
  for (int i = 0; i < 6; ++i) {
    const auto [sine, cosine] = sine_cosine(x);
    const S residual = x - c * sine - s * minus_one(cosine) - mean;
    const S slope = S(DoubleDouble(1)) - c * cosine + s * sine;
    x -= residual * half_power(slope, -2);
  }
  return x;
}

/// Lagrange's f and g for mu = 1. Source: R. H. Battin, An Introduction to the Mathematics and
/// Methods of Astrodynamics, section 4.3.
std::pair<Vector, Vector> closed_form(const Vector& q, const Vector& p, double duration) {
  const S radius_square = dot(q, q);
  const S inverse_radius = half_power(radius_square, -1);
  const S inverse_axis = DoubleDouble(2) * inverse_radius - dot(p, p);
  const S axis = half_power(inverse_axis, -2);
  const S c = S(DoubleDouble(1)) - half_power(radius_square, 1) * inverse_axis;
  const S s = dot(q, p) * half_power(inverse_axis, 1);
  const S x = eccentric_anomaly(c, s, DoubleDouble(duration) * half_power(inverse_axis, 3));
  const auto [sine, cosine] = sine_cosine(x);
  const S versine = S(DoubleDouble(1)) - cosine;
  const S end_inverse = half_power(S(DoubleDouble(1)) - c * cosine + s * sine, -2);  // a / r
  const S f = S(DoubleDouble(1)) - versine * axis * inverse_radius;
  const S g = S(DoubleDouble(duration)) - (x - sine) * half_power(inverse_axis, -3);
  const S f_slope =
      DoubleDouble(-1) * (sine * half_power(inverse_axis, 1) * end_inverse * inverse_radius);
  const S g_slope = S(DoubleDouble(1)) - versine * end_inverse;
  Vector end, momentum;
  for (std::size_t i = 0; i < 3; ++i) {
    end[i] = f * q[i] + g * p[i];
    momentum[i] = f_slope * q[i] + g_slope * p[i];
  }
  return {end, momentum};
}

}  // namespace

double difference_from_closed_form(std::uint64_t seed, int lines) {
  RandomNumbers random(seed, 0x9e3779b97f4a7c15);
  double worst = 0;
  for (int i = 0; i < lines; ++i) {
    const double e = random.uniform(0, 0.95), turn = random.uniform(0, 6);
    Line line;
    // At the perigee of an inclined ellipse of semi-major axis 1 / (1 - e).
    line.start = {std::cos(turn), std::sin(turn), 0.3, 0, 0, 0};
    const double r = std::sqrt(1.09), v = std::sqrt((1 + e) / r);
    line.start[3] = -v * std::sin(turn);
    line.start[4] = v * std::cos(turn);
    line.duration = random.uniform(-3, 3) * 2 * std::numbers::pi * std::pow(r / (1 - e), 1.5);
    line.order = order;
    for (int c = 0; c < 6; ++c) line.direction.push_back(random.uniform(-1, 1));
    const LineReference reference = follow(Model{}, line, seed, 1e-26, 1e-24);
    if (!reference.failure.empty()) return HUGE_VAL;
    Vector q, p;
    for (std::size_t c = 0; c < 3; ++c) {
      q[c][0] = line.start[c];
      q[c][1] = line.direction[c];
      p[c][0] = line.start[3 + c];
      p[c][1] = line.direction[3 + c];
    }
    const auto [end, momentum] = closed_form(q, p, line.duration);
    for (std::size_t c = 0; c < 6; ++c) {
      const S& exact = c < 3 ? end[c] : momentum[c - 3];
      const double size = c < 3 ? reference.position_size : reference.momentum_size;
      for (int k = 0; k <= order; ++k) {
        const auto degree = static_cast<std::size_t>(k);
        const double difference = magnitude(reference.coefficients[c][degree] - exact[k]) / size -
                                  reference.uncertainty[degree];
        worst = std::max(worst, difference / reference.size[degree]);
      }
    }
  }
  return worst;
}

}  // namespace hamjet::attack
