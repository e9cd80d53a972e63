#include "energy_conservation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../../algebra/raise_to.hpp"
#include "../energy_error.hpp"
#include "../exact_flow.hpp"
#include "../thinned_list.hpp"
#include "fixed_step_trajectory.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {
namespace {

/// The zero of StepCondition along the exact flow near a stop, by the secant method, started where
/// the stop itself predicts it.
std::optional<double> predicted_time(const EnergyConservationStudy& study,
                                     const DynamicalSystem& system,
                                     const EnergyConservingStop& stop, double last_step) {
  constexpr int iterations = 40;
  constexpr double largest_distance = 30;  // in steps
  if (!stop.steps_to_sign_change || !(std::abs(*stop.steps_to_sign_change) < largest_distance)) {
    return std::nullopt;
  }
  StepCondition<double> condition(system, study.method);
  try {
    // One flow leads to the stop; the secant method evaluates only its neighbourhood.
    const std::vector<double> at_stop =
        exact_flow(system, study.nominal, ClockTime::epoch(), stop.time);
    const auto value = [&](double time) {
      return condition(exact_flow(system, at_stop, ClockTime(stop.time), time - stop.time));
    };
    double before = stop.time;
    double time = stop.time + *stop.steps_to_sign_change * last_step;
    double value_before = value(before);
    for (int k = 0; k < iterations; ++k) {
      const double here = value(time);
      const double change = here * (time - before) / (here - value_before);
      if (here == 0 || std::abs(change) <= 1e-12 * (std::abs(time) + std::abs(last_step))) {
        return time;
      }
      before = std::exchange(time, time - change);
      value_before = here;
      if (!(std::abs(time - stop.time) < largest_distance * std::abs(last_step))) break;
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
  }
  return std::nullopt;
}

/// Whether a stop is caused by the method's step equation, and not by a start or place that the
/// scene should not have.
bool is_of_the_method(const EnergyConservingStop& stop) {
  return stop.cause != EnergyConservingStopCause::not_finite &&
         stop.cause != EnergyConservingStopCause::no_midpoint;
}

/// Runs the energy-conserving method and keeps the data that the report needs.
class EnergyConservingTrajectory {
 public:
  EnergyConservingTrajectory(const DynamicalSystem& system, EnergyConservationResult& result,
                             const ProgressCallback& progress)
      : result_(result),
        progress_(progress),
        condition_(system, result.study.method),
        energy_(system, result.study.nominal, ClockTime::epoch()) {
    const EnergyConservationStudy& study = result.study;
    result.run = integrate_energy_conserving<double>(
        {system, study.method, study.nominal, study.first_step, study.duration},
        [this](const EnergyConservingStep<double>& step) { observe(step); });
    EnergyConservationPoint last;
    last.step = result.run.steps;
    last.time = result.run.time;
    last.state = result.run.state;
    last.energy_error = energy_.error(extended(last.state), ClockTime(last.time));
    last.condition = condition_(last.state);
    raise_to(result.largest_energy_error, std::abs(last.energy_error));
    points_.add(std::move(last));
    result.points = points_.take();
  }

 private:
  void observe(const EnergyConservingStep<double>& step) {
    const EnergyConservationStudy& study = result_.study;
    if (progress_) progress_("energy-conserving trajectory", step.time / study.duration);
    const Extended discrete = energy_.value(
        discrete_energy_point<Extended>(study.method, extended(step.start), extended(step.end)),
        ClockTime(step.time));
    if (step.index == 0) conserved_ = discrete;
    EnergyConservationPoint point{step.index,
                                  step.time,
                                  step.size,
                                  step.start,
                                  energy_.relative(discrete - conserved_),
                                  energy_.error(extended(step.start), ClockTime(step.time)),
                                  step.condition,
                                  step.newton_iterations};
    const double size = std::abs(step.size);
    result_.smallest_step = step.index == 0 ? size : std::min(result_.smallest_step, size);
    result_.largest_step = std::max(result_.largest_step, size);
    raise_to(result_.largest_discrete_error, std::abs(*point.discrete));
    raise_to(result_.largest_energy_error, std::abs(point.energy_error));
    points_.add(std::move(point));
  }

  EnergyConservationResult& result_;
  const ProgressCallback& progress_;
  StepCondition<double> condition_;
  EnergyError energy_;
  Extended conserved_ = 0;  ///< the discrete energy of the first step
  ThinnedList<EnergyConservationPoint> points_;
};

bool is_expected_stop(const EnergyConservationResult& result) {
  return result.study.expected == EnergyConservationOutcome::stops &&
         is_of_the_method(*result.run.stop);
}

void check(EnergyConservationResult& result) {
  const EnergyConservationStudy& study = result.study;
  if (study.expected == EnergyConservationOutcome::stops && !result.run.stop) {
    result.failed_checks.push_back(
        fmt::format("expect = \"stops\": it completed, {} steps to t = {:.10g}", result.run.steps,
                    result.run.time));
  }
  if (study.require_energy_error &&
      !(result.largest_discrete_error <= *study.require_energy_error)) {
    result.failed_checks.push_back(
        fmt::format("require_energy_error = {}: the largest discrete energy error is {:.3g}",
                    *study.require_energy_error, result.largest_discrete_error));
  }
}

}  // namespace

int EnergyConservationResult::exit_code() const {
  if (run.stop && !is_expected_stop(*this)) return static_cast<int>(ErrorKind::numerical);
  return failed_checks.empty() ? 0 : static_cast<int>(ErrorKind::check_failed);
}

std::string EnergyConservationResult::failure() const {
  if (run.stop && !is_expected_stop(*this)) return run.stop->message;
  return fmt::format("{}", fmt::join(failed_checks, "; "));
}

EnergyConservationResult run_study(const EnergyConservationStudy& study,
                                   const ProgressCallback& progress) {
  const DynamicalSystem system = make_system(study.system, study.canonical_radius);
  EnergyConservationResult result;
  result.study = study;
  EnergyConservingTrajectory(system, result, progress);
  const double mean_step = result.run.steps > 0
                               ? std::abs(result.run.time) / static_cast<double>(result.run.steps)
                               : study.first_step;
  const double end = result.run.stop ? study.duration : result.run.time;
  result.fixed_step =
      fixed_step_trajectory(system, study.method, study.nominal, mean_step, end, progress);
  if (result.run.stop && result.run.steps > 0) {
    result.predicted_time = predicted_time(study, system, *result.run.stop, result.run.last_step);
  }
  check(result);
  return result;
}

}  // namespace hamjet
