#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

/// The effect of an impulse at a time on the deviation at the start of a linear flow: the last
/// three columns of the inverse of the flow's matrix to that time.
using ImpulseEffect = Eigen::Matrix<double, 6, 3>;

/// The solver of a linear program failed, or its answer was checked and is not the least.
class UnprovedLeast : public Error {
 public:
  explicit UnprovedLeast(const std::string& message) : Error(ErrorKind::numerical, message) {}
};

/// An impulse at one of the given times.
struct ChosenImpulse {
  std::size_t time = 0;  ///< index of its effect
  Eigen::Vector3d change = Eigen::Vector3d::Zero();
};

/// The impulses with the least sum of magnitudes that together make a change of the deviation.
struct LeastImpulses {
  std::vector<ChosenImpulse> impulses;  ///< at most six, in the order of the times
  double cost = 0;                      ///< sum of their magnitudes
  /// A bound from the dual problem: no impulses at the given times make the change for less.
  double lower_bound = 0;
  /// The primer vector is effect^T times this; if impulses are not limited, its magnitude is at
  /// most 1 at the given times, and 1 at those with impulses. (Lawden, Optimal Trajectories for
  /// Space Navigation, 1963.)
  Eigen::Matrix<double, 6, 1> costate = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Least sum |v_k| with sum B_k v_k = change, by the dual problem, largest change . y with
/// |B_k^T y| <= 1 for all k. Each round of Kelley's cutting planes (Journal of the SIAM 8, 1960)
/// solves a linear program whose impulses have given directions, and adds the directions B_k^T y of
/// its multiplier y where they do more than they cost. Throws Error(numerical) if the impulses
/// cannot make every change, as at one time alone, and as require_least.
LeastImpulses least_impulses(const std::vector<ImpulseEffect>& effects,
                             const Eigen::Matrix<double, 6, 1>& change);

/// The least impulses below a limit, or the reason why there are none.
struct LimitedImpulses {
  std::optional<LeastImpulses> least;
  /// If there are none: the limit must be at least this.
  double limit_needed = 0;
};

/// The least impulses of which none exceeds `most` > 0: least sum |v_k| with sum B_k v_k = change
/// and |v_k| <= most, by the dual problem, largest
///
///   change . y - most sum_k max(0, |B_k^T y| - 1),
///
/// so that the primer vector exceeds 1 at impulses of size `most`. Beside these there are at most
/// six others. There is no solution if some y has change . y > most sum_k |B_k^T y|. Throws as
/// above.
LimitedImpulses least_impulses(const std::vector<ImpulseEffect>& effects,
                               const Eigen::Matrix<double, 6, 1>& change, double most);

/// Verifies an answer: the impulses make the change to 1e-9, none is above `most`, and they cost at
/// most 1e-7 more than the bound that the costate proves. Throws UnprovedLeast otherwise, also for
/// numbers that are not finite.
void require_least(const std::vector<ImpulseEffect>& effects,
                   const Eigen::Matrix<double, 6, 1>& change, double most,
                   const LeastImpulses& least);

/// The effects of corrections to impulses of at most `most`: impulses of that size may only be
/// turned.
std::vector<ImpulseEffect> effects_below(const std::vector<ImpulseEffect>& effects,
                                         const std::vector<Eigen::Vector3d>& impulses, double most);
/// The weights of add_change for impulses of at most `most`; `weights` are those without a limit.
std::vector<double> weights_below(std::vector<double> weights,
                                  const std::vector<Eigen::Vector3d>& impulses, double most);

/// Corrects the impulses so that they make the additional change `change`, with the least sum of
/// squares divided by the weights, which are at least 0. With the magnitudes of optimal impulses as
/// weights the cost is the least to first order. Returns false, without any correction, if impulses
/// at these times cannot make it.
bool add_change(const std::vector<ImpulseEffect>& effects, std::vector<Eigen::Vector3d>& impulses,
                const std::vector<double>& weights, const Eigen::Matrix<double, 6, 1>& change);

}  // namespace hamjet
