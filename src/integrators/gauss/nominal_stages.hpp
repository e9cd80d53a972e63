#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "../summed_jet.hpp"
#include "gauss_checkpoint.hpp"
#include "gauss_step_control.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "stage_slopes.hpp"
#include "step_reach.hpp"

namespace hamjet {

/// Slopes that were computed in an earlier step, with the size of that step and the position on it,
/// from 0 (its start) to 1 (its end), at which the step begins for which they serve as a guess.
template <class Real>
struct KnownSlopes {
  Real start;
  Real step;
};

/// Degree 0 of a step's stages: the solution of their equations that is connected to the start of
/// the step.
template <class Real, int Lanes>
class NominalStages {
 public:
  using P = Pack<Real, Lanes>;

  /// `start_slope` must hold the slopes at the start of the step that is being solved, which
  /// `evaluate_slope` evaluates there.
  NominalStages(const DynamicalSystem& system, const GaussSettings& settings,
                StageSlopes<Real, Lanes>& stages, const SummedJet<Real, Lanes>& jet,
                const GaussStepControl<Real, Lanes>& control, const EndSlope<Real>& start_slope,
                std::function<void()> evaluate_slope, IntegrationStatistics& statistics)
      : is_linear_(system.vector_field.is_linear_system()),
        settings_(settings),
        stages_(stages),
        jet_(jet),
        control_(control),
        start_slope_(start_slope),
        evaluate_slope_(std::move(evaluate_slope)),
        statistics_(statistics) {}

  /// Solves for a step h at a time of the system's clock, from the guess in the stages; if that
  /// fails, from constant slopes; and along growing step sizes if the solution might not be the one
  /// connected to the start. Returns false if there is no solution.
  bool solve(const Real& time, const Real& h, const std::optional<KnownSlopes<Real>>& guess) {
    time_ = time;
    if (guess) {
      stages_.reposition(guess->start, Real(h / guess->step));
      if (try_step(h) && !is_suspicious(h)) return true;
    }
    set_constant_slopes();
    if (try_step(h) && !is_suspicious(h)) return true;
    return settings_.step && continue_from_start(h);
  }

 private:
  bool try_step(const Real& h) {
    stages_.begin_step(time_, h);
    return stages_.solve_constant_terms(jet_.start(), statistics_);
  }

  void set_constant_slopes() {
    if (!start_slope_.is_evaluated) evaluate_slope_();
    for (std::size_t c = 0; c < start_slope_.value.size(); ++c)
      stages_.slopes()[c] = P(start_slope_.value[c]);
  }

  /// Newton's method can converge to a detached root of the stage equations, whose map is
  /// symplectic but wrong. The slopes then have nothing in common with the slope at the start of
  /// the step. The equations of a linear system have a single solution.
  bool is_suspicious(const Real& h) {
    if (is_linear_) return false;
    double defect = control_.start_defect(start_slope_.value);
    // Slopes that go on from the last step's need no evaluation to be told from those of another
    // root.
    if (!start_slope_.is_evaluated && !(defect <= continuous * stages_.largest_slope())) {
      evaluate_slope_();
      defect = control_.start_defect(start_slope_.value);
    }
    if (defect > 0.5 * stages_.largest_slope() + 2 * expected_change()) return true;
    // Controlled steps are short, and their error estimate would show a wrong root.
    return settings_.step && stages_.displacement(jet_.start()) > 4 * reach(h);
  }

  static constexpr double continuous = 0x1p-10;

  /// The expected difference of the slopes between the start and the stages: |Dg| times the
  /// displacement. In a stiff system almost any difference is possible; see reach.
  double expected_change() {
    return stages_.largest_gradient() * stages_.displacement(jet_.start());
  }

  double reach(const Real& h) { return step_reach(stages_, start_slope_.value, jet_.start(), h); }

  /// Follows the solution from a tiny step to the full one. Where neighbouring solutions differ
  /// much, the path is refined. A path that ends (in a fold) has no continuation, however far it is
  /// refined.
  bool continue_from_start(const Real& h) {
    constexpr double first = 0x1p-10;
    constexpr double smallest = 0x1p-16;
    set_constant_slopes();
    const Real first_step = h * Real(first);
    if (!try_step(first_step) || is_suspicious(first_step)) return false;
    double reached = first;
    double part = first;
    double distance = stages_.displacement(jet_.start());
    while (reached < 1) {
      const double next = std::min(1.0, reached + part);
      const std::vector<P> before = stages_.slopes();
      const Real next_step = h * Real(next);
      if (try_step(next_step) &&
          largest_change(stages_, before, stages_.slopes()) <=
              0.25 * stages_.largest_slope() + expected_change() &&
          stages_.displacement(jet_.start()) <= 4 * std::max(distance, reach(next_step))) {
        distance = stages_.displacement(jet_.start());
        reached = next;
        part *= 2;
        continue;
      }
      stages_.slopes() = before;
      part /= 2;
      if (part < smallest) return false;
    }
    return true;
  }

  bool is_linear_;
  Real time_ = 0;
  const GaussSettings& settings_;
  StageSlopes<Real, Lanes>& stages_;
  const SummedJet<Real, Lanes>& jet_;
  const GaussStepControl<Real, Lanes>& control_;
  const EndSlope<Real>& start_slope_;
  std::function<void()> evaluate_slope_;
  IntegrationStatistics& statistics_;
};

}  // namespace hamjet
