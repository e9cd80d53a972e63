// An extrapolation of Störmer's rule through a force that is written from Legendre's polynomials,
// or that of the Earth, in the long double of the machine. Nothing of hamjet is included.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "earth_forces.hpp"
#include "light.hpp"

namespace attack {

constexpr int most_columns = 12;

struct Field {
  Real mu;
  Real radius;
  int highest;             ///< highest zonal degree; below 2 the field is that of a point mass
  const Real* zonals;      ///< J_n at index n
  Earth* earth;            ///< or null; it takes the place of the zonals
  Light* light = nullptr;  ///< of the Earth's shadow along its chief, or null
};

struct State {
  Vector x, v;
};

inline Real norm(const Vector& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
inline Real dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The gradient of U = mu/r (1 - sum J_n (R/r)^n P_n(z/r)): with s = z/r,
///   dU/dr = -mu/r^2 (1 - sum (n+1) J_n (R/r)^n P_n),  dU/ds = -mu/r sum J_n (R/r)^n P_n'.
/// The time counts for the Earth alone.
inline Vector acceleration(const Field& field, const Vector& x, Real time) {
  if (field.earth) return field.earth->acceleration(x, time);
  const Real r = norm(x);
  const Real s = x[2] / r;
  Real radial = 1, across = 0;
  Real before = 1, legendre = s, derivative = 1, ratio = field.radius / r;
  for (int n = 2; n <= field.highest; ++n) {
    // n P_n = (2n-1) s P_(n-1) - (n-1) P_(n-2),  P_n' = n P_(n-1) + s P_(n-1)'.
    const Real next = ((2 * n - 1) * s * legendre - (n - 1) * before) / n;
    derivative = n * legendre + s * derivative;
    before = legendre;
    legendre = next;
    ratio *= field.radius / r;
    radial -= (n + 1) * field.zonals[n] * ratio * legendre;
    across += field.zonals[n] * ratio * derivative;
  }
  // grad s = (e_z - s x/r) / r.
  const Real g = field.mu / (r * r);
  Vector a;
  for (int i = 0; i < 3; ++i) {
    const Real unit = x[i] / r;
    a[i] = -g * radial * unit - g * across * ((i == 2 ? 1 : 0) - s * unit);
  }
  return a;
}

/// What acts at a place: an acceleration and, in the air, a drag that depends on the velocity.
struct Force {
  Vector a;
  Drag drag;
};

inline bool has_air(const Field& field) { return field.earth && field.earth->has_air(); }

inline Force force(const Field& field, const Vector& x, Real time) {
  Force there{acceleration(field, x, time), {}};
  if (has_air(field)) there.drag = field.earth->drag(x, time);
  return there;
}

/// Changes a velocity by what acts at rest for a time: with a drag by the mean of the velocities
/// before and after, so that the same time backwards undoes it.
inline void kick(const Force& there, Real time, Vector& v) {
  Vector after = v;
  for (int k = 0; k < 20; ++k) {
    Vector through;
    for (int i = 0; i < 3; ++i) through[i] = (v[i] + after[i]) / 2 - there.drag.wind[i];
    const Real rate = there.drag.rate * norm(through);
    Real changed = 0;
    for (int i = 0; i < 3; ++i) {
      const Real next = v[i] + time * (there.a[i] - rate * through[i]);
      changed = std::max(changed, std::abs(next - after[i]));
      after[i] = next;
    }
    if (there.drag.rate == 0 || changed <= 1e-20L * norm(after)) break;
  }
  v = after;
}

/// As parts(), with a drag: half a kick before and after each part, which is symmetric in time as a
/// whole, so that errors have even powers of the step alone.
inline State parts_in_air(const Field& field, const State& start, const Force& first, Real time,
                          Real step, int n) {
  const Real h = step / n;
  State change{};
  Vector v = start.v, x;
  Force there = first;
  for (int k = 1; k <= n; ++k) {
    kick(there, h / 2, v);
    for (int i = 0; i < 3; ++i) {
      change.x[i] += h * v[i];
      x[i] = start.x[i] + change.x[i];
    }
    there = force(field, x, time + k * h);
    kick(there, h / 2, v);
  }
  for (int i = 0; i < 3; ++i) change.v[i] = v[i] - start.v[i];
  return change;
}

/// Increments of position and velocity over a step by Störmer's rule with n parts.
inline State parts(const Field& field, const State& start, const Force& there, Real time, Real step,
                   int n) {
  if (has_air(field)) return parts_in_air(field, start, there, time, step, n);
  const Vector& first = there.a;
  const Real h = step / n;
  State change{};
  Vector slope, x;
  for (int i = 0; i < 3; ++i) slope[i] = start.v[i] + h / 2 * first[i];
  for (int k = 1;; ++k) {
    for (int i = 0; i < 3; ++i) {
      change.x[i] += h * slope[i];
      x[i] = start.x[i] + change.x[i];
    }
    const Vector a = acceleration(field, x, time + k * h);
    if (k == n) {
      for (int i = 0; i < 3; ++i) change.v[i] = (slope[i] - start.v[i]) + h / 2 * a[i];
      return change;
    }
    for (int i = 0; i < 3; ++i) slope[i] += h * a[i];
  }
}

/// A step that goes until its columns agree to the tolerance; 0 if they do not, else the number of
/// columns.
inline int extrapolate(const Field& field, State& state, Real time, Real step, Real tolerance) {
  const Force first = force(field, state.x, time);
  std::array<State, most_columns> table;
  const Real scale_x = norm(state.x), scale_v = norm(state.v);
  for (int j = 0; j < most_columns; ++j) {
    State above = parts(field, state, first, time, step, j + 1);
    State last{};
    for (int k = 1; k <= j; ++k) {
      const Real ratio = Real(j + 1) / Real(j + 1 - k);
      const Real weight = 1 / (ratio * ratio - 1);
      State& below = table[k - 1];
      State next;
      for (int i = 0; i < 3; ++i) {
        next.x[i] = above.x[i] + (above.x[i] - below.x[i]) * weight;
        next.v[i] = above.v[i] + (above.v[i] - below.v[i]) * weight;
      }
      last = above;
      below = above;
      above = next;
    }
    table[j] = above;
    if (j < 2) continue;
    Vector dx, dv;
    for (int i = 0; i < 3; ++i) {
      dx[i] = above.x[i] - last.x[i];
      dv[i] = above.v[i] - last.v[i];
    }
    if (norm(dx) <= tolerance * scale_x && norm(dv) <= tolerance * scale_v) {
      for (int i = 0; i < 3; ++i) {
        state.x[i] += above.x[i];
        state.v[i] += above.v[i];
      }
      return j + 1;
    }
  }
  return 0;
}

/// A flight that remembers the step that it takes when nothing shortens the step.
class Flight {
 public:
  /// `begin` is the state's time for the field; times are counted from it.
  Flight(const Field& field, const State& state, Real begin, Real tolerance)
      : field_(field), state_(state), begin_(begin), tolerance_(tolerance) {}

  bool to(Real time) {
    if (step_ == 0) step_ = Real(0.2) * pace();
    while (time_ != time) {
      // Steps end where the light has no derivatives.
      const Real end = field_.light ? enter_light(time) : time;
      const Real left = end - time_;
      const bool is_last = std::abs(left) <= step_;
      const Real step = is_last ? left : std::copysign(step_, left);
      State next = state_;
      const int columns = extrapolate(field_, next, begin_ + time_, step, tolerance_);
      if (columns == 0) {
        step_ = std::abs(step) / 2;
        if (!(step_ > 1e-6L * pace())) return false;
        continue;
      }
      state_ = next;
      time_ = is_last ? end : time_ + step;
      if (is_last) continue;
      if (columns <= 8) step_ *= 1.3L;
      if (columns >= 11) step_ *= 0.8L;
    }
    return true;
  }
  /// The time in which a circular orbit at this place turns by a radian.
  Real pace() const {
    const Real r = norm(state_.x);
    return std::sqrt(r * r * r / field_.mu);
  }
  Real time() const { return time_; }
  const State& state() const { return state_; }

 private:
  /// Takes the light of the present moment, and gives the end of its piece, or the time if that is
  /// earlier.
  Real enter_light(Real time) {
    const Real way = time < time_ ? -1 : 1;
    const LightPiece& piece = field_.light->at(begin_ + time_, way);
    field_.earth->light_by(&piece);
    const Real edge = (way > 0 ? piece.to : piece.from) - begin_;
    return (edge - time) * way < 0 ? edge : time;
  }

  Field field_;
  State state_;
  Real begin_;
  Real tolerance_;
  Real time_ = 0;
  Real step_ = 0;
};

}  // namespace attack
