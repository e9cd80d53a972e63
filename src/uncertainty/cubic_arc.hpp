#pragma once

#include <array>
#include <vector>

#include "../algebra/hermite_cubic.hpp"
#include "relative_paths.hpp"

namespace hamjet {

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
