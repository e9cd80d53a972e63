#pragma once

#include <optional>
#include <string>
#include <vector>

#include "companion_flow.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The least of |(R/a, T/b, N/c)| along the flight of a deputy, with the semi-axes of the scene's
/// `keep_out_m`; below 1 the deputy enters the ellipsoid. The chief starts in `chief` and the
/// deputy with this canonical deviation from it, at `start_time` of the system's clock; both fly
/// for a time without impulses. Nothing between the steps of the flight is missed, see
/// ExtremeDistance. Throws as fly_arcs, and Error(numerical) for a chief without an orbital plane.
double keep_out_ratio(const FlownTogether& both, const std::vector<double>& chief,
                      const std::vector<double>& deviation, const ClockTime& start_time,
                      double time);

/// Collects the reasons, if any, why the scene's limits forbid a deputy's trajectory: it enters the
/// ellipsoid, or passes below the surface.
class WayLimits {
 public:
  explicit WayLimits(const Scene& scene);
  /// Examines a leg of the trajectory, from the chief's state and the deputy's deviation from it at
  /// `start_time` of the system's clock.
  void fly(const std::vector<double>& chief, const std::vector<double>& deviation,
           const ClockTime& start_time, double time);
  /// The reason found over all legs; empty if there is none.
  std::string forbidden() const;

 private:
  FlownTogether both_;
  std::optional<double> surface_;
  double ratio_;
  double lowest_;
};

}  // namespace hamjet
