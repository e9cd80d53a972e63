#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/detail/maps/generating_function_kind.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The linear part of a flow, 2n x 2n, at any time of a span: from checkpoints of one propagation,
/// integrated to a local error of 1e-14, independent of the scene's integrators. Between
/// checkpoints that are close enough it is the polynomial through the ten nearest, which differs
/// from the flow by less than rounding; elsewhere it is a short integration from the last
/// checkpoint before the time. Momenta are in units of 2^momentum_exponent of the problem, so that
/// singular values do not depend on the unit of length.
class LinearFlow {
 public:
  using StateTransition = Matrix<double>;

  /// The distance of checkpoints follows from the largest rate |lambda| of the linearised
  /// equations: it is 2 sqrt(2) pi / (|lambda| `per_revolution`). A circular orbit thus has
  /// `per_revolution` checkpoints per revolution, and on other orbits the distance is proportional
  /// to r^(3/2). It is never larger than the span over `per_revolution`, or than twice the last
  /// distance. Checkpoints of a thirtieth of a revolution are equally far apart. The problem must
  /// outlive this object. Throws Error(usage) unless it is expanded in all variables,
  /// Error(too_large) beyond 500 000 checkpoints, Error(numerical) as integrate_gauss.
  LinearFlow(const ComputedProblem& problem, double duration, double per_revolution,
             const std::function<void(double)>& progress = {});

  /// The matrix from time 0 to a canonical time.
  StateTransition at(double time) const;
  /// The nominal's state (q, p) at a canonical time.
  std::vector<double> nominal(double time) const;
  const std::vector<double>& times() const noexcept {
    return times_;
  }  ///< times of the checkpoints
  const StateTransition& checkpoint(std::size_t i) const { return matrices_[i]; }
  /// The index of the last checkpoint at or before a time.
  std::size_t checkpoint_before(double time) const;

 private:
  double checkpoint_distance(const std::vector<double>& state, double time,
                             double per_revolution) const;
  /// Finds the intervals between checkpoints in which the polynomial through the nearest is right.
  void find_interpolated();

  const ComputedProblem* problem_;
  SpacePointer space_;  ///< space of order 1
  std::vector<double> times_;
  std::vector<std::vector<double>> states_;
  std::vector<StateTransition> matrices_;
  std::vector<bool> is_interpolated_;  ///< by the checkpoint before a time
};

/// The block of a linear flow that a kind inverts, n x n.
Matrix<double> inverted_block(const LinearFlow::StateTransition& flow,
                              const GeneratingFunctionKind& kind);

/// A time at which a generating function of a kind does not exist.
struct SingularTime {
  GeneratingFunctionKind kind;
  double time = 0;  ///< in canonical units
  /// Half the length, in canonical units, of the interval about this time in which the block cannot
  /// be distinguished from a singular one, because the flow's matrix has rounding errors. The time
  /// is not known better than this, and zeros that are closer to each other count as one. The
  /// length is of the order of the rounding where a singular value passes through zero, and of the
  /// square root of the rounding where it only touches zero.
  double resolution = 0;
  /// The number of singular values that rounding cannot distinguish from zero: 2 at a double zero,
  /// as at the full periods of Kepler's problem, or at a pair of zeros closer than the resolution.
  /// `direction` is then one direction of a plane.
  int directions_lost = 1;
  /// The smallest and the second smallest singular value at this time, divided by the largest (0 if
  /// there is no second one). They show how near to a zero the time is, and how far the second
  /// direction is from being lost.
  double smallest_ratio = 0;
  double second_ratio = 0;
  /// Unit vector in the space of the chosen final variables (inertial, for an orbit): for F1 the
  /// direction of the final position that no initial velocity commands.
  Vector<double> direction = {};
  /// `direction` along R, T, N of the chief at that time; absent if the chief has no orbital plane,
  /// or if it was not requested.
  std::optional<Eigen::Vector3d> direction_rtn = std::nullopt;
};

/// The times in the span (0 and the end excluded) at which a kind's linear part is singular, in
/// order. The function that is searched is the smallest singular value, divided by the norm of the
/// whole flow, with the sign of the determinant; it is continuous. Zeros are sought where it
/// changes sign between two checkpoints, and around every local minimum of its magnitude, which may
/// hide a pair of zeros (J2 splits the double zeros of Kepler's full periods into pairs some
/// thousandths of a time unit apart). Intervals about both are divided twice more, into eight and
/// into four. A minimum that rounding cannot distinguish from zero counts as a zero without a
/// change of sign. Each time comes with its resolution; two zeros that are nearer than the
/// resolution count as one. A pair of zeros is missed if it lies between two points of the finest
/// division without a minimum there, or where no checkpoint showed a sign of it.
///
/// The sign of the determinant is taken from the determinants of the singular vectors, because the
/// determinant itself, summed from products, loses its sign where two singular values are below the
/// square root of rounding.
std::vector<SingularTime> find_singular_times(const LinearFlow& flow,
                                              const GeneratingFunctionKind& kind);

/// Number of checkpoints in a revolution, unless a caller needs another one.
inline constexpr double checkpoints_per_revolution = 240;

/// The times at which a kind does not exist, without the details of SingularTime.
struct TimesWithoutKind {
  std::vector<double> times;  ///< in canonical units
  std::string not_searched;   ///< if not empty, the reason why the times were not found: the span
                              ///< was too long, or the flow ends
};

/// Finds the times at which a kind does not exist, over a canonical duration of a problem's flow. A
/// numerical failure, or a span that is too long, is recorded in the result.
TimesWithoutKind times_without_kind(const ComputedProblem& problem, double duration,
                                    const GeneratingFunctionKind& kind,
                                    const std::function<void(double)>& progress = {});

}  // namespace hamjet
