// What the Earth leaves of the Sun's light along the orbit of a chief, a function of the time
// alone, as hamjet's pages define it: in a penumbra the polynomial of degree 16 through the seen
// part of the disc at the extrema of Chebyshev's polynomial. How much is seen is a question about
// two cones here, and found along flights of this folder.
#pragma once

#include <array>
#include <deque>
#include <memory>

#include "earth_forces.hpp"

namespace attack {

struct Field;
struct State;

/// The light between two edges; without a penumbra it is the first coefficient.
struct LightPiece {
  Real from, to;
  bool is_partial;
  std::array<Real, 17> chebyshev;

  Real at(Real time) const;
};

class Light {
 public:
  Light(const Field& field, const State& chief);
  ~Light();

  /// The light at a time, on the side to which a flight goes.
  const LightPiece& at(Real time, Real way);

 private:
  struct Frontier;

  void extend(Frontier& frontier);

  std::unique_ptr<Frontier> ahead_, behind_;
};

}  // namespace attack
