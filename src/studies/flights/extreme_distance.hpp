#pragma once

#include <array>
#include <limits>
#include <vector>

#include "flight_arcs.hpp"

namespace hamjet {

/// A place as series in the share of an arc's span.
using ArcCurve = std::array<Series<double>, 3>;

/// The position of a spacecraft from the centre, and that of one from another, along inertial axes.
ArcCurve place_along(const FlightArc& arc, std::size_t craft);
ArcCurve separation_along(const FlightArc& arc, std::size_t from, std::size_t to);
/// That along R, T, N of the one from which it is told. Throws Error(numerical) where it has no
/// orbital plane.
ArcCurve rtn_separation_along(const FlightArc& arc, std::size_t from, std::size_t to);

/// Where the length of a vector is least, or greatest, along the arcs of a flight. On every part of
/// an arc the square of the length is a parabola and a rest of which the sum of the magnitudes is a
/// bound; parts are halved until what is found is better than anything that bound lets others hide,
/// to 1e-12 of the square and rounding, 1e-14 of the arc's greatest.
class ExtremeDistance {
 public:
  enum class Kind { least, greatest };
  explicit ExtremeDistance(Kind kind) : sign_(kind == Kind::least ? 1 : -1) {}

  /// Looks at one arc; whether the extreme of all so far lies on it.
  bool add(const FlightArc& arc, const ArcCurve& curve);

  double distance() const { return distance_; }
  double time() const { return time_; }    ///< canonical
  double share() const { return share_; }  ///< of the arc on which it lies

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
