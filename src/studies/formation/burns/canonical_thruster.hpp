#pragma once

#include <limits>

#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// A spacecraft of less mass than this share of its first is none, and its last acceleration is
/// beyond what a flight follows.
inline constexpr double least_share_of_mass = 1e-3;

/// The mean time of the change of a burn from mass 1 on, in parts of the time that would burn all
/// of it: the time is 1 - m, the change is x = -ln m of the exhaust's speed, and the mean is
/// 1 - (1 - exp(-x)) / x.
double mean_share(double x);

/// A thruster in canonical units; masses are parts of the full spacecraft.
struct CanonicalThruster {
  double acceleration = 0;  ///< the acceleration of the full spacecraft
  /// Speed of the exhaust; infinite if the mass does not fall.
  double exhaust = std::numeric_limits<double>::infinity();

  CanonicalThruster(const ThrusterSettings& settings, const MetricUnits& units);
  bool mass_falls() const { return exhaust < std::numeric_limits<double>::infinity(); }
  /// How long a velocity change takes from a mass on, by the rocket equation.
  double length(double change, double mass) const;
  double mass_after(double change, double mass) const;
  /// How long after its beginning the mean time of a burn's change is, and how fast this grows with
  /// the change. As the thrust grows, such a burn acts as an impulse at that time up to the square
  /// of its length.
  double centre(double change, double mass) const;
  double centre_rate(double change, double mass) const;
};

}  // namespace hamjet
