#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/scene.hpp"
#include "periodic_orbit.hpp"

namespace hamjet {

/// A periodic orbit of a scene, or the family from it.
struct PeriodicStudy {
  Scene scene;
  PeriodicFamily family;  ///< the family; it has one member without `[periodic.family]`
  /// Of some members, the first two coordinates along a turn; with one degree of freedom, the
  /// coordinate and its momentum. In the units that the user is told.
  struct Path {
    std::size_t member = 0;
    std::vector<std::pair<double, double>> points;
  };
  std::vector<Path> paths;

  /// The factor by which a quantity of the scene's canonical numbers is told.
  double told_factor(const OrbitQuantity& quantity) const;
};

/// The quantity of a name in `[periodic]`.
OrbitQuantity orbit_quantity(const Scene& scene, const std::string& name);

/// Finds the scene's periodic orbit, and follows its family. A family that ends before its last
/// member says so in its result. Throws Error(scene) for a scene without such a table or method,
/// Error(numerical) where no orbit is found; and as integrate_gauss.
PeriodicStudy study_periodic(const Scene& scene, const ProgressCallback& progress = {});

}  // namespace hamjet
