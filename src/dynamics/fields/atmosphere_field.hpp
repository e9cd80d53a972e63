#pragma once

#include <cstddef>

#include "density_profile.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/double_double.hpp"
#include "hamjet/detail/dynamics/local_field.hpp"
#include "reference_ellipsoid.hpp"

namespace hamjet {

/// The density of an atmosphere that turns with its planet,
///
///   U(x, y, z) = factor * rho(h) ,
///
/// h the geodetic height of the point above an ellipsoid, in axes that are fixed to it. Lengths are
/// in a unit of the caller's.
class AtmosphereField final : public LocalField {
 public:
  /// `length_km` is the unit of length in km, and `factor` what densities in kg/m^3 are multiplied
  /// by. Throws Error(usage) unless both and the ellipsoid's radius are positive and finite, its
  /// flattening at least 0 and below 1/2.
  AtmosphereField(DensityProfile profile, double length_km, double factor = 1,
                  const ReferenceEllipsoid& ellipsoid = {});

  const DensityProfile& profile() const { return profile_; }
  const ReferenceEllipsoid& ellipsoid() const { return ellipsoid_; }
  double length_km() const { return length_km_; }
  double factor() const { return factor_; }

  /// The height of a point in km; NaN near the centre, where it is not unique.
  double height_km(double x, double y, double z) const;

  /// Coefficients are not finite where the height is not unique, and more than 25 km below the
  /// lowest height of the table.
  void expand(std::size_t count, const double* x, const double* y, const double* z, int degree,
              double* out) const override;
  void expand(std::size_t count, const Extended* x, const Extended* y, const Extended* z,
              int degree, Extended* out) const override;
  void expand(std::size_t count, const DoubleDouble* x, const DoubleDouble* y,
              const DoubleDouble* z, int degree, DoubleDouble* out) const override;
  /// Along a circle the density has no short waves.
  int waves_on_a_circle() const override { return 0; }
  double multiply_adds(int degree) const override;

 private:
  template <class Real>
  void expand_in(std::size_t count, const Real* x, const Real* y, const Real* z, int degree,
                 Real* out) const;

  DensityProfile profile_;
  ReferenceEllipsoid ellipsoid_;
  double length_km_;
  double factor_;
};

}  // namespace hamjet
