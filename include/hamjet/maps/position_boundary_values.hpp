#pragma once

#include <span>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/maps/generating_function.hpp"

namespace hamjet {

/// The initial and final momenta of the path from one position to another, all as deviations from
/// the nominal.
struct BoundaryMomenta {
  std::vector<double> initial;  ///< n numbers
  std::vector<double> final;    ///< n numbers
};

/// Solves the two-point boundary-value problem "position to position" with a generating function of
/// any kind. F1 takes both positions and answers by evaluation alone. Another kind takes a momentum
/// u_k in place of some positions; these momenta are found by Newton's method on the polynomials
/// that give the positions,
///
///   q_i(w) = q_i  for a final pair that is represented by its momentum, q0_j(w) = q0_j for an
///   initial one, w = the known positions and the unknown momenta u.
///
/// Source: Guibout and Scheeres, Solving relative two-point boundary value problems, J. Guidance,
/// Control, and Dynamics 27 (2004).
class PositionBoundaryValues {
 public:
  /// The inversion must outlive this object.
  explicit PositionBoundaryValues(const PartialInversion<double>& inversion);

  /// The momenta for two positions, each a deviation of n numbers, by the polynomials up to
  /// `degree`. Throws Error(usage) for sizes or a degree that do not fit. Throws Error(numerical)
  /// if Newton's iteration does not come to rest: then the positions are farther apart than the
  /// polynomials reach, or cannot be commanded at this time.
  BoundaryMomenta solve(std::span<const double> initial_position,
                        std::span<const double> final_position, int degree);

 private:
  /// A momentum that is unknown among the variables w, and the series that gives the position of
  /// its pair.
  struct Unknown {
    std::size_t variable;
    const Series<double>* position;
    double wanted;
  };

  void find_unknowns(int degree);

  const PartialInversion<double>& inversion_;
  MonomialValues values_;
  std::vector<double> point_;
  std::vector<Unknown> unknowns_;
};

}  // namespace hamjet
