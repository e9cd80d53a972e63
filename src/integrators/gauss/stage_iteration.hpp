#pragma once

#include <cstddef>
#include <vector>

#include "contraction.hpp"
#include "stage_system.hpp"

namespace hamjet {

/// Fixed-point iteration for degree 0 of the stage equations, Y = base + W g(Y), of steps that are
/// not stiff: an iteration costs about a hundredth of a factorisation.
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

  /// Solves degree 0, from a guess of the slopes to slopes whose stages base + W slopes differ from
  /// the solution by rounding alone; the slopes there are nearer to it by one iteration more.
  /// `evaluate(stages, slopes)` gives g at stages. False, with the guess as it was, where the
  /// iteration does not contract.
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
    // The step's end is of the slopes at these stages: it is nearer to the solution than they are,
    // its positions as one iteration more would be, its momenta by the root of that.
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
      // An extrapolated guess can be far off: what counts is the size of the stages as they are. To
      // take it is a good part of an iteration, and small changes leave it what it is.
      if (!(size <= smallest_rescaled)) set_scale();
      if (!is_lost_known && size <= Contraction<Real>::largest_remainder) {
        // What the coefficients' rounding residues add is known to this part from now on.
        set_lost(slopes_);
        is_lost_known = true;
      }
    }
  }

 private:
  /// Relative changes up to this leave the scale of the stages as it is.
  static constexpr double smallest_rescaled = 0x1p-4;

  /// Changes count relative to the largest of a component's stages, or of the base.
  void set_scale() {
    for (std::size_t c = 0; c < stages_.size(); ++c) {
      inverse_scale_[c] = inverse_scale(stages_[c], base_[c]);
    }
  }

  /// Sets Y = base + (W slopes_ + lost); returns the largest change. The lost part is below the
  /// rounding of the base, and would always vanish if it were added to them.
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
  std::vector<P> lost_;  ///< of base + W g, the coefficients' rounding residues
  std::vector<P> stages_;
  std::vector<P> slopes_;
  std::vector<P> inverse_scale_;
};

}  // namespace hamjet
