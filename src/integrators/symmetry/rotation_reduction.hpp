#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"
#include "time_reduction.hpp"

namespace hamjet {

/// A flow without the rotation R(phi) that its system allows (DynamicalSystem::rotated_planes), and
/// put together with it again. With the nominal's start z0, every start near it is
///
///   z0 + delta = R(phi) (z0 + sigma) ,   sigma's part in the plane of y along y0 ,
///
/// with y the two coordinates of one of the planes that turn, the position's or the momentum's,
/// whichever is further from the axis at the start relative to its size. A map P that commutes with
/// all R(phi), the flow itself or any Runge-Kutta or splitting method whose steps do not depend on
/// the deviations, takes it to R(phi) P(z0 + sigma). So P is expanded in sigma, one variable less
/// than delta has, and the jet in delta is composed of P, sigma(delta) and phi(delta), which are
/// closed:
///
///   cos phi = A / sqrt(A^2 + B^2) ,   sin phi = B / sqrt(A^2 + B^2)
///
/// with A and B linear in delta (SectionTurn). The coordinates that are not rotated pass through,
/// so that sigma and phi are series in the rotated ones alone (four for an orbit), and nothing is
/// composed in all of them. Source: the reduction of a symmetry, in J. E. Marsden and T. S. Ratiu,
/// Introduction to Mechanics and Symmetry, 2nd ed., Springer 1999, section 1.3; for the methods, E.
/// Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, section V.1.
template <class Real>
class RotationReduction {
 public:
  /// The reduction of a problem; none where it has no rotation to leave out: the system has none,
  /// the jet is not expanded in all rotated coordinates or goes on from another one, or the nominal
  /// starts so near to the axis, in position and momentum, that phi is ill-conditioned.
  static std::optional<RotationReduction> of(const FlowProblem<Real>& problem);

  /// The problem in one variable less, which starts at z0 + sigma. Its `variables` name the
  /// coordinate that each does most of, for the sizes of lines.
  const FlowProblem<Real>& problem() const { return reduced_; }

  /// The rotation, for what is left out besides.
  LeftOutRotation left_out() const {
    return {planes_, {rotated_[section_], rotated_[section_ + 1]}};
  }

  /// The jet in all variables, from that of the reduced problem.
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

  /// The monomials of the coordinates that pass through, with given exponents: where the
  /// coefficients of their products with monomials of sigma, and of the rotated deltas, stand.
  struct Block {
    int degree = 0;                    ///< that is left for the rotated coordinates
    std::vector<std::size_t> reduced;  ///< by monomial of sigma
    std::vector<std::size_t> whole;    ///< by monomial of the rotated deltas
  };

  std::vector<std::array<std::size_t, 2>> planes_;
  std::vector<std::size_t> rotated_;         ///< coordinates, plane by plane
  std::vector<std::size_t> rotated_places_;  ///< their places among the variables
  std::vector<std::size_t> passive_places_;  ///< of the other variables
  std::size_t section_;                      ///< place in `rotated_` of the first coordinate of y
  Numbers scales_;                           ///< of the rotated coordinates
  std::vector<Numbers> basis_;  ///< of the scaled sigma, orthonormal; one less than rotated
  SpacePointer whole_space_;
  SpacePointer rotated_space_;  ///< of the rotated deltas
  SpacePointer sigma_space_;
  FlowProblem<Real> reduced_;
  std::optional<Series<Real>> cosine_;  ///< of phi
  std::optional<Series<Real>> sine_;
  std::vector<Series<Real>> sigma_;   ///< along the basis
  std::vector<Series<Real>> powers_;  ///< the monomials of sigma, in the order of their space
  std::vector<Block> blocks_;
};

}  // namespace hamjet
