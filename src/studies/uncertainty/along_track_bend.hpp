#pragma once

#include <array>
#include <optional>
#include <string>

#include "../../uncertainty/relative_paths.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {

/// A Gaussian in positions spreads along a straight line, and the orbit bends away from this line
/// by
///
///   T^2 / (2 r)
///
/// at a deviation T along the track, where r is the distance from the centre.
struct AlongTrackBend {
  /// Standard deviations along the track of each spacecraft that is Gaussian in positions.
  std::array<double, 2> deviations{};
  /// The bend at the given deviations plus these, for both spacecraft together.
  double bend = 0;
  double radial = 0;  ///< standard deviation along R if that along T is known, for both together

  /// Whether the bend is not small compared to the uncertainty across the track and to a given
  /// length: it is more than a tenth of both.
  bool is_large_beside(double length) const;
};

/// The bend for both spacecraft at the epoch, about this vector of standard normal numbers.
AlongTrackBend along_track_bend(const EncounterProblem& problem, const EncounterDeviation& about);

/// The shortest deviation whose linear paths meet at a closest approach of the means: the
/// components of the relative position across the relative velocity vanish.
EncounterDeviation deviation_of_meeting(const LinearRelativeState& at_approach);

/// A warning sentence for people; no value if the bend is small compared to the length.
std::optional<std::string> along_track_warning(const AlongTrackBend& bend, double length,
                                               const std::array<std::string, 2>& names,
                                               const std::string& what, const MetricUnits& units);

}  // namespace hamjet
