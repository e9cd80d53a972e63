#pragma once

#include <array>
#include <vector>

#include "../algebra/hermite_cubic.hpp"
#include "relative_paths.hpp"

namespace hamjet {

/// The cubic arc between two linear states that are an interval of this length apart.
LinearRelativeState between(const LinearRelativeState& start, const LinearRelativeState& end,
                            double length, double part);

/// The square of the distance along a cubic arc: a polynomial of degree 6 in the fraction of the
/// interval. It stays between the least and the greatest of its coefficients in Bernstein's basis,
/// from which all bounds below follow.
class SquaredDistance {
 public:
  /// The positions and velocities (three numbers each) at both ends of an interval of a length.
  SquaredDistance(const std::array<double, 6>& start, const std::array<double, 6>& end,
                  double length);

  /// The value at the start.
  double first() const { return c_[0]; }
  /// A bound below which the square of the distance nowhere falls.
  double lower_bound() const;

  /// Appends to the list the fractions of the interval at which the squared distance falls through
  /// this square.
  void entries(double square, std::vector<double>& parts) const;
  /// Whether the arc comes nearer than this at any fraction of it.
  bool enters(double square) const { return enters(square, 1); }
  /// The least value in the interval, not below 0, or `best` where nothing is below `best`. It is
  /// accurate to 1e-12 of itself, or 1e-15 of the largest value.
  double least(double best) const;

  double at(double part) const;

 private:
  explicit SquaredDistance(const std::array<double, 7>& c) : c_(c) {}
  std::array<SquaredDistance, 2> halves() const;
  void entries(double square, double from, double to, std::vector<double>& parts) const;
  bool enters(double square, double length) const;
  /// How often the coefficients cross a value, one after the other.
  int crossings(double square) const;
  double least(double best, int depth) const;

  std::array<double, 7> c_;
};

}  // namespace hamjet
