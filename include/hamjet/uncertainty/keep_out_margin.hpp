#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// How large deviations may be for an ellipsoid about the first spacecraft to stay free.
struct KeepOutMargin {
  /// The length of the shortest vector of the twelve standard normal numbers whose path touches the
  /// ellipsoid in the window: all deviations within so many standard deviations, along every
  /// principal axis of both covariances, keep out of it. 0 where the means enter it; none where no
  /// deviation leads there.
  std::optional<double> deviations;
  double time = 0;  ///< when it touches
  Eigen::Matrix<double, 12, 1> deviation = Eigen::Matrix<double, 12, 1>::Zero();  ///< that vector
  /// Both flown with it by the full equations: the least ratio |(R/a, T/b, N/c)| in the window, 1
  /// where the polynomials are right and no other time is nearer.
  double flown_ratio = 0;
  /// Whether the flight touches the ellipsoid to a twentieth.
  bool is_confirmed() const { return std::abs(flown_ratio - 1) < 0.05; }
};

/// The ellipsoid has these semi-axes (in the units of the system) along R, T, N of the first
/// spacecraft's mean, about the spacecraft itself. For each time the shortest vector is found as in
/// reliability of first order, with the polynomials linearised anew where it ends:
///
///   min |xi|  with  |D^-1 (rho(t, xi_0) + J(t, xi_0) (xi - xi_0))| <= 1 ,
///
/// a trust-region problem in the singular values of D^-1 J; and the time is varied, from the lowest
/// minima of the linear theory's lengths. Source: A. M. Hasofer and N. C. Lind, "Exact and
/// invariant second-moment code format", Journal of the Engineering Mechanics Division 100 (1974)
/// 111. Throws as validate and integrate_gauss, Error(usage) for semi-axes that are not positive,
/// and Error(numerical) where the iteration does not settle: the polynomials bend too much there.
KeepOutMargin keep_out_margin(const EncounterProblem& problem, const Eigen::Vector3d& semi_axes);

}  // namespace hamjet
