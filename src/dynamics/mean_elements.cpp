#include "hamjet/dynamics/mean_elements.hpp"

#include <array>
#include <cmath>

#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using Gradient = std::array<Extended, 6>;

/// A function of position and velocity, with its derivatives by these.
using Number = Series<Extended>;
using Vector = std::array<Number, 3>;

Number dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// f(x) for a function f of one number, from the value and the derivative of f there.
Number chain(const Number& x, const Extended& value, const Extended& derivative) {
  Number result = derivative * x;
  result[0] = value;
  return result;
}

Number arctangent(const Number& x) { return chain(x, atan(x[0]), Extended(1) / (1 + x[0] * x[0])); }

/// (1 - exp(-100 x^2)) / x, which equals 1/x except near 0.
Number soft_inverse(const Number& x) {
  const Extended& at = x[0];
  const Extended square = 100 * at * at;
  if (square < Extended(1e-12)) {
    // The next terms of the series are 1e-24 of these.
    return chain(x, 100 * at * (1 - square / 2), 100 * (1 - 3 * square / 2));
  }
  const Extended value = -expm1(Extended(-square)) / at;
  return chain(x, value, 200 * exp(Extended(-square)) - value / at);
}

[[noreturn]] void refuse_orbit() {
  throw Error(ErrorKind::numerical,
              "mean elements: the orbit must be an ellipse, out of the straight line through the "
              "centre");
}

/// The derivatives of the generating function with respect to position and velocity.
Gradient gradient_of_generating_function(const CartesianState& state, const OblateBody& body) {
  const SpacePointer space = SeriesSpace::create(6, 1);
  const auto variable = [&](std::size_t i) {
    const auto& numbers = i < 3 ? state.position_km : state.velocity_km_s;
    Number x(space, numbers[i % 3]);
    x[space->linear_index(i)] = 1;
    return x;
  };
  const Vector r = {variable(0), variable(1), variable(2)};
  const Vector v = {variable(3), variable(4), variable(5)};
  const Extended mu = body.mu_km3_s2;
  const Vector h = cross(r, v);
  const Number G = sqrt(dot(h, h));
  const Number distance = sqrt(dot(r, r));
  const Number inverse_a = Extended(2) / distance - dot(v, v) / mu;
  if (!(inverse_a[0] > 0) || !(G[0] > 0)) refuse_orbit();
  const Number p = dot(h, h) / mu;
  const Number eta = sqrt(p * inverse_a);
  const Number radial_rate = dot(r, v) / distance;

  // e cos f and e sin f, and with them the differences of the anomalies.
  const Number e_cos = p / distance - Extended(1);
  const Number e_sin = radial_rate * G / mu;
  const Number f_minus_E = Extended(2) * arctangent(e_sin / (Extended(1) + eta + e_cos));
  const Number f_minus_l = f_minus_E + eta * e_sin / (Extended(1) + e_cos);

  // The z components of the radial and the transverse direction are sin i sin u and sin i cos u.
  const Number up = r[2] / distance;
  const Number along = cross(h, r)[2] / (G * distance);
  const Number cosine = square(along) - square(up);  // sin^2 i cos 2u
  const Number sine = Extended(2) * up * along;      // sin^2 i sin 2u
  const Number theta_2 = square(h[2] / G);           // cos^2 i
  const Number sin_2_i = (square(h[0]) + square(h[1])) / square(G);

  // (f + g) + ..., the integral of (a/r)^3 (1 - 3 sin^2 i/2 + 3/2 sin^2 i cos 2u) by l, times
  // eta^3, without what is linear in l:
  //   (1 - 3/2 s^2) (f - l + e sin f) + 3/2 s^2 (sin 2u/2 + e sin(f + 2g)/2 + e sin(3f + 2g)/6) .
  const Number e_sin_f_2g = sine * e_cos - cosine * e_sin;
  const Number e_sin_3f_2g = sine * e_cos + cosine * e_sin;
  const Number integral = (Extended(1) - Extended(1.5) * sin_2_i) * (f_minus_l + e_sin) +
                          Extended(0.75) * (sine + e_sin_f_2g + e_sin_3f_2g / Extended(3));
  // mu J2 R^2 / (2 n a^3 eta^3) = mu J2 R^2 / (2 p G) .
  const Extended flattening = body.J2 * Extended(body.radius_km) * body.radius_km / 2;
  const Number short_period = -(mu * flattening) * integral / (p * G);

  // e sin i sin g and e sin i cos g are the z components of the eccentricity vector and of the
  // vector a right angle ahead of it in the plane.
  const Number e_up = e_cos * up - e_sin * along;
  const Number e_along = e_cos * along + e_sin * up;
  // L gamma_2 e^2 / (16 eta^3) sin^2 i (1 - 15 theta^2) / (1 - 5 theta^2) sin 2g .
  const Number long_period = (flattening / 8) * e_up * e_along *
                             (Extended(1) - Extended(15) * theta_2) *
                             soft_inverse(Extended(1) - Extended(5) * theta_2) * mu / (p * G);
  const Number W = short_period + long_period;
  Gradient gradient;
  for (std::size_t i = 0; i < 6; ++i) gradient[i] = W[space->linear_index(i)];
  return gradient;
}

/// A state moved by the periodic terms that are evaluated at `mean`, times a sign.
CartesianState moved(const CartesianState& state, const CartesianState& mean,
                     const OblateBody& body, int sign) {
  const Gradient gradient = gradient_of_generating_function(mean, body);
  CartesianState result = state;
  for (std::size_t i = 0; i < 3; ++i) {
    result.position_km[i] += sign * gradient[3 + i];
    result.velocity_km_s[i] -= sign * gradient[i];
  }
  return result;
}

/// The sum of the relative differences of positions and of velocities. A sum, unlike a maximum,
/// keeps a NaN.
Extended difference(const CartesianState& a, const CartesianState& b) {
  const auto relative = [](const auto& x, const auto& y) {
    Extended distance = 0, size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      distance += abs(x[i] - y[i]);
      size += abs(x[i]);
    }
    return Extended(distance / size);
  };
  return relative(a.position_km, b.position_km) + relative(a.velocity_km_s, b.velocity_km_s);
}

}  // namespace

CartesianState osculating_of_mean(const CartesianState& mean, const OblateBody& body) {
  return moved(mean, mean, body, 1);
}

CartesianState mean_of_osculating(const CartesianState& osculating, const OblateBody& body) {
  constexpr int most_iterations = 200;
  CartesianState mean = osculating;
  for (int i = 0; i < most_iterations; ++i) {
    CartesianState next = moved(osculating, mean, body, -1);
    const Extended change = difference(next, mean);
    mean = std::move(next);
    if (change < Extended(1e-31)) return mean;
  }
  throw Error(ErrorKind::numerical,
              "mean elements: the iteration does not converge, for J2 is too large in this orbit");
}

}  // namespace hamjet
