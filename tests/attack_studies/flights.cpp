// Flights for the attack on the studies. Nothing of hamjet is included here, for these flights are
// what its answers are compared with.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include "flight.hpp"

namespace {

using attack::dot;
using attack::Earth;
using attack::Field;
using attack::Flight;
using attack::norm;
using attack::Real;
using attack::State;
using attack::Vector;

/// A centre, whose field is that of an Earth unless it is null.
Field field_of(const long double* centre, int highest, const long double* zonals, void* of_earth) {
  Earth* const earth = static_cast<Earth*>(of_earth);
  return {centre[0], centre[1], highest, zonals, earth, earth ? earth->light() : nullptr};
}

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

/// Gives an Earth the light along a chief's orbit, of which it is the Earth, with this shadow.
void light_chief(void* of_earth, const long double* centre, const long double* chief) {
  Earth* const earth = static_cast<Earth*>(of_earth);
  const Field field{centre[0], centre[1], 0, nullptr, earth};
  earth->set_light(std::make_shared<attack::Light>(field, read(chief)));
}

/// Gives the Earth of another spacecraft the light of its chief's.
void share_light(void* earth, void* of_chief) {
  static_cast<Earth*>(earth)->set_light(static_cast<Earth*>(of_chief)->shared_light());
}

// Numbers come by their address: Python's interface would hand them over as doubles. `centre` is mu
// and the radius of the zonals, whose highest degree is `highest`; `earth` is null or takes their
// place, and `begin` is the time of the starts for it.

/// Computes the states of `flights` orbits at `count` times, which move away from 0. Returns 1 if
/// an orbit cannot be flown.
int fly(int flights, const long double* starts, const long double* centre, int highest,
        const long double* zonals, void* earth, const long double* begin, int count,
        const long double* times, const long double* tolerance, long double* states) {
  const Field field = field_of(centre, highest, zonals, earth);
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
  const Field field = field_of(centre, highest, zonals, earth);
  const Field other = field_of(centre, highest, zonals, of_second);
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
