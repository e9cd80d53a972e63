// Flights for the attack on the studies, in the long double of the machine: an extrapolation of
// Störmer's rule through a force that is written from Legendre's polynomials, or that of the Earth.
// Nothing of hamjet is included here, for these flights are what its answers are compared with.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "earth_forces.hpp"

namespace {

using attack::Earth;
using attack::Real;
using attack::Vector;

constexpr int most_columns = 12;

struct Field {
  Real mu;
  Real radius;
  int highest;         ///< highest zonal degree; below 2 the field is that of a point mass
  const Real* zonals;  ///< J_n at index n
  Earth* earth;        ///< or null; it takes the place of the zonals
};

struct State {
  Vector x, v;
};

Real norm(const Vector& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The gradient of U = mu/r (1 - sum J_n (R/r)^n P_n(z/r)): with s = z/r,
///   dU/dr = -mu/r^2 (1 - sum (n+1) J_n (R/r)^n P_n),  dU/ds = -mu/r sum J_n (R/r)^n P_n'.
/// The time counts for the Earth alone.
Vector acceleration(const Field& field, const Vector& x, Real time) {
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
  attack::Drag drag;
};

bool has_air(const Field& field) { return field.earth && field.earth->has_air(); }

Force force(const Field& field, const Vector& x, Real time) {
  Force there{acceleration(field, x, time), {}};
  if (has_air(field)) there.drag = field.earth->drag(x, time);
  return there;
}

/// Changes a velocity by what acts at rest for a time: with a drag by the mean of the velocities
/// before and after, so that the same time backwards undoes it.
void kick(const Force& there, Real time, Vector& v) {
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
State parts_in_air(const Field& field, const State& start, const Force& first, Real time, Real step,
                   int n) {
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
State parts(const Field& field, const State& start, const Force& there, Real time, Real step,
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
int extrapolate(const Field& field, State& state, Real time, Real step, Real tolerance) {
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
      const Real left = time - time_;
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
      time_ = is_last ? time : time_ + step;
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
  Field field_;
  State state_;
  Real begin_;
  Real tolerance_;
  Real time_ = 0;
  Real step_ = 0;
};

State read(const Real* numbers) {
  State state;
  for (int i = 0; i < 3; ++i) {
    state.x[i] = numbers[i];
    state.v[i] = numbers[i + 3];
  }
  return state;
}

void write(const State& state, Real* numbers) {
  for (int i = 0; i < 3; ++i) {
    numbers[i] = state.x[i];
    numbers[i + 3] = state.v[i];
  }
}

/// Two flights side by side.
struct Pair {
  Flight a, b;

  bool to(Real time) { return a.to(time) && b.to(time); }
  Real time() const { return a.time(); }
  Real pace() const { return std::min(a.pace(), b.pace()); }
  Vector place() const { return difference(b.state().x, a.state().x); }
  Vector velocity() const { return difference(b.state().v, a.state().v); }
  Real closing() const { return dot(place(), velocity()); }

  static Vector difference(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
};

struct Nearest {
  Real separation = INFINITY, time = 0;

  void add(const Pair& pair) {
    const Real there = norm(pair.place());
    if (there < separation) {
      separation = there;
      time = pair.time();
    }
  }
};

Real next_look(const Pair& pair, Real end, int looks) {
  const Real step = pair.pace() / looks;
  const Real left = end - pair.time();
  return std::abs(left) < step * 1.01L ? end : pair.time() + std::copysign(step, left);
}

/// Halves the time between looks until steps of Newton's method, along the straight line that the
/// relative motion is when it is near, no longer change the separation.
bool narrow(const Pair& before, Real end, Real way, Nearest& nearest) {
  Real low = before.time(), high = end;
  for (int k = 0; k < 40; ++k) {
    Pair middle = before;
    if (!middle.to((low + high) / 2)) return false;
    nearest.add(middle);
    const Vector speed = middle.velocity();
    const Real guess = middle.time() - middle.closing() / dot(speed, speed);
    if (k > 2 && guess > std::min(low, high) && guess < std::max(low, high)) {
      Pair there = before;
      if (!there.to(guess)) return false;
      const Real last = nearest.separation;
      nearest.add(there);
      if (std::abs(norm(there.place()) - last) <= 1e-9L * last) break;
    }
    (middle.closing() * way < 0 ? low : high) = middle.time();
  }
  return true;
}

}  // namespace

extern "C" {

// Numbers come by their address: Python's interface would hand them over as doubles. `centre` is mu
// and the radius of the zonals, whose highest degree is `highest`; `earth` is null or takes their
// place, and `begin` is the time of the starts for it.

/// Computes the states of `flights` orbits at `count` times, which move away from 0. Returns 1 if
/// an orbit cannot be flown.
int fly(int flights, const long double* starts, const long double* centre, int highest,
        const long double* zonals, void* earth, const long double* begin, int count,
        const long double* times, const long double* tolerance, long double* states) {
  const Field field{centre[0], centre[1], highest, zonals, static_cast<Earth*>(earth)};
  for (int f = 0; f < flights; ++f) {
    Flight flight(field, read(starts + 6 * f), *begin, *tolerance);
    for (int k = 0; k < count; ++k) {
      if (!flight.to(times[k])) return 1;
      write(flight.state(), states + 6 * (std::size_t(f) * count + k));
    }
  }
  return 0;
}

/// Of each of `flights` pairs the least separation in a window (its begin and end), and when that
/// is; the second ones fly about an Earth of their own, for the air may brake them otherwise: there
/// are `looks` a radian of a circle at the place of the lower one, and a change of sign of the
/// closing speed between two of them is narrowed down by flights.
int least_separations(int flights, const long double* first, const long double* second,
                      const long double* centre, int highest, const long double* zonals,
                      void* earth, void* of_second, const long double* begin,
                      const long double* window, int looks, const long double* tolerance,
                      long double* separations, long double* times) {
  const Field field{centre[0], centre[1], highest, zonals, static_cast<Earth*>(earth)};
  const Field other{centre[0], centre[1], highest, zonals, static_cast<Earth*>(of_second)};
  for (int f = 0; f < flights; ++f) {
    Pair pair{Flight(field, read(first + 6 * f), *begin, *tolerance),
              Flight(other, read(second + 6 * f), *begin, *tolerance)};
    Nearest nearest;
    if (!pair.to(window[0])) return 1;
    nearest.add(pair);
    while (pair.time() != window[1]) {
      const Pair before = pair;
      if (!pair.to(next_look(before, window[1], looks))) return 1;
      nearest.add(pair);
      const Real way = window[1] < window[0] ? -1 : 1;
      if (before.closing() * way < 0 && pair.closing() * way > 0 &&
          !narrow(before, pair.time(), way, nearest)) {
        return 1;
      }
    }
    separations[f] = nearest.separation;
    times[f] = nearest.time;
  }
  return 0;
}
}
