#pragma once

#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The effect of rounding alone on a result: the largest deviation in a sample, in canonical units.
struct RoundingFloor {
  std::vector<double> state;  ///< for each component of the model
  /// The deviation of each derivative of the final by the initial state, by rows, 2n x 2n; 0 if the
  /// jet is not expanded in the variable.
  std::vector<double> matrix;
};

/// A sample of the effect of rounding on an integration; the roundings are random, not those of a
/// processor. With u half the distance from 1 to the next number, x the state and M the matrix of
/// first derivatives before a step h of the method, P the matrix of that step alone, f the vector
/// field and A its gradient, these are disturbed by independent numbers, uniform between -1 and 1,
/// times:
///
/// - the start x and the ones of M = I:  u |x_i|, u;
/// - the state after each step:  u (|x_i| + sum_j |P_ij - I_ij| |x_j| + |h f_i|);
/// - the matrix after each step:  u (|M_il| + sum_j (|P_ij - I_ij| + |h A_ij|) |M_jl|);
/// - both by the same number at every step, as the rounded coefficients of a method would:  u times
///   what the step adds to x_i and M_il;
/// - both at the end, as a rounded duration t would:  u |f_i t|, u |(A M)_il t|.
///
/// The disturbances are carried to the end by the second-order jets of the method's own steps (of
/// Gauss with 8 stages in place of CVODE's, which depend on the steps before). If there are more
/// than 80 000 steps, they are taken in groups, and the squares of the disturbances in a group add
/// up. If a step's implicit equations have several solutions and the step alone would find another
/// one than the run, its first-order map is taken from the run's matrices. A component that stays
/// zero is not disturbed; an integration without steps has no rounding.
class RoundingSample {
 public:
  static constexpr std::size_t size = 32;

  /// Follows the first run of a scene once more. A second call continues from the states that the
  /// last one reached, with a new matrix. `progress` is called with the fraction that is done.
  /// Throws as the integration does, and Error(numerical) if a deviation is not finite.
  void follow(const Scene& scene, const ComputedProblem& problem,
              const std::function<void(double)>& progress = {});

  /// The rounding floor after the last call of `follow`.
  const RoundingFloor& floor() const { return floor_; }

 private:
  class Deviations;
  template <class Real>
  void follow_as(const Scene& scene, const ComputedProblem& problem,
                 const std::function<void(double)>& progress);

  std::mt19937_64 generator_{20};
  /// For each member, its state where it was last followed.
  std::vector<std::vector<double>> states_;
  RoundingFloor floor_;
};

}  // namespace hamjet
