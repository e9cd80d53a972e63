#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Where the air ends the orbit of a spacecraft.
struct Decay {
  std::string_view spacecraft;  ///< "chief" or "deputy"
  double time_s = 0;            ///< from the scene's start
  double height_km = 0;         ///< above the ellipsoid, at which it counts as decayed
};

/// The spacecraft of a scene that come below 100 km, or below a table of densities that begins
/// higher, before the scene's last time. Each is flown; one whose osculating perigee's air could
/// not lower it by 5 km in the time is taken for safe. None for scenes without air.
std::vector<Decay> find_decays(const Scene& scene);

/// The height of the osculating perigee of a state (q, p) above the equator's radius, in km, at
/// most the height above the ellipsoid; no value for an orbit that is no ellipse, and for models
/// other than the Earth's.
std::optional<double> perigee_height_km(const Scene& scene, const std::vector<double>& state);

}  // namespace hamjet
