#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// How large the deviations of two spacecraft may be if an ellipsoid about the first one is to stay
/// free of the second.
struct KeepOutMargin {
  /// The length of the shortest vector of the twelve standard normal numbers whose path touches the
  /// ellipsoid in the window. All deviations within this many standard deviations keep out of the
  /// ellipsoid. The length is 0 where the means themselves enter it; there is no value if no
  /// deviation leads there.
  std::optional<double> deviations;
  double time = 0;  ///< time at which that path touches the ellipsoid
  Eigen::Matrix<double, 12, 1> deviation =
      Eigen::Matrix<double, 12, 1>::Zero();  ///< the shortest vector
  /// The least ratio |(R/a, T/b, N/c)| in the window when both spacecraft are flown with this
  /// deviation by the full equations. It is 1 where the polynomials are right and the path comes no
  /// nearer at another time.
  double flown_ratio = 0;
  /// Whether the ratio of the flight is within a twentieth of 1.
  bool is_confirmed() const { return std::abs(flown_ratio - 1) < 0.05; }
};

/// The margin of an ellipsoid about the first spacecraft that has these semi-axes (in the units of
/// the system) along R, T, N of its mean. For each time the shortest vector is found as in
/// reliability theory of first order, with the polynomials linearised anew where the last vector
/// ends:
///
///   min |xi|  with  |D^-1 (rho(t, xi_0) + J(t, xi_0) (xi - xi_0))| <= 1 ,
///
/// which is a trust-region problem in the singular values of D^-1 J. Then the time is varied,
/// beginning at the lowest minima of the lengths in the linear theory. Source: A. M. Hasofer and N.
/// C. Lind, "Exact and invariant second-moment code format", Journal of the Engineering Mechanics
/// Division 100 (1974) 111. Throws as validate and integrate_gauss, Error(usage) for semi-axes that
/// are not positive, and Error(numerical) where the iteration does not settle, because the
/// polynomials bend too much there.
KeepOutMargin keep_out_margin(const EncounterProblem& problem, const Eigen::Vector3d& semi_axes);

}  // namespace hamjet
