#pragma once

#include <array>
#include <vector>

#include "relative_paths.hpp"

namespace hamjet {

/// Factors of (position, velocity) at the start and at the end of an interval in the cubic through
/// them, and in its derivative.
struct HermiteWeights {
  std::array<double, 4> position;
  std::array<double, 4> velocity;
};

/// At the part s, from 0 to 1, of an interval of a length:
///
///   (1 + 2 s) (1 - s)^2,  s (1 - s)^2 h,  s^2 (3 - 2 s),  s^2 (s - 1) h .
inline HermiteWeights hermite_weights(double length, double s) {
  const double r = 1 - s;
  return {{(1 + 2 * s) * r * r, s * r * r * length, s * s * (3 - 2 * s), -s * s * r * length},
          {-6 * s * r / length, r * (1 - 3 * s), 6 * s * r / length, s * (3 * s - 2)}};
}

/// The cubic between two linear states, an interval of a length apart.
LinearRelativeState between(const LinearRelativeState& start, const LinearRelativeState& end,
                            double length, double part);

/// The square of the distance along a cubic arc, a polynomial of degree 6 in the part of the
/// interval. Between its coefficients in Bernstein's basis it stays, of which all is told.
class SquaredDistance {
 public:
  /// Of positions and velocities (three numbers each) at both ends of an interval of a length.
  SquaredDistance(const std::array<double, 6>& start, const std::array<double, 6>& end,
                  double length);

  /// At the start.
  double first() const { return c_[0]; }
  /// Below which it nowhere is.
  double lower_bound() const;

  /// Puts the parts of the interval at which it falls below a square, which it passes there, behind
  /// the list.
  void entries(double square, std::vector<double>& parts) const;
  /// The least value in the interval, not below 0; where nothing is below `best`, that. To a part
  /// of 1e-12 of it, or 1e-15 of the largest.
  double least(double best) const;

  double at(double part) const;

 private:
  explicit SquaredDistance(const std::array<double, 7>& c) : c_(c) {}
  std::array<SquaredDistance, 2> halves() const;
  void entries(double square, double from, double to, std::vector<double>& parts) const;
  double least(double best, int depth) const;

  std::array<double, 7> c_;
};

}  // namespace hamjet
