#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "../gauss/gauss_step_rule.hpp"
#include "lane_stages.hpp"
#include "orbits.hpp"

namespace hamjet {

/// The step control of orbits side by side, by the rule of GaussStepRule. The measures of all
/// orbits are formed together.
class LaneStepControl {
 public:
  LaneStepControl(const DynamicalSystem& system, const LaneStages& stages, int order)
      : waves_(system.waves_on_a_circle),
        degrees_of_freedom_(system.degrees_of_freedom),
        stages_(stages),
        s_(static_cast<int>(stages.stages())),
        rule_(s_, stages.is_second_order(), order, std::numeric_limits<double>::epsilon()) {}

  const GaussStepRule& rule() const { return rule_; }
  /// The measures of the last step of one orbit.
  const StepMeasures& measures(std::size_t lane) const { return measures_[lane]; }

  /// GaussStepRule::longest_sampling_step.
  template <class State>
  EachOrbit longest_sampling_steps(const State& state) const {
    EachOrbit result;
    result.fill(std::numeric_limits<double>::infinity());
    if (waves_ == 0) return result;
    Orbits distance(0.0);
    Orbits speed(0.0);
    for (std::size_t c = 0; c < degrees_of_freedom_; ++c) {
      distance += state(c) * state(c);
      speed += state(degrees_of_freedom_ + c) * state(degrees_of_freedom_ + c);
    }
    const EachOrbit ratio = apart(sqrt(distance / speed));
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      if (ratio[k] == ratio[k]) result[k] = rule_.longest_sampling_step(waves_, ratio[k]);
    }
    return result;
  }

  /// Measures the stages of a step; `start_slopes` are the slopes at its start.
  template <class State>
  [[gnu::flatten]] void look(const State& state, const std::vector<Orbits>& start_slopes) {
    const std::size_t m = stages_.components();
    Orbits slope(0.0), first(0.0), last(0.0), largest(0.0), place(0.0), velocity(0.0);
    for (const Orbits& x : stages_.slopes()) slope = larger_magnitude(slope, x);
    const auto s = static_cast<std::size_t>(s_);
    for (std::size_t e = 0; e < m * m; ++e) {
      const Orbits* const entries = &stages_.gradients()[e * s];
      first = larger_magnitude(first, entries[0]);
      last = larger_magnitude(last, entries[s - 1]);
      for (std::size_t i = 0; i < s; ++i) largest = larger_magnitude(largest, entries[i]);
    }
    for (std::size_t c = 0; c < m; ++c) {
      place = larger_magnitude(place, state(c));
      if (stages_.is_second_order()) velocity = larger_magnitude(velocity, state(m + c));
    }
    Orbits defect(0.0);
    for (std::size_t c = 0; c < m; ++c) {
      defect =
          larger_magnitude(defect, weighted(stages_.coefficients().start, c) - start_slopes[c]);
    }
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      const auto lane = static_cast<int>(k);
      measures_[k] = {defect.lane(lane),  slope.lane(lane), first.lane(lane),   last.lane(lane),
                      largest.lane(lane), place.lane(lane), velocity.lane(lane)};
    }
    const int gap = s_ < 6 ? 2 : 3;
    modes_[0] = mode(s_ - 1);
    modes_[1] = mode(s_ - 2);
    modes_[2] = mode(s_ - 1 - gap);
    modes_[3] = mode(s_ - 2 - gap);
    displacement_ = apart(displacement(state));
  }

  /// The error estimate of a step h of one orbit.
  double error_estimate(std::size_t lane, double h) const {
    const int gap = s_ < 6 ? 2 : 3;
    return rule_.error_estimate(measures_[lane], h, [&](int degree) {
      const int below = s_ - 1 - degree;
      return modes_[static_cast<std::size_t>(below < gap ? below : below - gap + 2)][lane];
    });
  }

  /// As GaussIntegrator::is_suspicious, for controlled steps.
  bool is_suspicious(std::size_t lane) const {
    const StepMeasures& step = measures_[lane];
    return step.defect > 0.5 * step.slope + 2 * step.largest_gradient * displacement_[lane];
  }

 private:
  Orbits weighted(const std::vector<double>& weights, std::size_t c) const {
    const Orbits* const slopes = &stages_.slopes()[c * weights.size()];
    Orbits sum(0.0);
    for (std::size_t i = 0; i < weights.size(); ++i) sum += Orbits(weights[i]) * slopes[i];
    return sum;
  }
  EachOrbit mode(int degree) const {
    Orbits largest(0.0);
    if (degree < 0) return apart(largest);
    const auto& weights = stages_.coefficients().modes[static_cast<std::size_t>(degree)];
    for (std::size_t c = 0; c < stages_.components(); ++c) {
      largest = larger_magnitude(largest, weighted(weights, c));
    }
    return apart(largest);
  }
  template <class State>
  Orbits displacement(const State& state) const {
    Orbits largest(0.0);
    const auto s = static_cast<std::size_t>(s_);
    for (std::size_t c = 0; c < stages_.components(); ++c) {
      for (std::size_t i = 0; i < s; ++i) {
        largest = larger_magnitude(largest, stages_.places()[c * s + i] - state(c));
      }
    }
    return largest;
  }

  int waves_;
  std::size_t degrees_of_freedom_;
  const LaneStages& stages_;
  int s_;
  GaussStepRule rule_;
  std::array<StepMeasures, orbit_lanes> measures_;
  EachOrbit displacement_{};
  /// The last two Legendre modes of the slopes, and the two modes before these.
  std::array<EachOrbit, 4> modes_{};
};

}  // namespace hamjet
