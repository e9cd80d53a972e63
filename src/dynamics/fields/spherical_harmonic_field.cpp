#include "spherical_harmonic_field.hpp"

#include <fmt/format.h>

#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "hamjet/error.hpp"
#include "harmonic_sums.hpp"
#include "points_in_packs.hpp"

namespace hamjet {

struct SphericalHarmonicField::Tables {
  explicit Tables(const SphericalHarmonicCoefficients& field) : in_double(field) {}

  /// References alone need the other two.
  template <class Real>
  const HarmonicSums<Real>& of(const SphericalHarmonicCoefficients& field) {
    if constexpr (std::is_same_v<Real, double>) {
      return in_double;
    } else if constexpr (std::is_same_v<Real, DoubleDouble>) {
      std::call_once(is_double_double_made, [&] { in_double_double.emplace(field); });
      return *in_double_double;
    } else {
      std::call_once(is_extended_made, [&] { in_extended.emplace(field); });
      return *in_extended;
    }
  }

  HarmonicSums<double> in_double;
  std::once_flag is_double_double_made;
  std::optional<HarmonicSums<DoubleDouble>> in_double_double;
  std::once_flag is_extended_made;
  std::optional<HarmonicSums<Extended>> in_extended;
};

SphericalHarmonicField::SphericalHarmonicField(double mu, double radius,
                                               SphericalHarmonicCoefficients coefficients)
    : mu_(mu), radius_(radius), coefficients_(std::move(coefficients)) {
  const auto is_positive = [](double value) { return value > 0 && std::isfinite(value); };
  if (!is_positive(mu) || !is_positive(radius)) {
    throw Error(ErrorKind::usage,
                fmt::format("the gravity constant and the radius of a field must be positive, got "
                            "{} and {}",
                            mu, radius));
  }
  if (coefficients_.degree() > highest_degree) {
    throw Error(ErrorKind::usage, fmt::format("the degree of a field must be at most {}, got {}",
                                              highest_degree, coefficients_.degree()));
  }
  for (int n = 0; n <= coefficients_.degree(); ++n) {
    for (int m = 0; m <= n; ++m) {
      if (!std::isfinite(coefficients_.C(n, m)) || !std::isfinite(coefficients_.S(n, m))) {
        throw Error(ErrorKind::usage,
                    fmt::format("the coefficients of degree {} and order {} are not finite", n, m));
      }
    }
  }
  tables_ = std::make_unique<Tables>(coefficients_);
}

SphericalHarmonicField::~SphericalHarmonicField() = default;

template <class Real>
void SphericalHarmonicField::expand_in(std::size_t count, const Real* x, const Real* y,
                                       const Real* z, int degree, Real* out) const {
  const HarmonicSums<Real>& sums = tables_->of<Real>(coefficients_);
  for_points_in_packs<Real, 3>(
      count, {x, y, z}, local_field_size(degree), out, [&]<class P>(const std::array<P, 3>& r, P* c) {
        using hamjet::sqrt;
        const P inverse = P(Real(1)) / sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        const std::array<P, 3> unit = {r[0] * inverse, r[1] * inverse, r[2] * inverse};
        sums.expand(unit, P(Real(radius_)) * inverse, degree, c);
        P scale = P(Real(mu_)) * inverse;
        for (int n = 0; n <= degree; ++n) {
          for (std::size_t k = local_first(n); k < local_first(n + 1); ++k) c[k] *= scale;
          scale *= inverse;
        }
      });
}

void SphericalHarmonicField::expand(std::size_t count, const double* x, const double* y,
                                    const double* z, int degree, double* out) const {
  expand_in(count, x, y, z, degree, out);
}
void SphericalHarmonicField::expand(std::size_t count, const Extended* x, const Extended* y,
                                    const Extended* z, int degree, Extended* out) const {
  expand_in(count, x, y, z, degree, out);
}
void SphericalHarmonicField::expand(std::size_t count, const DoubleDouble* x,
                                    const DoubleDouble* y, const DoubleDouble* z, int degree,
                                    DoubleDouble* out) const {
  expand_in(count, x, y, z, degree, out);
}

int SphericalHarmonicField::waves_on_a_circle() const {
  for (int n = coefficients_.degree(); n > 0; --n) {
    for (int m = 0; m <= std::min(n, coefficients_.order()); ++m) {
      if (coefficients_.C(n, m) != 0 || coefficients_.S(n, m) != 0) return n;
    }
  }
  return 0;
}

double SphericalHarmonicField::multiply_adds(int degree) const {
  return HarmonicSums<double>::multiply_adds(coefficients_.degree(), coefficients_.order(), degree);
}

}  // namespace hamjet
