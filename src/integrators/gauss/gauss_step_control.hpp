#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "../real_number.hpp"
#include "../summed_jet.hpp"
#include "gauss_step_rule.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "stage_slopes.hpp"

namespace hamjet {

/// Chooses the steps of a Gauss method from the nominal, by the rule of GaussStepRule; see
/// GaussSettings and integrate_gauss.
template <class Real, int Lanes>
class GaussStepControl {
 public:
  using P = Pack<Real, Lanes>;

  /// Refers to objects of the integrator that it serves; these must outlive it.
  GaussStepControl(const GaussSettings& settings, StageSlopes<Real, Lanes>& stages,
                   SummedJet<Real, Lanes>& jet, int order)
      : settings_(settings),
        stages_(stages),
        jet_(jet),
        rule_(settings.stages, stages.system().second_order(), order,
              static_cast<double>(std::numeric_limits<Real>::epsilon())) {}

  /// The first step, from the gradient at the start; `point` must have been evaluated there.
  Real first_step(SliceEvaluator<Real, Real>& point, const Real& duration) {
    const auto entry = [&](std::size_t c, std::size_t k) { return point.output_gradient(c, k); };
    const ComponentUnits& units = stages_.units();
    const Real norm = units.row_norm(entry, units.template blocks<Real>(entry).inverse_sigma());
    const double span = static_cast<double>(duration);
    const double h = rule_.first_step(static_cast<double>(norm), *settings_.tolerance, span);
    return std::abs(h) == std::abs(span) ? duration : Real(h);
  }

  /// Distance, at the start of the step, between the slope and the collocation polynomial.
  double start_defect(const std::vector<Real>& end_slope) const {
    return static_cast<double>(stages_.template largest_component<Real>(
        [&](std::size_t c) { return stages_.slope_at_start(c) - end_slope[c]; }));
  }

  double error_estimate(const Real& h, const std::vector<Real>& start_slope, double time_noise) {
    StepMeasures step;
    step.defect = start_defect(start_slope);
    step.slope = stages_.largest_slope();
    const P gradients = stages_.gradient_sizes();
    step.first_gradient = static_cast<double>(gradients.lane(0));
    step.largest_gradient = static_cast<double>(largest_magnitude(gradients));
    step.place = static_cast<double>(
        stages_.template largest_component<Real>([&](std::size_t c) { return jet_.constant(c); }));
    step.velocity = velocity();
    step.time_noise = time_noise;
    return rule_.error_estimate(step, static_cast<double>(h),
                                [this](int degree) { return mode(degree); });
  }

  /// The step h from a state, shortened so that the stages sample the field's shortest wave.
  template <class State>
  Real sampling_step(const Real& h, const DynamicalSystem& system, const State& state) const {
    const double longest = longest_sampling_step(system, state);
    if (!(static_cast<double>(magnitude(h)) > longest)) return h;
    return h < 0 ? Real(-longest) : Real(longest);
  }

  /// Number of periods of the linearised motion in a step.
  double periods(const Real& h) {
    StepMeasures step;
    step.largest_gradient = stages_.largest_gradient();
    return rule_.periods(step, static_cast<double>(h));
  }

  /// The weights of the Legendre mode of degree s - 1.
  const P& last_mode_weights() const { return stages_.system().coefficients().modes.back(); }

  double reduction(double error) const { return rule_.reduction(error, *settings_.tolerance); }

  /// GaussStepRule::growth of the step whose stages are known.
  double growth(double error) {
    StepMeasures step;
    const P gradients = stages_.gradient_sizes();
    step.first_gradient = static_cast<double>(gradients.lane(0));
    step.last_gradient = static_cast<double>(gradients.lane(settings_.stages - 1));
    return rule_.growth(error, *settings_.tolerance, rule_.time_scale_ratio(step));
  }

 private:
  /// GaussStepRule::longest_sampling_step from a state; infinite if the system has no such field.
  template <class State>
  double longest_sampling_step(const DynamicalSystem& system, const State& state) const {
    if (system.waves_on_a_circle == 0) return std::numeric_limits<double>::infinity();
    const std::size_t n = system.degrees_of_freedom;
    double distance = 0;
    double speed = 0;
    for (std::size_t c = 0; c < n; ++c) {
      distance = std::hypot(distance, static_cast<double>(state(c)));
      speed = std::hypot(speed, static_cast<double>(state(n + c)));
    }
    return rule_.longest_sampling_step(system.waves_on_a_circle, distance / speed);
  }

  /// The largest component of the slopes' Legendre mode of one degree, which is below s.
  double mode(int degree) {
    const P& weights = stages_.system().coefficients().modes[static_cast<std::size_t>(degree)];
    return static_cast<double>(stages_.template largest_component<Real>(
        [&](std::size_t c) { return dot(weights, stages_.slopes()[c]); }));
  }

  double velocity() {
    if (!stages_.system().second_order()) return 0;
    const std::size_t m = stages_.system().components();
    double result = 0;
    for (std::size_t c = 0; c < m; ++c) {
      result = std::max(result, std::abs(static_cast<double>(jet_.constant(m + c))));
    }
    if (!stages_.system().unit_mass()) {
      result *= std::abs(static_cast<double>(stages_.system().inverse_mass(0, 0)));
    }
    return result;
  }

  const GaussSettings& settings_;
  StageSlopes<Real, Lanes>& stages_;
  SummedJet<Real, Lanes>& jet_;
  GaussStepRule rule_;
};

}  // namespace hamjet
