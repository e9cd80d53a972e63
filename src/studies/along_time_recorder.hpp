#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "hamjet/detail/studies/run_along_time.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/maps/exactness.hpp"
#include "hamjet/maps/generating_function.hpp"

namespace hamjet {

/// Observes an integration: its energy error and, for one kind of generating function, the
/// exactness residual of degree 0.
class AlongTimeRecorder {
 public:
  AlongTimeRecorder(std::string label, double duration,
                    const std::optional<GeneratingFunctionKind>& kind,
                    const ComputedProblem& problem)
      : duration_(duration),
        momentum_exponent_(problem.momentum_exponent),
        kind_(kind),
        linear_space_(SeriesSpace::create(problem.variables.size(), 1)) {
    result_.label = std::move(label);
  }

  /// Records the state after a step; it must be called after every step.
  template <class Real>
  void record(double time, const FlowJet<Real>& jet, double energy_error) {
    if (std::abs(time) < next_ && time != duration_) return;
    next_ = std::abs(time) + std::abs(duration_) / watched_points;
    RunAlongTime::Point point;
    point.time = time;
    point.energy_error = energy_error;
    if (kind_) measure_exactness(jet, point);
    result_.points.push_back(point);
  }

  /// The record. `singular` are the flow's singular times, see times_without_kind; if the
  /// integration failed, only those before its end are kept.
  RunAlongTime take(const TimesWithoutKind& singular) {
    const double reached = result_.points.empty() ? 0 : std::abs(result_.points.back().time);
    for (const double time : singular.times) {
      if (std::abs(time) <= reached) result_.singular_times.push_back(time);
    }
    result_.not_searched = singular.not_searched;
    return std::move(result_);
  }

 private:
  static constexpr int watched_points = 400;

  template <class Real>
  void measure_exactness(const FlowJet<Real>& jet, RunAlongTime::Point& point) const {
    FlowJet<Extended> linear;
    for (const auto& component : jet) {
      linear.emplace_back(linear_space_);
      for (std::size_t k = 0; k < linear_space_->size(); ++k) {
        linear.back()[k] = convert<Extended>(component[k]);
      }
    }
    const std::vector<Series<Extended>>& map = linear;
    point.condition = condition_number(inverted_block(map, *kind_, momentum_exponent_));
    if (point.condition < largest_condition(std::numeric_limits<double>::epsilon())) {
      const auto rounding = static_cast<double>(std::numeric_limits<Extended>::epsilon());
      const auto inversion = invert_partially<Extended>(map, *kind_, rounding, momentum_exponent_);
      point.exactness = exactness_residual(one_form(inversion))[0].scaled;
    }
  }

  double duration_;
  int momentum_exponent_;
  std::optional<GeneratingFunctionKind> kind_;
  SpacePointer linear_space_;
  RunAlongTime result_;
  double next_ = 0;
};

}  // namespace hamjet
