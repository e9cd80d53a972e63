#pragma once

#include <memory>

#include "hamjet/detail/algebra/double_double.hpp"
#include "hamjet/detail/dynamics/local_field.hpp"
#include "spherical_harmonic_coefficients.hpp"

namespace hamjet {

/// The potential of a body in axes that are fixed to it, z along the axis of the harmonics,
///
///   U = mu/r sum over n, m of (R/r)^n P_nm(sin phi) [C_nm cos(m lambda) + S_nm sin(m lambda)],
///
/// P_nm and the coefficients fully normalised, C_00 the factor of the central term. All units are the
/// caller's.
class SphericalHarmonicField final : public LocalField {
 public:
  /// Beyond this degree the harmonics could overflow near the poles.
  static constexpr int highest_degree = 600;

  /// Throws Error(usage) unless mu and radius are positive and finite, the coefficients finite, and
  /// the degree at most highest_degree.
  SphericalHarmonicField(double mu, double radius, SphericalHarmonicCoefficients coefficients);
  ~SphericalHarmonicField() override;

  double mu() const { return mu_; }
  double radius() const { return radius_; }
  const SphericalHarmonicCoefficients& coefficients() const { return coefficients_; }

  void expand(std::size_t count, const double* x, const double* y, const double* z, int degree,
              double* out) const override;
  void expand(std::size_t count, const Extended* x, const Extended* y, const Extended* z,
              int degree, Extended* out) const override;
  void expand(std::size_t count, const DoubleDouble* x, const DoubleDouble* y,
              const DoubleDouble* z, int degree, DoubleDouble* out) const override;
  int waves_on_a_circle() const override;
  double multiply_adds(int degree) const override;

 private:
  struct Tables;

  template <class Real>
  void expand_in(std::size_t count, const Real* x, const Real* y, const Real* z, int degree,
                 Real* out) const;

  double mu_;
  double radius_;
  SphericalHarmonicCoefficients coefficients_;
  std::unique_ptr<Tables> tables_;
};

}  // namespace hamjet
