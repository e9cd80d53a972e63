#include "light.hpp"

#include <algorithm>
#include <cmath>

#include "flight.hpp"

namespace attack {
namespace {

constexpr Real sun_radius = 695700e3L;
constexpr Real pi = 3.14159265358979323846264338327950288L;
constexpr int degree = 16;

Real length_of_product(const Vector& a, const Vector& b) {
  return norm({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
}

/// Half angles of the discs of Sun and Earth as a spacecraft sees them, and how far apart they are.
struct Discs {
  Real sun, earth, apart;

  Discs(Earth& of, const Vector& x, Real time) {
    const Vector place = of.sun(time);
    const Vector way = {place[0] - x[0], place[1] - x[1], place[2] - x[2]};
    const Vector down = {-x[0], -x[1], -x[2]};
    sun = std::atan2(sun_radius, std::sqrt(dot(way, way) - sun_radius * sun_radius));
    const Real radius = of.radius();
    earth = std::atan2(radius, std::sqrt(std::max(Real(0), dot(x, x) - radius * radius)));
    apart = std::atan2(length_of_product(way, down), dot(way, down));
  }
  /// Above 0 where the discs do not touch, and where the Sun is not covered whole.
  Real outside() const { return apart - (sun + earth); }
  Real uncovered() const { return apart - (earth - sun); }

  /// The seen part of the disc of the Sun: what is covered is two sectors less a kite, whose half
  /// is a triangle of three known sides.
  Real seen() const {
    if (outside() >= 0) return 1;
    if (uncovered() <= 0) return 0;
    if (apart <= sun - earth) return 1 - (earth / sun) * (earth / sun);
    const Real s = (sun + earth + apart) / 2;
    const Real area = std::sqrt(s * (s - sun) * (s - earth) * (s - apart));
    const Real at_sun = std::atan2(2 * area, (sun * sun + apart * apart - earth * earth) / 2);
    const Real at_earth = std::atan2(2 * area, (earth * earth + apart * apart - sun * sun) / 2);
    const Real covered = sun * sun * at_sun + earth * earth * at_earth - 2 * area;
    return 1 - covered / (pi * sun * sun);
  }
};

/// A flight of the chief from a moment with a given light.
class ChiefFlight {
 public:
  ChiefFlight(const Field& field, const State& state, Real begin, const LightPiece& light)
      : earth_(field.earth), begin_(begin), light_(light), flight_(field, state, begin, 0x1p-57L) {}

  bool to(Real time) {
    earth_->light_by(&light_);
    return flight_.to(time - begin_);
  }
  Real time() const { return begin_ + flight_.time(); }
  Discs discs() const { return Discs(*earth_, flight_.state().x, time()); }
  const State& state() const { return flight_.state(); }
  Real pace() const { return flight_.pace(); }

 private:
  Earth* earth_;
  Real begin_;
  LightPiece light_;
  Flight flight_;
};

enum class Side { lit, partial, dark };

Side side_of(const Discs& discs) {
  if (discs.outside() > 0) return Side::lit;
  return discs.uncovered() > 0 ? Side::partial : Side::dark;
}

/// Narrows an edge down between two moments of a flight, of which the first is on this side.
Real edge_between(const ChiefFlight& before, Real end, Side side) {
  Real low = before.time(), high = end;
  for (int k = 0; k < 64 && std::abs(high - low) > 1e-12L; ++k) {
    ChiefFlight middle = before;
    const Real time = (low + high) / 2;
    if (!middle.to(time)) break;
    (side_of(middle.discs()) == side ? low : high) = time;
  }
  return high;
}

/// The moment between two at which the discs are nearest to each other.
Real nearest_between(const ChiefFlight& before, Real end) {
  Real low = before.time(), high = end;
  for (int k = 0; k < 80 && std::abs(high - low) > 1e-6L; ++k) {
    const Real first = low + (high - low) / 3, second = high - (high - low) / 3;
    ChiefFlight one = before, other = before;
    if (!one.to(first) || !other.to(second)) break;
    (one.discs().outside() < other.discs().outside() ? high : low) =
        one.discs().outside() < other.discs().outside() ? second : first;
  }
  return (low + high) / 2;
}

}  // namespace

Real LightPiece::at(Real time) const {
  if (!is_partial) return chebyshev[0];
  const Real x = (2 * time - from - to) / (to - from);
  Real next = 0, after = 0;
  for (int j = degree; j > 0; --j) {
    const Real value = chebyshev[j] + 2 * x * next - after;
    after = next;
    next = value;
  }
  return chebyshev[0] + x * next - after;
}

/// What is known of the light in one direction from the start.
struct Light::Frontier {
  Field field;
  State state;
  Real time, way;
  Side side;
  std::deque<LightPiece> pieces;  ///< those that flights hold stay in place
};

Light::Light(const Field& field, const State& chief) {
  const Side side = side_of(Discs(*field.earth, chief.x, 0));
  ahead_ = std::make_unique<Frontier>(Frontier{field, chief, 0, 1, side, {}});
  behind_ = std::make_unique<Frontier>(Frontier{field, chief, 0, -1, side, {}});
}

Light::~Light() = default;

const LightPiece& Light::at(Real time, Real way) {
  // A flight ends its steps at edges to within roundings.
  const Real there = time + way * 1e-9L;
  Frontier& frontier = there < 0 ? *behind_ : *ahead_;
  const auto reaches = [&] {
    if (frontier.pieces.empty()) return false;
    const LightPiece& last = frontier.pieces.back();
    return frontier.way > 0 ? there < last.to : there > last.from;
  };
  while (!reaches()) extend(frontier);
  return *std::find_if(frontier.pieces.begin(), frontier.pieces.end(), [&](const LightPiece& one) {
    return frontier.way > 0 ? there < one.to : there > one.from;
  });
}

/// Adds the piece from the frontier to the next edge; what has no edge for a day and a half, or
/// cannot be flown on, ends there.
void Light::extend(Frontier& frontier) {
  const Real way = frontier.way;
  const bool is_partial = frontier.side == Side::partial;
  LightPiece piece{frontier.time, frontier.time, false, {frontier.side == Side::lit ? 1.0L : 0.0L}};
  Side next = frontier.side;
  State state = frontier.state;
  for (int round = 0; round < (is_partial ? 2 : 1); ++round) {
    ChiefFlight flight(frontier.field, frontier.state, frontier.time, piece);
    const Real begun = flight.time();
    Real end = begun + way * (is_partial ? 86400 : 129600);
    const Real longest = flight.pace() / (is_partial ? 1000 : 30);
    Real before_last = 1e9L;
    ChiefFlight earlier = flight;
    while ((end - flight.time()) * way > 0) {
      const ChiefFlight before = flight;
      const Real step =
          std::min({is_partial ? longest : flight.pace() / 30, std::abs(end - flight.time())});
      Real there = flight.time() + way * step;
      if (!flight.to(there)) {
        end = before.time() + way * 1e9L;
        break;
      }
      Side now = side_of(flight.discs());
      // A passage that only touches the shadow lies between two looks.
      if (now == Side::lit && frontier.side == Side::lit) {
        const Real distance = flight.discs().outside(), middle = before.discs().outside();
        if (middle < before_last && middle <= distance && middle < 0.1L) {
          const Real nearest = nearest_between(earlier, there);
          ChiefFlight touching = earlier;
          if (touching.to(nearest) && side_of(touching.discs()) != Side::lit) {
            flight = earlier;
            there = nearest;
            now = Side::partial;
            end = edge_between(earlier, there, frontier.side);
            break;
          }
        }
        before_last = middle;
      }
      earlier = before;
      // What has just been entered may still count as the other side.
      if (now != frontier.side && std::abs(there - begun) > 1e-6L) {
        end = edge_between(before, there, frontier.side);
        break;
      }
    }
    piece.from = std::min(begun, end);
    piece.to = std::max(begun, end);
    const bool is_known = std::abs(end - begun) < 1e8L;
    if (is_partial && is_known) {
      std::array<Real, degree + 1> seen;
      ChiefFlight along(frontier.field, frontier.state, frontier.time, piece);
      for (int k = 0; k <= degree; ++k) {
        const Real x = -std::cos(pi * k / degree);  // away from the frontier
        along.to(begun + (end - begun) * (1 + x) / 2);
        seen[k] = along.discs().seen();
      }
      std::array<Real, degree + 1> series{};
      for (int j = 0; j <= degree; ++j) {
        for (int k = 0; k <= degree; ++k) {
          const Real half =
              (k == 0 || k == degree ? 0.5L : 1.0L) * (j == 0 || j == degree ? 0.5L : 1.0L);
          // Of the abscissa that rises with the time.
          const Real angle = way > 0 ? pi - pi * k / degree : pi * k / degree;
          series[j] += 2 * half * seen[k] * std::cos(j * angle) / degree;
        }
      }
      piece.chebyshev = series;
      piece.is_partial = true;
    }
    ChiefFlight last(frontier.field, frontier.state, frontier.time, piece);
    if (!is_known || !last.to(end)) {
      (way > 0 ? piece.to : piece.from) = way * 1e12L;
      frontier.pieces.push_back(piece);
      return;
    }
    state = last.state();
    ChiefFlight beyond = last;
    beyond.to(end + way * 1e-6L);
    next = side_of(beyond.discs());
  }
  frontier.pieces.push_back(piece);
  frontier.state = state;
  frontier.time = way > 0 ? piece.to : piece.from;
  frontier.side = next;
}

}  // namespace attack
