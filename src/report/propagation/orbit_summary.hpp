#pragma once

#include <optional>
#include <string>

#include "hamjet/dynamics/osculating_elements.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// A point of the osculating orbit.
struct OrbitPoint {
  double distance_km = 0;  ///< from the centre
  double speed_km_s = 0;   ///< infinite at the centre
};

/// What a scene's nominal and duration mean for whoever flies it: the Kepler orbit that osculates
/// at the start.
struct OrbitSummary {
  OrbitPoint start;
  OrbitPoint perigee;
  std::optional<OrbitPoint> apogee;  ///< the apogee of an ellipse
  double eccentricity = 0;
  double inclination_deg = 0;
  std::optional<double> period_s;     ///< the period of an ellipse
  std::optional<double> revolutions;  ///< periods in the duration, whatever its sign
  double lowest_km = 0;               ///< smallest distance from the centre within the duration
  /// Mean elements of the start, with the mean anomaly, where J2 makes them others than the
  /// osculating ones and the theory holds; what it leaves out is some `mean_truncation` of them.
  std::optional<OsculatingElements> mean_elements;
  double mean_anomaly_deg = 0;
  double mean_truncation = 0;
  /// J2 R^2/a, several times of which zonal coefficients move heights by; absent without J2.
  std::optional<double> perturbation_km;
  /// Of the scene, or of the equator of the body whose mu the scene has.
  std::optional<double> surface_km;

  bool is_below_surface() const { return surface_km && lowest_km < *surface_km; }
};

/// The summary of an orbit; none for other models.
std::optional<OrbitSummary> orbit_summary(const Scene& scene);

/// The lines of `hamjet check` that say it.
std::string orbit_text(const OrbitSummary& orbit);

}  // namespace hamjet::io
