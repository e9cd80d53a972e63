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
        units_(system),
        stages_(stages),
        s_(static_cast<int>(stages.stages())),
        rule_(s_, stages.is_second_order(), order, std::numeric_limits<double>::epsilon()) {}

  const GaussStepRule& rule() const { return rule_; }
  const ComponentUnits& units() const { return units_; }
  /// The factors that make the entries (c, k) of a matrix such as Dg at the last step's stages
  /// comparable, by rows. The columns of parameters, whose rows vanish, do not count.
  std::vector<Orbits> entry_weights() const {
    const std::size_t m = stages_.components();
    std::vector<Orbits> result(m * m, Orbits(0.0));
    for (std::size_t c = 0; c < units_.count(); ++c) {
      for (std::size_t k = 0; k < units_.count(); ++k) {
        result[c * m + k] =
            units_.inverse_unit(c, inverse_sigma_) / units_.inverse_unit(k, inverse_sigma_);
      }
    }
    return result;
  }
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
    const auto s = static_cast<std::size_t>(s_);
    Orbits first(0.0), last(0.0), largest(0.0), slope(0.0), velocity(0.0);
    GradientBlocks<Orbits> blocks{Orbits(0.0), Orbits(0.0), Orbits(0.0)};
    for (std::size_t i = 0; i < s; ++i) {
      const auto at_stage = units_.blocks<Orbits>(
          [&](std::size_t c, std::size_t k) { return stages_.gradients()[(c * m + k) * s + i]; });
      const Orbits size = at_stage.largest();
      if (i == 0) first = size;
      last = size;
      largest = larger_magnitude(largest, size);
      blocks.velocity = larger_magnitude(blocks.velocity, at_stage.velocity);
      blocks.force = larger_magnitude(blocks.force, at_stage.force);
    }
    if (!stages_.is_second_order()) inverse_sigma_ = inverse_sigma(blocks);
    for (std::size_t i = 0; i < s; ++i) {
      slope = larger_magnitude(
          slope, largest_component([&](std::size_t c) { return stages_.slopes()[c * s + i]; }));
    }
    const Orbits place = largest_component(state);
    for (std::size_t c = 0; c < m && stages_.is_second_order(); ++c) {
      velocity = larger_magnitude(velocity, state(m + c));
    }
    const Orbits defect = largest_component(
        [&](std::size_t c) { return weighted(stages_.coefficients().start, c) - start_slopes[c]; });
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

  /// The test of GaussIntegrator::is_suspicious, for controlled steps.
  bool is_suspicious(std::size_t lane) const {
    const StepMeasures& step = measures_[lane];
    return step.defect > 0.5 * step.slope + 2 * step.largest_gradient * displacement_[lane];
  }

 private:
  /// The largest value(c) of the measured components in their units.
  template <class Value>
  Orbits largest_component(const Value& value) const {
    Orbits largest(0.0);
    for (std::size_t c = 0; c < units_.count(); ++c) {
      largest = larger_magnitude(largest, value(c) * units_.inverse_unit(c, inverse_sigma_));
    }
    return largest;
  }
  Orbits weighted(const std::vector<double>& weights, std::size_t c) const {
    const Orbits* const slopes = &stages_.slopes()[c * weights.size()];
    Orbits sum(0.0);
    for (std::size_t i = 0; i < weights.size(); ++i) sum += Orbits(weights[i]) * slopes[i];
    return sum;
  }
  EachOrbit mode(int degree) const {
    if (degree < 0) return {};
    const auto& weights = stages_.coefficients().modes[static_cast<std::size_t>(degree)];
    return apart(largest_component([&](std::size_t c) { return weighted(weights, c); }));
  }
  template <class State>
  Orbits displacement(const State& state) const {
    Orbits largest(0.0);
    const auto s = static_cast<std::size_t>(s_);
    for (std::size_t i = 0; i < s; ++i) {
      largest = larger_magnitude(largest, largest_component([&](std::size_t c) {
                                   return stages_.places()[c * s + i] - state(c);
                                 }));
    }
    return largest;
  }

  int waves_;
  std::size_t degrees_of_freedom_;
  ComponentUnits units_;
  Orbits inverse_sigma_ = Orbits(1.0);  ///< of the last step's stages, see ComponentUnits
  const LaneStages& stages_;
  int s_;
  GaussStepRule rule_;
  std::array<StepMeasures, orbit_lanes> measures_;
  EachOrbit displacement_{};
  /// The last two Legendre modes of the slopes, and the two modes before these.
  std::array<EachOrbit, 4> modes_{};
};

}  // namespace hamjet
