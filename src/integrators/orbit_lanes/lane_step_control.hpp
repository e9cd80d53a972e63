#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lane_stages.hpp"
#include "orbits.hpp"

namespace hamjet {

/// The step control of GaussStepControl for orbits side by side: what it looks at is formed for all
/// of them together, and judged for each.
class LaneStepControl {
 public:
  LaneStepControl(const DynamicalSystem& system, const LaneStages& stages, int order)
      : waves_(system.waves_on_a_circle),
        degrees_of_freedom_(system.degrees_of_freedom),
        stages_(stages),
        s_(static_cast<int>(stages.stages())),
        order_(order) {
    const double s = s_;
    pade_constant_ =
        std::pow(std::tgamma(s + 1), 2) / (std::tgamma(2 * s + 1) * std::tgamma(2 * s + 2));
  }

  /// GaussStepControl::first_step from the gradient's norm at the start.
  double first_step(double norm, double tolerance, double duration) const {
    const double span = std::abs(duration);
    double h = span;
    if (norm > 0) h = stages_.is_second_order() ? 1 / std::sqrt(norm) : 1 / norm;
    h *= 2 * std::pow(tolerance / error_constant, 0.5 / s_) * s_;
    return std::copysign(std::min(h, span), duration);
  }

  /// GaussStepControl::longest_sampling_step.
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
      const double longest = 2 * s_ * ratio[k] / waves_;
      if (longest == longest) result[k] = longest;
    }
    return result;
  }

  /// Looks at the stages of a step, from slopes at its start.
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
    slope_ = apart(slope);
    first_gradient_ = apart(first);
    last_gradient_ = apart(last);
    largest_gradient_ = apart(largest);
    place_ = apart(place);
    velocity_ = apart(velocity);
    defect_ = apart(defect);
    const int gap = s_ < 6 ? 2 : 3;
    modes_[0] = mode(s_ - 1);
    modes_[1] = mode(s_ - 2);
    modes_[2] = mode(s_ - 1 - gap);
    modes_[3] = mode(s_ - 2 - gap);
    displacement_ = apart(displacement(state));
  }

  /// GaussStepControl::error_estimate of a step h of one orbit.
  double error_estimate(std::size_t lane, double h) const {
    const double slope = slope_scale(lane);
    if (slope == 0) return linearised_error(lane, h);
    const double noise = slope_noise(lane);
    double ratio = std::max(0.0, defect_[lane] - noise) / slope;
    if (s_ > 1) {
      const double last = std::max(0.0, modes_[0][lane] - noise) / slope;
      const double s = s_;
      if (last > ratio) ratio = std::max(ratio, std::pow(last, s / (s - 1)));
    }
    return std::max({error_constant * ratio * ratio, continued_modes(lane, slope, noise),
                     linearised_error(lane, h)});
  }

  /// GaussIntegrator::is_suspicious for controlled steps.
  bool is_suspicious(std::size_t lane) const {
    return defect_[lane] > 0.5 * slope_[lane] + 2 * largest_gradient_[lane] * displacement_[lane];
  }

  double step_factor(double error, double tolerance) const {
    if (error <= 0) return 4;
    return std::clamp(0.95 * std::pow(tolerance / error, 0.5 / s_), 0.1, 4.0);
  }

  double time_scale_ratio(std::size_t lane) const {
    const double first = first_gradient_[lane];
    const double last = last_gradient_[lane];
    if (first == 0 || last == 0) return 1;
    const double ratio = stages_.is_second_order() ? std::sqrt(first / last) : first / last;
    return std::clamp(ratio, 0.25, 4.0);
  }

  double periods(std::size_t lane, double h) const {
    return std::abs(h) * frequency(lane) / (2 * std::numbers::pi);
  }

 private:
  /// The error_constant of GaussStepControl.
  static constexpr double error_constant = 100;
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

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

  double continued_modes(std::size_t lane, double slope, double noise) const {
    if (s_ < 4) return 0;
    const double gap = s_ < 6 ? 2 : 3;
    const double near = std::max(modes_[0][lane], modes_[1][lane]) / slope;
    if (near <= 8 * std::max(epsilon, noise / slope)) return 0;
    const double far = std::max(modes_[2][lane], modes_[3][lane]) / slope;
    return near < far ? near * std::pow(near / far, (s_ + 2) / gap) : near;
  }

  double linearised_error(std::size_t lane, double h) const {
    const double x = std::abs(h) * frequency(lane) * (1 + 0.25 * std::min(order_, 4));
    double power = 1;
    for (int i = 0; i < s_; ++i) power *= x * x;
    return 2 * std::numbers::pi * pade_constant_ * power;
  }

  double frequency(std::size_t lane) const {
    const double gradient = largest_gradient_[lane];
    return stages_.is_second_order() ? std::sqrt(gradient) : gradient;
  }

  double slope_noise(std::size_t lane) const {
    return 8 *
           (epsilon * first_gradient_[lane] * place_[lane] + std::numeric_limits<double>::min());
  }

  double slope_scale(std::size_t lane) const {
    if (!stages_.is_second_order()) return slope_[lane];
    return std::max(slope_[lane], 0.5 * std::sqrt(first_gradient_[lane]) * velocity_[lane]);
  }

  int waves_;
  std::size_t degrees_of_freedom_;
  const LaneStages& stages_;
  int s_;
  int order_;
  double pade_constant_;
  EachOrbit slope_{}, first_gradient_{}, last_gradient_{}, largest_gradient_{};
  EachOrbit place_{}, velocity_{}, defect_{}, displacement_{};
  /// The last two Legendre modes of the slopes and two before.
  std::array<EachOrbit, 4> modes_{};
};

}  // namespace hamjet
