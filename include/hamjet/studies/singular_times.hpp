#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "hamjet/algebra/eigen.hpp"
#include "hamjet/maps/generating_function_kind.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The linear part of an orbit's flow, 6 x 6, at any time of a span: from checkpoints of one
/// propagation and a short integration from the nearest one before.
class LinearFlow {
 public:
  using StateTransition = Eigen::Matrix<double, 6, 6>;

  /// Checkpoints are `per_revolution` in a revolution of a circular orbit, and elsewhere at steps
  /// that go as the distance r^(3/2), as the orbit's time scale does. The problem must outlive this
  /// object. Throws Error(usage) unless it is an orbit, expanded in all variables.
  LinearFlow(const ComputedProblem& problem, double duration, double per_revolution,
             const std::function<void(double)>& progress = {});

  StateTransition at(double time) const;
  /// The chief's state (q, p) then.
  std::vector<double> chief(double time) const;
  const std::vector<double>& times() const noexcept { return times_; }  ///< of the checkpoints
  const StateTransition& checkpoint(std::size_t i) const { return matrices_[i]; }

 private:
  std::size_t checkpoint_before(double time) const;

  const ComputedProblem* problem_;
  SpacePointer space_;  ///< of order 1
  std::vector<double> times_;
  std::vector<std::vector<double>> states_;
  std::vector<StateTransition> matrices_;
};

/// The block that a kind inverts, see inverted_block.
Eigen::Matrix3d inverted_block(const LinearFlow::StateTransition& flow,
                               const GeneratingFunctionKind& kind);

/// A time at which a generating function of a kind does not exist.
struct SingularTime {
  GeneratingFunctionKind kind;
  double time = 0;  ///< canonical
  /// The two smallest singular values over the largest, there: how near the time was found to a
  /// zero, and whether one or two directions are lost.
  double smallest_ratio = 0;
  double second_ratio = 0;
  /// Unit vector, inertial, in the space of the chosen final variables: for F1 the direction of the
  /// final position that no initial velocity commands.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// The same along R, T, N of the chief at that time; absent where the chief has no orbital plane.
  std::optional<Eigen::Vector3d> direction_rtn = std::nullopt;

  /// 2 at a double zero, as at the full periods of Kepler's problem: `direction` is then one of a
  /// plane of them.
  int directions_lost() const { return second_ratio < 1e-6 ? 2 : 1; }
};

/// The times in the span (0 and the end excluded) at which a kind's linear part is singular, in
/// order. The function watched is the smallest singular value with the determinant's sign, which
/// is continuous: where it changes sign between two checkpoints, and around every local minimum of
/// its magnitude, which may hide a pair of zeros (J2 splits the double zeros of Kepler's full
/// periods into pairs some thousandths of a time unit apart). Intervals about either are divided
/// twice more, into eight and into four. Simple zeros are refined to the rounding of the time,
/// double ones to its square root: a minimum below `double_zero` of the largest singular value
/// without a change of sign is one, and so are two zeros nearer than round-off can tell. Missed are
/// zeros that come in pairs between two points so divided, without a minimum there, or where none
/// of the checkpoints showed anything.
std::vector<SingularTime> find_singular_times(const LinearFlow& flow,
                                              const GeneratingFunctionKind& kind);

/// Smallest minimum of the scaled singular value that counts as zero without a change of sign.
inline constexpr double double_zero = 1e-9;

}  // namespace hamjet
