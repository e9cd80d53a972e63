#pragma once

#include <array>
#include <optional>
#include <string>

#include "../../uncertainty/relative_paths.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {

/// A Gaussian in positions spreads along a straight line, and the orbit bends away from that: by
///
///   T^2 / (2 r)
///
/// at a deviation T along the track, r from the centre.
struct AlongTrackBend {
  std::array<double, 2> deviations{};  ///< standard deviations along the track, of both spacecraft
  /// At the deviations that are asked about, with their standard deviations, of both together.
  double bend = 0;
  double radial = 0;  ///< standard deviation along R where that along T is known, of both together

  /// Whether the bend is not small beside what is uncertain across the track and a length that
  /// matters: by more than a tenth of both.
  bool is_large_beside(double length) const;
};

/// Of both spacecraft at the epoch, about so many standard normal numbers.
AlongTrackBend along_track_bend(const EncounterProblem& problem, const EncounterDeviation& about);

/// The shortest deviation whose linear path meets at a closest approach of the means: the
/// components of the relative position across the relative velocity vanish.
EncounterDeviation deviation_of_meeting(const LinearRelativeState& at_approach);

/// A sentence for people; none where the bend is small beside the length.
std::optional<std::string> along_track_warning(const AlongTrackBend& bend, double length,
                                               const std::array<std::string, 2>& names,
                                               const std::string& what, const MetricUnits& units);

}  // namespace hamjet
