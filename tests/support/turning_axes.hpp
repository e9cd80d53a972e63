#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hamjet/detail/dynamics/time_function.hpp"
#include "support/moving_fields.hpp"

// Functions of the time for systems about a body that turns, by closed forms.

namespace hamjet::test {

/// The matrix from inertial axes to those of a body that turns at a constant rate about an axis,
/// the z axis turned by a tilt about x; row after row.
class TurningAxes final : public TimeFunction {
 public:
  TurningAxes(double tilt, double rate) : tilt_(tilt), rate_(rate) {}

  std::size_t components() const override { return 9; }
  void expand(double t, int degree, double* out) const override { expand_in(t, degree, out); }
  void expand(const Extended& t, int degree, Extended* out) const override {
    expand_in(t, degree, out);
  }

 private:
  template <class Real>
  void expand_in(const Real& t, int degree, Real* out) const {
    using std::cos;
    using std::sin;
    const Real ct = cos(Real(tilt_)), st = sin(Real(tilt_));
    const auto size = static_cast<std::size_t>(degree) + 1;
    std::vector<Real> turning(2 * size);
    Turning(rate_).expand(t, degree, turning.data());
    for (std::size_t k = 0; k < size; ++k) {
      const Real c = turning[k], s = turning[size + k], one = k == 0 ? 1 : 0;
      // Rows: the turned x axis, the turned y' = (0, ct, st), and the axis itself.
      const Real rows[9] = {c, s * ct, s * st, -s, c * ct, c * st, 0, -st * one, ct * one};
      for (std::size_t i = 0; i < 9; ++i) out[i * size + k] = rows[i];
    }
  }

  double tilt_;
  double rate_;
};

/// A point that moves evenly.
class MovingPoint final : public TimeFunction {
 public:
  MovingPoint(const std::array<double, 3>& place, const std::array<double, 3>& velocity)
      : place_(place), velocity_(velocity) {}

  std::size_t components() const override { return 3; }
  void expand(double t, int degree, double* out) const override { expand_in(t, degree, out); }
  void expand(const Extended& t, int degree, Extended* out) const override {
    expand_in(t, degree, out);
  }

 private:
  template <class Real>
  void expand_in(const Real& t, int degree, Real* out) const {
    for (std::size_t i = 0; i < 3; ++i) {
      for (int k = 0; k <= degree; ++k) {
        Real value = 0;
        if (k == 0) value = Real(place_[i]) + Real(velocity_[i]) * t;
        if (k == 1) value = Real(velocity_[i]);
        out[i * static_cast<std::size_t>(degree + 1) + static_cast<std::size_t>(k)] = value;
      }
    }
  }

  std::array<double, 3> place_;
  std::array<double, 3> velocity_;
};

}  // namespace hamjet::test
