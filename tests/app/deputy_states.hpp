#pragma once

#include <array>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "attack/extrapolation.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/studies/scene.hpp"
#include "support/kepler_ellipse.hpp"

// Computes states of deputies in extended precision: initial states from the numbers of every
// frame, and final states, on ellipses from the closed form, otherwise by an extrapolation in 31
// digits with forces that are written by hand. Nothing here uses the code that it is compared with.

namespace hamjet::test {

using Numbers = std::array<Extended, 6>;
using Place = std::array<Extended, 3>;

inline Extended dot(const Place& a, const Place& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Place position_of(const Numbers& z) { return {z[0], z[1], z[2]}; }
inline Place velocity_of(const Numbers& z) { return {z[3], z[4], z[5]}; }
inline Place combined(const Extended& a, const Place& x, const Extended& b, const Place& y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}
inline Numbers joined(const Place& x, const Place& v) {
  return {x[0], x[1], x[2], v[0], v[1], v[2]};
}

/// The axes R, T, N of a state by rows, and the rate |r x v| / r^2 at which R turns.
struct StateAxes {
  explicit StateAxes(const Numbers& z) {
    const Place x = position_of(z), h = cross(x, velocity_of(z));
    const Extended r = sqrt(dot(x, x)), size = sqrt(dot(h, h));
    axes[0] = combined(1 / r, x, 0, x);
    axes[2] = combined(1 / size, h, 0, h);
    axes[1] = cross(axes[2], axes[0]);
    rate = size / (r * r);
  }
  Place from(const Place& u) const {
    const Place plane = combined(u[0], axes[0], u[1], axes[1]);
    return combined(1, plane, u[2], axes[2]);
  }

  std::array<Place, 3> axes;
  Extended rate;
};

/// Elements of an ellipse with mu = 1 that have no singularity on circles.
struct PlainElements {
  Extended a, q1, q2, i, node;  ///< q1 = e cos w, q2 = e sin w
  Extended latitude;            ///< true argument of latitude
  Extended mean_latitude;       ///< w + M
};

inline Extended eccentric_of_true(const Extended& nu, const Extended& e) {
  return 2 * atan2(Extended(sqrt(1 - e) * sin(nu / 2)), Extended(sqrt(1 + e) * cos(nu / 2)));
}

inline PlainElements elements_of(const Numbers& z) {
  const Place x = position_of(z), v = velocity_of(z), h = cross(x, v);
  const Extended r = sqrt(dot(x, x)), size = sqrt(dot(h, h));
  const Extended flat = sqrt(h[0] * h[0] + h[1] * h[1]);
  const Place to_node = {-h[1] / flat, h[0] / flat, 0};
  const Place beside = cross(combined(1 / size, h, 0, h), to_node);
  const Place vector = combined(1, cross(v, h), -1 / r, x);  // the eccentricity vector
  PlainElements k;
  k.a = 1 / (2 / r - dot(v, v));
  k.q1 = dot(vector, to_node);
  k.q2 = dot(vector, beside);
  k.i = atan2(flat, h[2]);
  k.node = atan2(h[0], Extended(-h[1]));
  k.latitude = atan2(dot(x, beside), dot(x, to_node));
  const Extended e = sqrt(k.q1 * k.q1 + k.q2 * k.q2), w = atan2(k.q2, k.q1);
  const Extended E = eccentric_of_true(k.latitude - w, e);
  k.mean_latitude = w + E - e * sin(E);
  return k;
}

/// The state of the first five elements at a true argument of latitude.
inline Numbers state_at(const PlainElements& k, const Extended& latitude) {
  const Extended e_square = k.q1 * k.q1 + k.q2 * k.q2;
  const Extended p = k.a * (1 - e_square), speed = 1 / sqrt(p);
  const Extended c = cos(latitude), s = sin(latitude);
  const Extended r = p / (1 + k.q1 * c + k.q2 * s);
  const Place to_node = {cos(k.node), sin(k.node), 0};
  const Place beside = {-sin(k.node) * cos(k.i), cos(k.node) * cos(k.i), sin(k.i)};
  return joined(combined(r * c, to_node, r * s, beside),
                combined(-speed * (s + k.q2), to_node, speed * (c + k.q1), beside));
}

/// The same state at w + M, from Kepler's equation by bisection and then Newton's method.
inline Numbers state_at_mean(const PlainElements& k, const Extended& mean_latitude) {
  const Extended e = sqrt(k.q1 * k.q1 + k.q2 * k.q2), w = atan2(k.q2, k.q1);
  const Extended turn = 2 * boost::math::constants::pi<Extended>();
  Extended mean = mean_latitude - w;
  mean -= turn * floor(Extended(mean / turn + Extended(0.5)));
  Extended low = mean - e, high = mean + e;
  for (int step = 0; step < 40; ++step) {
    const Extended middle = (low + high) / 2;
    (middle - e * sin(middle) < mean ? low : high) = middle;
  }
  Extended E = (low + high) / 2;
  for (int step = 0; step < 4; ++step) E -= (E - e * sin(E) - mean) / (1 - e * cos(E));
  const Extended nu =
      2 * atan2(Extended(sqrt(1 + e) * sin(E / 2)), Extended(sqrt(1 - e) * cos(E / 2)));
  return state_at(k, nu + w);
}

/// A frame of deviations; the names are those of EvalFrames: RTN, inertial, curvilinear,
/// relative-elements, element-differences, canonical.
struct DeputyFrame {
  std::string name;
  bool is_rotating = false;  ///< for RTN: whether velocities are those seen from the turning axes
};

/// The deputy's canonical state (mu = 1) from its six numbers in a frame of the chief. The numbers
/// are in metres and m/s except in the canonical frame.
inline Numbers deputy_state(const DeputyFrame& frame, const CanonicalUnits& units,
                            const Numbers& chief, std::span<const double> row) {
  const Extended length = Extended(units.length_km) * 1000;
  const Extended speed = length / Extended(units.time_s);
  const Extended degree = boost::math::constants::pi<Extended>() / 180;
  Numbers x;
  for (std::size_t i = 0; i < 6; ++i) x[i] = row[i];
  if (frame.name == "relative-elements" || frame.name == "element-differences") {
    PlainElements k = elements_of(chief);
    const bool is_relative = frame.name == "relative-elements";
    if (is_relative) {
      for (Extended& number : x) number /= length * k.a;
    }
    const Extended node = is_relative ? x[5] / sin(k.i) : x[5] * degree;
    const Extended along = is_relative ? x[1] - node * cos(k.i) : x[1] * degree;
    k.a = is_relative ? k.a * (1 + x[0]) : k.a + x[0] / length;
    k.q1 += x[is_relative ? 2 : 3];
    k.q2 += x[is_relative ? 3 : 4];
    k.i += is_relative ? x[4] : x[2] * degree;
    k.node += node;
    return is_relative ? state_at_mean(k, k.mean_latitude + along)
                       : state_at(k, k.latitude + along);
  }
  if (frame.name != "canonical") {
    for (std::size_t i = 0; i < 6; ++i) x[i] /= i < 3 ? length : speed;
  }
  if (frame.name == "inertial" || frame.name == "canonical") {
    for (std::size_t i = 0; i < 6; ++i) x[i] += chief[i];
    return x;
  }
  const StateAxes axes(chief);
  if (frame.name == "RTN") {
    const Place place = position_of(x);
    Place velocity = velocity_of(x);
    if (frame.is_rotating) {
      velocity[0] -= axes.rate * place[1];
      velocity[1] += axes.rate * place[0];
    }
    Numbers state = joined(axes.from(place), axes.from(velocity));
    for (std::size_t i = 0; i < 6; ++i) state[i] += chief[i];
    return state;
  }
  // In the curvilinear frame the arcs are the angles times the chief's distance, which changes.
  const Place chief_place = position_of(chief);
  const Extended r = sqrt(dot(chief_place, chief_place));
  const Extended fall = dot(chief_place, velocity_of(chief)) / r;
  const Extended radius = r + x[0], turn = x[1] / r, rise = x[2] / r;
  const Extended turning = axes.rate + (x[4] - fall * turn) / r, rising = (x[5] - fall * rise) / r;
  const Place up = {cos(rise) * cos(turn), cos(rise) * sin(turn), sin(rise)};
  const Place ahead = {-sin(turn), cos(turn), 0};
  const Place out = {-sin(rise) * cos(turn), -sin(rise) * sin(turn), cos(rise)};
  const Place across = combined(radius * cos(rise) * turning, ahead, radius * rising, out);
  return joined(axes.from(combined(radius, up, 0, up)),
                axes.from(combined(fall + x[3], up, 1, across)));
}

/// The final state after the scene's duration; not finite if the motion cannot be followed.
inline Numbers true_end(const Scene& scene, const Numbers& z) {
  const Place x = position_of(z), v = velocity_of(z);
  const bool is_ellipse = dot(v, v) * sqrt(dot(x, x)) < Extended(1.9);
  if (scene.system.model == SystemModel::kepler && is_ellipse) {
    return along_ellipse(z, Extended(scene.duration));
  }
  // The unit of length is about the chief's distance, so that no number is rounded by it.
  using attack::DoubleDouble;
  const int exponent =
      std::ilogb(std::hypot(scene.nominal[0], scene.nominal[1], scene.nominal[2])) / 2;
  const double length = std::ldexp(1.0, 2 * exponent), speed = std::ldexp(1.0, -exponent);
  const auto of = [](const Extended& number) {
    const double high = convert<double>(number);
    return DoubleDouble(high, convert<double>(Extended(number - high)));
  };
  attack::Model model;
  if (scene.system.model != SystemModel::kepler) {
    model.radius = scene.canonical_radius / length;
    for (int n = 2; n <= ZonalCoefficients::highest; ++n) {
      model.zonal[static_cast<std::size_t>(n)] = scene.system.J[n];
    }
  }
  const auto flight = std::make_unique<attack::Extrapolation<DoubleDouble, 0>>(model, 1e-24);
  attack::LineState<DoubleDouble, 0> state;
  for (std::size_t i = 0; i < 3; ++i) {
    state.q[i][0] = of(x[i] / length);
    state.p[i][0] = of(v[i] / speed);
  }
  Numbers end;
  const bool is_followed = flight->run(state, of(Extended(scene.duration) * speed / length), 30000);
  for (std::size_t i = 0; i < 6; ++i) {
    const DoubleDouble& number = i < 3 ? state.q[i][0] : state.p[i - 3][0];
    end[i] = (Extended(number.high) + number.low) * (i < 3 ? length : speed);
    if (!is_followed) end[i] = std::numeric_limits<Extended>::quiet_NaN();
  }
  return end;
}

}  // namespace hamjet::test
