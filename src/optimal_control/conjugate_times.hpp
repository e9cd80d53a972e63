#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// The conjugate times of an extremal: the times at which extremals from the same state with
/// neighbouring costates meet again to first order, that is, at which d x(t) / d p(0) is singular.
struct ConjugateTimes {
  /// For each conjugate time, repeated by multiplicity, the number of steps after which it has been
  /// passed.
  std::vector<std::size_t> passed_after;
  /// Whether the steps are short enough to follow the neighbours of the extremal, so that the count
  /// is reliable.
  bool is_resolved = true;
};

/// Finds the conjugate times before the end from the Jacobians of each step's map of (x, p), 2n x
/// 2n. By Jacobi's condition an extremal with a conjugate time is not a local minimum: neighbours
/// between the same ends cost less.
///
/// The plane of the neighbours, spanned by the columns (B, D) = (dx/dp(0), dp/dp(0)), is
/// Lagrangian. With orthonormal columns W = D + i B is unitary, and U = W W^T, which does not
/// depend on the basis, has the eigenvalue 1 where B is singular. Its eigenvalues start at 1 and
/// pass 1 clockwise, because H_pp <= 0. Each return to 1 is a conjugate time; the phase of det U,
/// followed from step to step, counts these returns. A conjugate time at the end itself, to within
/// round-off, is not counted. Source: V. I. Arnold, "Characteristic class entering in quantization
/// conditions", Functional Analysis and Its Applications 1 (1967), the Maslov index.
///
/// `typical_sizes`, 2n positive numbers, are the scales of states and costates; the product of a
/// state's size and its costate's size must be the same for all.
ConjugateTimes conjugate_times(const std::vector<Eigen::MatrixXd>& jacobians,
                               const Eigen::VectorXd& typical_sizes);

}  // namespace hamjet
