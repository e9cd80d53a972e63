#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"
#include "time_reduction.hpp"

namespace hamjet {

/// Leaves the rotation R(phi) that a system allows (DynamicalSystem::rotated_planes) out of the
/// integration of its flow, and puts it back. With the nominal's start z0, every start near it is
///
///   z0 + delta = R(phi) (z0 + sigma) ,   sigma's part in the plane of y along y0 ,
///
/// where y are the two coordinates in one of the planes that turn, that of the position or that of
/// the momentum, whichever is further from the axis at the start relative to its size. A map P that
/// commutes with all R(phi) takes this start to R(phi) P(z0 + sigma). The flow itself is such a
/// map, and so is any Runge-Kutta or splitting method whose steps do not depend on the deviations.
/// So P is expanded in sigma, which has one variable less than delta, and the jet in delta is
/// composed of P, sigma(delta) and phi(delta), which are closed formulas:
///
///   cos phi = A / sqrt(A^2 + B^2) ,   sin phi = B / sqrt(A^2 + B^2)
///
/// with A and B linear in delta (SectionTurn). Coordinates that are not rotated pass through
/// unchanged, so that sigma and phi are series in the rotated coordinates alone (four for an
/// orbit), and no composition involves all of them. Source: the reduction of a symmetry, in J. E.
/// Marsden and T. S. Ratiu, Introduction to Mechanics and Symmetry, 2nd ed., Springer 1999, section
/// 1.3; for the methods, E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration,
/// section V.1.
template <class Real>
class RotationReduction {
 public:
  /// The reduction of a problem. No value if there is no rotation to leave out: the system has
  /// none; the jet is not expanded in all rotated coordinates, or continues another jet; or the
  /// nominal starts so near to the axis, in position and momentum, that phi is ill-conditioned.
  static std::optional<RotationReduction> of(const FlowProblem<Real>& problem);

  /// The problem in one variable less, which starts at z0 + sigma. Its `variables` name, for each
  /// variable, the coordinate to which it contributes most; this serves to scale lines.
  const FlowProblem<Real>& problem() const { return reduced_; }

  /// The rotation, in the form that a further reduction needs.
  LeftOutRotation left_out() const {
    return {planes_, {rotated_[section_], rotated_[section_ + 1]}};
  }

  /// The jet in all variables, made from the jet of the reduced problem.
  FlowJet<Real> expand(const FlowJet<Real>& reduced) const;

 private:
  using Numbers = std::vector<Real>;

  RotationReduction(const FlowProblem<Real>& problem, const std::vector<Real>& scales,
                    std::size_t section);

  void set_basis(const Numbers& y0);
  void set_reduced_problem(const FlowProblem<Real>& problem);
  void set_series(const Numbers& y0);
  void set_powers();
  void set_blocks(const SeriesSpace& whole);

  /// The monomials with given exponents of the coordinates that pass through: the places of the
  /// coefficients of their products with monomials of sigma, and with monomials of the rotated
  /// deltas.
  struct Block {
    int degree = 0;                    ///< degree that is left for the rotated coordinates
    std::vector<std::size_t> reduced;  ///< by monomial of sigma
    std::vector<std::size_t> whole;    ///< by monomial of the rotated deltas
  };

  std::vector<std::array<std::size_t, 2>> planes_;
  std::vector<std::size_t> rotated_;  ///< rotated coordinates, plane by plane
  /// The places of the rotated variables among all variables.
  std::vector<std::size_t> rotated_places_;
  std::vector<std::size_t> passive_places_;  ///< places of the other variables
  std::size_t section_;                      ///< place in `rotated_` of the first coordinate of y
  Numbers scales_;                           ///< scales of the rotated coordinates
  /// Basis of the scaled sigma, orthonormal; one vector less than rotated coordinates.
  std::vector<Numbers> basis_;
  SpacePointer whole_space_;
  SpacePointer rotated_space_;  ///< space of the rotated deltas
  SpacePointer sigma_space_;
  FlowProblem<Real> reduced_;
  std::optional<Series<Real>> cosine_;  ///< cosine of phi
  std::optional<Series<Real>> sine_;
  std::vector<Series<Real>> sigma_;   ///< sigma along the basis
  std::vector<Series<Real>> powers_;  ///< the monomials of sigma, in the order of their space
  std::vector<Block> blocks_;
};

}  // namespace hamjet
