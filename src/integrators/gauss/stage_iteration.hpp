#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "contraction.hpp"
#include "stage_system.hpp"

namespace hamjet {

/// Fixed-point iteration for degree 0 of the stage equations, Y = base + W g(Y), in steps that are
/// not stiff. An iteration costs about a hundredth of a factorisation.
template <class Real, int Lanes>
class StageIteration {
 public:
  using P = Pack<Real, Lanes>;

  explicit StageIteration(const StageSystem<Real, Lanes>& system)
      : system_(system),
        base_(system.components()),
        lost_(system.components()),
        stages_(system.components()),
        slopes_(system.components()),
        inverse_scale_(system.components()) {}

  enum Outcome {
    fails,    ///< the iteration does not contract, and the guess is unchanged
    solved,   ///< base + W slopes differs from the solution by rounding alone
    expected  ///< the same if the iteration contracts as before: the caller must ask is_confirmed
  };

  /// Solves degree 0, starting from a guess of the slopes. The slopes evaluated at the resulting
  /// base + W slopes are more accurate by one further iteration. `evaluate(stages, slopes)`
  /// computes g at stages. Without `may_expect` nothing is expected.
  template <class State, class Evaluate>
  Outcome solve_constant_terms(const State& state, std::vector<P>& slopes, const Evaluate& evaluate,
                               bool may_expect = true) {
    const std::size_t m = system_.components();
    const auto set_lost = [&](const std::vector<P>& g) {
      for (std::size_t c = 0; c < m; ++c) lost_[c] = system_.lost(c, state, g[c]);
    };
    set_lost(slopes);
    for (std::size_t c = 0; c < m; ++c) {
      base_[c] = system_.base(c, state);
      stages_[c] = base_[c] + (system_.couple(slopes[c]) + lost_[c]);
    }
    set_scale();
    // The step's end uses the slopes at these stages, so that it is nearer to the solution than the
    // stages themselves: its positions by a whole iteration, its momenta by the root of that.
    Contraction<Real> contraction(true);
    bool is_lost_known = false;
    for (bool is_first = true;; is_first = false) {
      evaluate(stages_, slopes_);
      const Real size = replace_stages();
      if (is_first && may_expect && is_enough(Real(size * Real(contraction_))) &&
          are_finite(stages_)) {
        change_ = size;
        slopes = slopes_;
        return expected;
      }
      if (!is_first) bound_contraction(size);
      change_ = size;
      const auto outcome = contraction.judge(size);
      if (outcome == Contraction<Real>::fails ||
          !(outcome == Contraction<Real>::goes_on || are_finite(stages_))) {
        return fails;
      }
      if (outcome != Contraction<Real>::goes_on) {
        slopes = slopes_;
        return solved;
      }
      // An extrapolated guess can be far off, so that the scale must be the size of the present
      // stages. Taking it costs a large part of an iteration, and after small changes it is not
      // taken anew.
      if (!(size <= smallest_rescaled)) set_scale();
      if (!is_lost_known && size <= Contraction<Real>::largest_remainder) {
        // From now on the contribution of the coefficients' rounding residues is known to this
        // fraction.
        set_lost(slopes_);
        is_lost_known = true;
      }
    }
  }

  /// Whether the solution that was expected is one, judged by the slopes that were evaluated there.
  template <class Slope>
  bool is_confirmed(const std::vector<P>& assumed, const Slope& slope) {
    P largest(Real(0));
    for (std::size_t c = 0; c < base_.size(); ++c) {
      const P change = slope(c) - assumed[c];
      if (!is_finite(largest_magnitude(change))) return false;
      largest = larger_magnitude(largest, system_.couple(change) * inverse_scale_[c]);
    }
    const Real left = largest_magnitude(largest);
    // Changes near rounding tell nothing of the contraction but that it cannot be relied on.
    const bool is_near_rounding = !(change_ > 64 * epsilon());
    if (!is_near_rounding) contraction_ = static_cast<double>(left / change_);
    const bool is_solution = is_enough(left);
    if (!is_solution && is_near_rounding) contraction_ = 1;
    return is_solution;
  }

  /// By how much an iteration contracted when that was measured last; the choices of the next steps
  /// depend on it.
  double contraction() const { return contraction_; }
  void restore_contraction(double contraction) { contraction_ = contraction; }

 private:
  static Real epsilon() { return std::numeric_limits<Real>::epsilon(); }

  /// What an extrapolated guess leaves is rough along a step, so that its integrals are small.
  static constexpr double usual_contraction = 0x1p-13;

  /// Whether stages that are wrong by `left` are as good as those of a further iteration: their own
  /// error is rounding, and it adds to the step's end, which contracts it once more, no more than
  /// an iteration that is judged to have converged.
  bool is_enough(const Real& left) const {
    return left <= epsilon() &&
           left * Real(contraction_) <= Contraction<Real>::largest_remainder * epsilon();
  }

  /// Two changes that follow each other bound the contraction, the second of which may be rounding.
  void bound_contraction(const Real& size) {
    if (!(change_ > 0)) return;
    const Real bound = std::max(size, epsilon()) / change_;
    contraction_ = std::min(contraction_, static_cast<double>(bound));
  }

  /// Relative changes up to this number do not require a new scale of the stages.
  static constexpr double smallest_rescaled = 0x1p-4;

  /// Changes count relative to the largest stage of a component, or to its base.
  void set_scale() {
    for (std::size_t c = 0; c < stages_.size(); ++c) {
      inverse_scale_[c] = inverse_scale(stages_[c], base_[c]);
    }
  }

  /// Sets Y = base + (W slopes_ + lost); returns the largest change. The lost part is smaller than
  /// the rounding of the base, and would always vanish if it were added to the base.
  Real replace_stages() {
    P largest(Real(0));
    for (std::size_t c = 0; c < base_.size(); ++c) {
      const P stage = base_[c] + (system_.couple(slopes_[c]) + lost_[c]);
      largest = larger_magnitude(largest, (stage - stages_[c]) * inverse_scale_[c]);
      stages_[c] = stage;
    }
    return largest_magnitude(largest);
  }

  const StageSystem<Real, Lanes>& system_;
  std::vector<P> base_;
  std::vector<P> lost_;  ///< contribution of the coefficients' rounding residues to base + W g
  std::vector<P> stages_;
  std::vector<P> slopes_;
  std::vector<P> inverse_scale_;
  Real change_ = 0;  ///< the last change of the stages
  double contraction_ = usual_contraction;
};

}  // namespace hamjet
