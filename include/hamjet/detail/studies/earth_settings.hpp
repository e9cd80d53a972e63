#pragma once

#include <string>
#include <vector>

#include "hamjet/detail/studies/fields.hpp"

namespace hamjet {

/// What the IERS tells of one day: the day since 1970-01-01, UT1 - UTC in seconds, x and y of the
/// pole, dX and dY in seconds of arc, and whether it is predicted.
struct OrientationRow {
  long day = 0;
  double ut1_minus_utc_s = 0;
  double pole_x_arcsec = 0;
  double pole_y_arcsec = 0;
  double offset_x_arcsec = 0;
  double offset_y_arcsec = 0;
  bool is_predicted = false;
};

/// The model `earth`: the forces that act, and when and how the Earth stands.
struct EarthSettings {
  int degree = 20;
  int order = 20;
  /// Fully normalised coefficients C_nm and S_nm, degree by degree, (n, m) at n (n + 1)/2 + m.
  std::vector<double> cosines;
  std::vector<double> sines;
  bool has_sun = true;
  bool has_moon = true;
  double mu_sun_km3_s2 = 132712440041.27942;  ///< of DE440 (Park et al., Astron. J. 161:105, 2021)
  double mu_moon_km3_s2 = 4902.800118;        ///< likewise
  std::string epoch_tt;          ///< the moment at which the scene's clock is 0, ISO 8601 in TT
  std::string orientation_file;  ///< as in the scene; empty without one
  std::vector<OrientationRow> orientation;  ///< the days of the span, from the file
  /// The axes in which the scene gives its orbits; all are flown along those of GCRF.
  std::string axes = "GCRF";
  /// The span in which the scene flies, in seconds from the epoch.
  double first_s = 0;
  double last_s = 0;
};

HAMJET_FIELDS(OrientationRow, day, ut1_minus_utc_s, pole_x_arcsec, pole_y_arcsec, offset_x_arcsec,
              offset_y_arcsec, is_predicted)
HAMJET_FIELDS(EarthSettings, degree, order, cosines, sines, has_sun, has_moon, mu_sun_km3_s2,
              mu_moon_km3_s2, epoch_tt, orientation_file, orientation, axes, first_s, last_s)

}  // namespace hamjet
