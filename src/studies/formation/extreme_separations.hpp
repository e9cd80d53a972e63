#pragma once

#include "../flights/extreme_distance.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The distance of a deputy from its chief. It is computed in this function alone, so that all
/// output has the same digits.
double separation_m(const RelativeState& state);

/// The relative state of a deputy at a time.
struct SeparationAt {
  double time = 0;  ///< in canonical units
  RelativeState state;
};

/// The states in which a deputy is nearest to its chief and farthest from it.
struct ExtremeSeparations {
  SeparationAt nearest;
  SeparationAt farthest;
};

/// Finds the extremes along the arcs of a flight on which the chief is the first spacecraft and the
/// deputy the second; states are in `frame`. Nothing between the steps of the flight is missed, see
/// ExtremeDistance.
class SeparationExtremes {
 public:
  SeparationExtremes(const Scene& scene, RelativeFrame frame);
  void add(const FlightArc& arc);
  const ExtremeSeparations& found() const { return found_; }

 private:
  MetricUnits units_;
  RelativeFrame frame_;
  ExtremeDistance least_{ExtremeDistance::Kind::least};
  ExtremeDistance greatest_{ExtremeDistance::Kind::greatest};
  ExtremeSeparations found_;
};

/// The extremes for a deputy that starts with this canonical deviation from the scene's chief and
/// flies for a time without impulses. Throws as fly_arcs.
ExtremeSeparations extreme_separations(const Scene& scene, const std::vector<double>& deviation,
                                       RelativeFrame frame, double time);

}  // namespace hamjet
