#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "stage_system.hpp"

namespace hamjet {

/// Fixed-point iteration for the stage equations Y = base + W g(Y) of steps that are not stiff: an
/// iteration costs about a hundredth of a factorisation. Each function gives up where the iteration
/// does not contract, and then leaves to a factorisation what it was given.
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

  /// Solves degree 0, from a guess of the slopes to slopes whose stages differ from the last ones
  /// by rounding alone. `evaluate(stages, slopes)` gives g at stages.
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
    set_scale(stages_, base_);
    Contraction contraction;
    bool is_lost_known = false;
    while (true) {
      evaluate(stages_, slopes_);
      const Real size = replace_stages(base_, &lost_);
      const auto outcome = contraction.judge(size);
      if (outcome == Outcome::fails ||
          !(outcome == Outcome::goes_on || is_finite_number(stages_))) {
        return false;
      }
      if (outcome == Outcome::is_rounding) {
        slopes = slopes_;  // those of the stages before were as good
        return true;
      }
      if (outcome == Outcome::converged) {
        set_lost(slopes_);
        replace_stages(base_, &lost_);
        evaluate(stages_, slopes);
        return true;
      }
      // An extrapolated guess can be far off: what counts is the size of the stages as they are. To
      // take it is a good part of an iteration, and small changes leave it what it is.
      if (!(size <= smallest_rescaled)) set_scale(stages_, base_);
      if (!is_lost_known && size <= largest_remainder) {
        // What the coefficients' rounding residues add is known to this part from now on.
        set_lost(slopes_);
        is_lost_known = true;
      }
    }
  }

  /// Solves one monomial above degree 0, whose equations Y = base + W (R + Dg Y) are linear.
  /// `known` is base + W R, `gradient(c, k)` is Dg.
  template <class Gradient>
  bool solve_linear(const std::vector<P>& known, const Gradient& gradient, std::vector<P>& stages) {
    stages_ = known;
    apply(gradient);
    replace_stages(known);
    set_scale(stages_, known);
    Contraction contraction;
    while (true) {
      // Judging takes as long as iterating: every second time will do.
      apply(gradient);
      replace_stages(known);
      apply(gradient);
      const auto outcome = contraction.judge(replace_stages(known));
      if (outcome == Outcome::goes_on) continue;
      stages = stages_;
      return outcome != Outcome::fails && is_finite_number(stages);
    }
  }

 private:
  /// The part of a rounding that may be left: it has the same sign in every step, so that half a
  /// rounding would make the energy drift (Hairer, McLachlan and Razakarivony, BIT 48 (2008) 231).
  static constexpr double largest_remainder = 0x1p-12;

  /// Relative changes up to this leave the scale of the stages as it is.
  static constexpr double smallest_rescaled = 0x1p-4;

  enum class Outcome {
    goes_on,
    converged,    ///< all changes to come add up to less than may be left
    is_rounding,  ///< and the last change too was rounding alone
    fails
  };

  /// Follows the sizes of the changes, relative to the stages.
  class Contraction {
   public:
    Outcome judge(const Real& size) {
      const Real before = previous_;
      previous_ = size;
      if (!(size <= before * slowest)) {
        // Changes that no longer shrink are rounding, if they are no larger than that.
        if (size <= 2 * epsilon) return Outcome::is_rounding;
        if (++stalls_ > most_stalls) return Outcome::fails;
      } else if (count_ > 0 && size * size <= largest_remainder * epsilon * (before - size)) {
        return size == 0 ? Outcome::is_rounding : Outcome::converged;
      }
      return ++count_ < largest_count ? Outcome::goes_on : Outcome::fails;
    }

   private:
    static constexpr double slowest = 0.5;
    static constexpr int most_stalls = 1;  ///< the first changes may grow
    static constexpr int largest_count = 40;
    int count_ = 0;
    int stalls_ = 0;
    Real previous_ = std::numeric_limits<Real>::max();  ///< none yet
  };

  static inline const Real epsilon = std::numeric_limits<Real>::epsilon();

  /// Changes count relative to the largest of a component's stages, or of the terms that they are
  /// sums of.
  void set_scale(const std::vector<P>& stages, const std::vector<P>& terms) {
    for (std::size_t c = 0; c < stages.size(); ++c) {
      const Real scale =
          largest_magnitude(larger_magnitude(larger_magnitude(P(Real(0)), stages[c]), terms[c]));
      inverse_scale_[c] = P(scale > 0 ? Real(1 / scale) : Real(0));
    }
  }

  /// Sets Y = terms + (W slopes_ + lost); returns the largest change. The lost part is below the
  /// rounding of the terms, and would always vanish if it were added to them.
  Real replace_stages(const std::vector<P>& terms, const std::vector<P>* lost = nullptr) {
    P largest(Real(0));
    for (std::size_t c = 0; c < terms.size(); ++c) {
      P moved = system_.couple(slopes_[c]);
      if (lost != nullptr) moved += (*lost)[c];
      const P stage = terms[c] + moved;
      largest = larger_magnitude(largest, (stage - stages_[c]) * inverse_scale_[c]);
      stages_[c] = stage;
    }
    return largest_magnitude(largest);
  }

  /// Sets slopes_ = Dg Y.
  template <class Gradient>
  void apply(const Gradient& gradient) {
    const std::size_t m = stages_.size();
    for (std::size_t c = 0; c < m; ++c) {
      P slope = gradient(c, 0) * stages_[0];
      for (std::size_t k = 1; k < m; ++k) slope += gradient(c, k) * stages_[k];
      slopes_[c] = slope;
    }
  }

  /// Whether all stages are finite; the changes do not show a NaN, which the machine's maximum
  /// skips.
  static bool is_finite_number(const std::vector<P>& stages) {
    for (const P& stage : stages) {
      if (!is_finite(largest_magnitude(stage))) return false;
    }
    return true;
  }

  const StageSystem<Real, Lanes>& system_;
  std::vector<P> base_;
  std::vector<P> lost_;  ///< of base + W g, the coefficients' rounding residues
  std::vector<P> stages_;
  std::vector<P> slopes_;
  std::vector<P> inverse_scale_;
};

}  // namespace hamjet
