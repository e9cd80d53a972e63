#pragma once

#include <memory>
#include <string>

#include "hamjet/detail/studies/fields.hpp"

namespace hamjet {

class EarthOrientation;
class SphericalHarmonicCoefficients;

/// The model `earth`: the forces that act, and when and how the Earth stands.
struct EarthSettings {
  int degree = 20;
  int order = 20;
  std::shared_ptr<const SphericalHarmonicCoefficients> field;  ///< of at least degree and order
  bool has_sun = true;
  bool has_moon = true;
  double mu_sun_km3_s2 = 132712440041.27942;  ///< of DE440 (Park et al., Astron. J. 161:105, 2021)
  double mu_moon_km3_s2 = 4902.800118;        ///< likewise
  std::string epoch_tt;          ///< the moment at which the scene's clock is 0, ISO 8601 in TT
  std::string orientation_file;  ///< as in the scene; empty without one
  std::string orientation_checksum;                     ///< of the file's content
  std::shared_ptr<const EarthOrientation> orientation;  ///< null without a file
  /// The axes in which the scene gives its orbits; all are flown along those of GCRF.
  std::string axes = "GCRF";
  /// The span in which the scene flies, in seconds from the epoch.
  double first_s = 0;
  double last_s = 0;
};

HAMJET_FIELDS(EarthSettings, degree, order, field, has_sun, has_moon, mu_sun_km3_s2,
              mu_moon_km3_s2, epoch_tt, orientation_file, orientation_checksum, orientation, axes,
              first_s, last_s)

}  // namespace hamjet
