#include "earth_system.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "../dynamics/fields/point_mass_field.hpp"
#include "../dynamics/fields/spherical_harmonic_field.hpp"
#include "hamjet/astronomy/body_position.hpp"
#include "hamjet/astronomy/earth_rotation.hpp"
#include "hamjet/dynamics/earth_gravity.hpp"

namespace hamjet {
namespace {

SphericalHarmonicCoefficients coefficients_of(const EarthSettings& earth) {
  SphericalHarmonicCoefficients result(earth.degree, earth.order);
  for (int n = 0; n <= earth.degree; ++n) {
    for (int m = 0; m <= std::min(n, earth.order); ++m) {
      result.C(n, m) = earth.field->C(n, m);
      result.S(n, m) = earth.field->S(n, m);
    }
  }
  return result;
}

}  // namespace

DynamicalSystem earth_system(const SystemSettings& settings, double canonical_radius) {
  const EarthSettings& earth = settings.earth.value();
  const Extended length_km = Extended(settings.radius_km) / canonical_radius;
  const Extended time_s = sqrt(length_km * length_km * length_km / settings.mu_km3_s2);
  const Instant epoch{parse_epoch(earth.epoch_tt).value()};
  const double first = convert<double>(Extended(earth.first_s) / time_s);
  const double last = convert<double>(Extended(earth.last_s) / time_s);
  GravityOfTurningBody gravity;
  gravity.potential =
      std::make_shared<const SphericalHarmonicField>(1.0, canonical_radius, coefficients_of(earth));
  gravity.axes =
      std::make_shared<const EarthRotation>(epoch, time_s, first, last, earth.orientation);
  const auto add = [&](bool acts, PerturbingBody body, double mu_km3_s2) {
    if (!acts) return;
    const double mu = mu_km3_s2 / settings.mu_km3_s2;
    gravity.others.push_back({mu, std::make_shared<const PointMassField>(mu),
                              std::make_shared<const BodyPosition>(
                                  body, epoch, time_s, convert<double>(length_km), first, last)});
  };
  add(earth.has_sun, PerturbingBody::sun, earth.mu_sun_km3_s2);
  add(earth.has_moon, PerturbingBody::moon, earth.mu_moon_km3_s2);
  return earth_gravity(gravity);
}

}  // namespace hamjet
