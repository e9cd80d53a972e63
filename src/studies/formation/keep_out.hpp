#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The least of |(R/a, T/b, N/c)| along the flight of a deputy, with the semi-axes of the scene's
/// `keep_out_m`: below 1 it enters the ellipsoid. Both start now, the chief in `chief`, the deputy
/// with this deviation from it (canonical), and fly for a time without impulses. No look between
/// the steps of the flight is left out, see ExtremeDistance. Throws as fly_arcs, and
/// Error(numerical) for a chief without an orbital plane.
double keep_out_ratio(const Scene& scene, const std::vector<double>& chief,
                      const std::vector<double>& deviation, double time);

/// What forbids a deputy to fly on from a state for a time, if the scene's limits do: that it
/// enters the ellipsoid, or passes below the surface; empty: nothing does.
class WayLimits {
 public:
  explicit WayLimits(const Scene& scene);
  /// Looks at a leg of the way, from the chief's state and the deputy's deviation from it.
  void fly(const std::vector<double>& chief, const std::vector<double>& deviation, double time);
  /// What was found over all legs.
  std::string forbidden() const;

 private:
  const Scene& scene_;
  std::optional<double> surface_;
  double ratio_;
  double lowest_;
};

}  // namespace hamjet
