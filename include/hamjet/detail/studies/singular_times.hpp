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

/// The linear part of a flow, 2n x 2n, at any time of a span: from checkpoints of one propagation
/// and a short integration from the nearest one before. It is integrated to a local error of 1e-14,
/// whatever the integrators of the scene do. Momenta are in units of 2^momentum_exponent of the
/// problem, so that singular values do not follow the unit of length.
class LinearFlow {
 public:
  using StateTransition = Matrix<double>;

  /// Checkpoints follow the largest rate |lambda| of the linearised equations: they are 2 sqrt(2)
  /// pi / (|lambda| `per_revolution`) apart, which on an orbit is `per_revolution` in a revolution
  /// of a circular one and elsewhere proportional to r^(3/2); never farther than the span over
  /// `per_revolution`, or than twice the last distance. The problem must outlive this object.
  /// Throws Error(usage) unless it is expanded in all variables, Error(too_large) beyond 100 000
  /// checkpoints, Error(numerical) as integrate_gauss.
  LinearFlow(const ComputedProblem& problem, double duration, double per_revolution,
             const std::function<void(double)>& progress = {});

  /// The matrix from time 0 to a canonical time.
  StateTransition at(double time) const;
  /// The nominal's state (q, p) at a canonical time.
  std::vector<double> nominal(double time) const;
  const std::vector<double>& times() const noexcept { return times_; }  ///< of the checkpoints
  const StateTransition& checkpoint(std::size_t i) const { return matrices_[i]; }
  /// The index of the last checkpoint at or before a time.
  std::size_t checkpoint_before(double time) const;

 private:
  double checkpoint_distance(const std::vector<double>& state, double per_revolution) const;

  const ComputedProblem* problem_;
  SpacePointer space_;  ///< of order 1
  std::vector<double> times_;
  std::vector<std::vector<double>> states_;
  std::vector<StateTransition> matrices_;
};

/// The block of a linear flow that a kind inverts, n x n.
Matrix<double> inverted_block(const LinearFlow::StateTransition& flow,
                              const GeneratingFunctionKind& kind);

/// A time at which a generating function of a kind does not exist.
struct SingularTime {
  GeneratingFunctionKind kind;
  double time = 0;  ///< canonical
  /// Half the span of time about it, canonical, within which the block cannot be told from a
  /// singular one, for the flow's matrix is known to rounding alone: the time is known no better,
  /// and closer zeros count as one. Of the order of the rounding at a zero that is passed with a
  /// slope, of its square root at one that is touched.
  double resolution = 0;
  /// How many singular values rounding cannot tell from zero: 2 at a double zero, as at the full
  /// periods of Kepler's problem, or at a pair closer than the resolution; `direction` is then one
  /// of a plane of them.
  int directions_lost = 1;
  /// The smallest and the second smallest singular value over the largest (0 for want of a second
  /// one), there: how near the time was found to a zero, and how far the next direction is from
  /// being lost.
  double smallest_ratio = 0;
  double second_ratio = 0;
  /// Unit vector in the space of the chosen final variables (inertial, for an orbit): for F1 the
  /// direction of the final position that no initial velocity commands.
  Vector<double> direction = {};
  /// `direction` along R, T, N of the chief at that time; absent where the chief has no orbital
  /// plane, or nobody asked for it.
  std::optional<Eigen::Vector3d> direction_rtn = std::nullopt;
};

/// The times in the span (0 and the end excluded) at which a kind's linear part is singular, in
/// order. The function watched is the smallest singular value over the whole flow's norm, with the
/// determinant's sign, which is continuous: where it changes sign between two checkpoints, and
/// around every local minimum of its magnitude, which may hide a pair of zeros (J2 splits the
/// double zeros of Kepler's full periods into pairs some thousandths of a time unit apart).
/// Intervals about either are divided twice more, into eight and into four. A minimum that rounding
/// cannot tell from zero counts as one without a change of sign. Each time comes with its
/// resolution; two zeros that are nearer than that count as one. Missed are zeros that come in
/// pairs between two points so divided, without a minimum there, or where none of the checkpoints
/// showed anything.
///
/// The determinant's sign is that of the singular vectors' determinants: its value, summed from
/// products, has no sign left where two singular values are below the square root of rounding.
std::vector<SingularTime> find_singular_times(const LinearFlow& flow,
                                              const GeneratingFunctionKind& kind);

/// Checkpoints in a revolution, unless a caller knows better.
inline constexpr double checkpoints_per_revolution = 240;

/// The times at which a kind does not exist, without the details of SingularTime.
struct TimesWithoutKind {
  std::vector<double> times;  ///< canonical
  std::string not_searched;   ///< not empty: the span was too long, or the flow ends, and why
};

/// Finds the times at which a kind does not exist, over a canonical duration of a problem's flow. A
/// numerical failure, or too long a span, is recorded in the result.
TimesWithoutKind times_without_kind(const ComputedProblem& problem, double duration,
                                    const GeneratingFunctionKind& kind,
                                    const std::function<void(double)>& progress = {});

}  // namespace hamjet
