#pragma once

#include <array>
#include <limits>
#include <vector>

#include "flight_arcs.hpp"

namespace hamjet {

/// A position as series in the fraction of an arc's span that has passed.
using ArcCurve = std::array<Series<double>, 3>;

/// The position of a spacecraft relative to the centre, and that of one spacecraft relative to
/// another, along inertial axes.
ArcCurve place_along(const FlightArc& arc, std::size_t craft);
ArcCurve separation_along(const FlightArc& arc, std::size_t from, std::size_t to);
/// The relative position along R, T, N of the second spacecraft. Throws Error(numerical) if that
/// one has no orbital plane.
ArcCurve rtn_separation_along(const FlightArc& arc, std::size_t from, std::size_t to);

/// The least, or greatest, length of a vector along the arcs of a flight. On every part of an arc
/// the square of the length is a parabola plus a rest, for which the sum of the magnitudes is a
/// bound. Parts are halved until the value found is better than anything that the bound still
/// allows, to 1e-12 of the square plus rounding, 1e-14 of the arc's greatest square.
class ExtremeDistance {
 public:
  enum class Kind { least, greatest };
  explicit ExtremeDistance(Kind kind) : sign_(kind == Kind::least ? 1 : -1) {}

  /// Examines one arc; returns whether the extreme of all arcs so far lies on it.
  bool add(const FlightArc& arc, const ArcCurve& curve);

  double distance() const { return distance_; }
  double time() const { return time_; }    ///< in canonical units
  double share() const { return share_; }  ///< fraction of the span of the arc on which it lies

 private:
  double length_at(const ArcCurve& curve, double share) const;
  bool keep_better(const FlightArc& arc, const ArcCurve& curve, double share);

  double sign_;
  bool is_started_ = false;
  double distance_ = 0;
  double time_ = 0;
  double share_ = 0;
};

}  // namespace hamjet
