#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hamjet/dynamics/dynamical_system.hpp"

// A field of point masses and functions of the time, as objects, beside the same written with
// ordinary operations.

namespace hamjet::test {

/// A point mass at a fixed place.
struct PointMass {
  double mu;
  std::array<double, 3> place;
};

/// The potential -sum of mu / |r - place|. Its Taylor coefficients follow from Legendre's
/// generating function: with s = r - place, the parts w_n of degree n in d of 1 / |s + d| satisfy
/// Bonnet's recurrence n s^2 w_n = -(2n - 1) (s.d) w_(n-1) - (n - 1) d^2 w_(n-2).
class PointMasses final : public LocalField {
 public:
  explicit PointMasses(std::vector<PointMass> masses, int waves = 0)
      : masses_(std::move(masses)), waves_(waves) {}

  void expand(std::size_t count, const double* x, const double* y, const double* z, int degree,
              double* out) const override {
    expand_all(count, x, y, z, degree, out);
  }
  void expand(std::size_t count, const Extended* x, const Extended* y, const Extended* z,
              int degree, Extended* out) const override {
    expand_all(count, x, y, z, degree, out);
  }
  int waves_on_a_circle() const override { return waves_; }
  double multiply_adds(int degree) const override {
    return 9.0 * static_cast<double>(masses_.size() * local_field_size(degree));
  }

 private:
  template <class Real>
  void expand_all(std::size_t count, const Real* x, const Real* y, const Real* z, int degree,
                  Real* out) const {
    std::fill_n(out, count * local_field_size(degree), Real(0));
    for (std::size_t lane = 0; lane < count; ++lane) {
      for (const PointMass& mass : masses_) {
        add_mass<Real>({x[lane] - Real(mass.place[0]), y[lane] - Real(mass.place[1]),
                        z[lane] - Real(mass.place[2])},
                       Real(-mass.mu), degree, out + lane, count);
      }
    }
  }

  template <class Real>
  static void add_mass(const std::array<Real, 3>& s, const Real& factor, int degree, Real* out,
                       std::size_t stride) {
    using std::sqrt;
    const Real square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
    std::vector<Real> w(local_field_size(degree), Real(0));
    w[0] = 1 / sqrt(square);
    for (int n = 1; n <= degree; ++n) {
      for (int a = 0; a <= n; ++a) {
        for (int b = 0; a + b <= n; ++b) {
          const std::array<int, 3> e = {a, b, n - a - b};
          Real sum = 0;
          for (std::size_t i = 0; i < 3; ++i) {
            std::array<int, 3> lower = e;
            if (--lower[i] < 0) continue;
            sum -= Real(2 * n - 1) * s[i] * w[field_monomial(lower[0], lower[1], lower[2])];
            if (--lower[i] < 0) continue;
            sum -= Real(n - 1) * w[field_monomial(lower[0], lower[1], lower[2])];
          }
          w[field_monomial(a, b, e[2])] = sum / (Real(n) * square);
        }
      }
    }
    for (std::size_t k = 0; k < w.size(); ++k) out[k * stride] += factor * w[k];
  }

  std::vector<PointMass> masses_;
  int waves_;
};

/// cos(rate t + phase) and sin(rate t + phase), each times a size.
class Turning final : public TimeFunction {
 public:
  explicit Turning(double rate, double phase = 0, double size = 1)
      : rate_(rate), phase_(phase), size_(size) {}

  std::size_t components() const override { return 2; }
  void expand(double t, int degree, double* out) const override { expand_all(t, degree, out); }
  void expand(const Extended& t, int degree, Extended* out) const override {
    expand_all(t, degree, out);
  }

 private:
  template <class Real>
  void expand_all(const Real& t, int degree, Real* out) const {
    using std::cos;
    using std::sin;
    const Real angle = Real(rate_) * t + Real(phase_);
    const std::array<Real, 4> cycle = {cos(angle), -sin(angle), -cos(angle), sin(angle)};
    Real factor = Real(size_);
    for (int k = 0; k <= degree; ++k) {
      const auto place = static_cast<std::size_t>(k);
      out[place] = factor * cycle[place % 4];
      out[static_cast<std::size_t>(degree + 1) + place] = factor * cycle[(place + 3) % 4];
      factor *= Real(rate_) / Real(k + 1);
    }
  }

  double rate_;
  double phase_;
  double size_;
};

/// The masses are added one by one, because g++ 12 warns of a list of masses.
inline std::vector<PointMass> three_masses() {
  std::vector<PointMass> masses;
  masses.push_back({0.9, {0, 0, 0}});
  masses.push_back({0.04, {0.3, 0.1, -0.2}});
  masses.push_back({0.06, {-0.2, 0.25, 0.1}});
  return masses;
}

/// A body made of point masses that turns about the third axis, and another body on a circle about
/// it, in units in which a low orbit has a radius and a speed of about 1.
struct MovingFields {
  double rate = 0.3;
  std::vector<PointMass> masses = three_masses();
  double body_mu = 0.2;
  double body_distance = 4;
  double body_rate = 0.1;

  /// Rotated into the first body's axes by the angle of the body.
  template <class T>
  static std::array<T, 3> in_body_axes(std::span<const T> q, const T& cosine, const T& sine) {
    return {cosine * q[0] + sine * q[1], cosine * q[1] - sine * q[0], q[2]};
  }

  template <class T>
  static T potential(const std::vector<PointMass>& masses, const std::array<T, 3>& r) {
    T sum(0);
    for (const PointMass& mass : masses) {
      sum -= T(mass.mu) * pow(square(r[0] - T(mass.place[0])) + square(r[1] - T(mass.place[1])) +
                                  square(r[2] - T(mass.place[2])),
                              T(-0.5));
    }
    return sum;
  }

  /// By ordinary operations; t may be a constant.
  DynamicalSystem recorded() const {
    return make_system(
        "recorded", 3,
        [&](std::span<const Expression> q, std::span<const Expression> p, const Expression& t) {
          const Expression angle = rate * t;
          const Expression body_angle = body_rate * t + 0.4;
          const std::array<Expression, 3> from_body = {
              q[0] - body_distance * cos(body_angle), q[1] - body_distance * sin(body_angle), q[2]};
          return kinetic(p) +
                 potential(masses, in_body_axes<Expression>(q, cos(angle), sin(angle))) +
                 potential<Expression>({{body_mu, {0, 0, 0}}}, from_body);
        });
  }

  /// By objects. The second body is told in the axes of the first, so that the deviations of both
  /// positions are the same.
  DynamicalSystem with_objects(int waves = 0) const {
    const auto field = std::make_shared<const PointMasses>(masses, waves);
    const auto body =
        std::make_shared<const PointMasses>(std::vector<PointMass>{{body_mu, {0, 0, 0}}});
    const auto turn = std::make_shared<const Turning>(rate);
    const auto body_place = std::make_shared<const Turning>(body_rate, 0.4, body_distance);
    return make_system(
        "with objects", 3,
        [&](std::span<const Expression> q, std::span<const Expression> p, const Expression& t) {
          const auto angle = time_values(turn, t);
          const auto place = time_values(body_place, t);
          const auto r = in_body_axes<Expression>(q, angle[0], angle[1]);
          const std::vector<Expression> s = {place[0], place[1], Expression(0)};
          const auto at = in_body_axes<Expression>(s, angle[0], angle[1]);
          return kinetic(p) + field_value(field, r) +
                 field_value(body, {r[0] - at[0], r[1] - at[1], r[2] - at[2]});
        });
  }

  /// The first body alone, in inertial axes: by objects.
  DynamicalSystem turning_body() const {
    const auto field = std::make_shared<const PointMasses>(masses);
    const auto turn = std::make_shared<const Turning>(rate);
    return make_system(
        "turning body", 3,
        [&](std::span<const Expression> q, std::span<const Expression> p, const Expression& t) {
          const auto angle = time_values(turn, t);
          return kinetic(p) + field_value(field, in_body_axes<Expression>(q, angle[0], angle[1]));
        });
  }

  /// The first body alone in its own axes, with ordinary operations: H = p^2/2 + U(q) - rate L_3.
  DynamicalSystem in_rotating_axes() const {
    return make_system("rotating axes", 3,
                       [&](std::span<const Expression> q, std::span<const Expression> p) {
                         return kinetic(p) + potential<Expression>(masses, {q[0], q[1], q[2]}) -
                                rate * (q[0] * p[1] - q[1] * p[0]);
                       });
  }

  static Expression kinetic(std::span<const Expression> p) {
    return (square(p[0]) + square(p[1]) + square(p[2])) / 2;
  }
};

}  // namespace hamjet::test
