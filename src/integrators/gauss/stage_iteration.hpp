#pragma once

#include <cstddef>
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

  /// Solves degree 0, starting from a guess of the slopes. At the end base + W slopes differs from
  /// the solution by rounding alone, and the slopes evaluated there are more accurate by one
  /// further iteration. `evaluate(stages, slopes)` computes g at stages. Returns false, with the
  /// guess unchanged, if the iteration does not contract.
  template <class State, class Evaluate>
  bool solve_constant_terms(const State& state, std::vector<P>& slopes, const Evaluate& evaluate) {
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
    while (true) {
      evaluate(stages_, slopes_);
      const Real size = replace_stages();
      const auto outcome = contraction.judge(size);
      if (outcome == Contraction<Real>::fails ||
          !(outcome == Contraction<Real>::goes_on || are_finite(stages_))) {
        return false;
      }
      if (outcome != Contraction<Real>::goes_on) {
        slopes = slopes_;
        return true;
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

 private:
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
};

}  // namespace hamjet
