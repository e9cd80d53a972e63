#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "../energy_error.hpp"
#include "../lowest_point.hpp"
#include "../stopwatch.hpp"
#include "../thinned_list.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Collects the nominal trajectory from its start, its energy error along an integration and, if
/// requested, its lowest point.
class NominalRecorder {
 public:
  NominalRecorder(const ComputedProblem& problem, std::size_t dimension,
                  bool finds_lowest_point = false)
      : problem_(problem),
        dimension_(dimension),
        energy_(*problem.system, problem.nominal, problem.start_time) {
    if (finds_lowest_point) lowest_point_.emplace(problem);
    result_.initial = static_cast<double>(energy_.initial());
    record(0, extended(problem.nominal));
    result_.initial_terms = result_.largest_terms;
  }

  /// The time is since the problem's start.
  void record(double time, const std::vector<Extended>& state) {
    record_energy(time, state);
    NominalPoint point{time, std::vector<double>(dimension_, 0), last_energy_error_};
    std::vector<double> rounded;
    for (std::size_t i = 0; i < state.size(); ++i) {
      rounded.push_back(static_cast<double>(state[i]));
      point.state[problem_.components[i]] = rounded.back();
    }
    if (lowest_point_) lowest_point_->record(time, rounded);
    points_.add(std::move(point));
  }

  double largest_energy_error() const { return largest_; }
  double last_energy_error() const { return last_energy_error_; }
  const EnergyAlongNominal& energy() const { return result_; }

  /// The points recorded; the last one is always among them.
  std::vector<NominalPoint> take() { return points_.take(); }
  std::optional<LowestPoint> lowest_point() {
    return lowest_point_ ? std::optional(lowest_point_->take()) : std::nullopt;
  }

 private:
  void record_energy(double time, const std::vector<Extended>& state) {
    const Stopwatch stopwatch(result_.seconds);
    const Extended change = energy_.value(state, problem_.start_time + time) - energy_.initial();
    last_energy_error_ = energy_.relative(change);
    keep_largest(largest_, last_energy_error_);
    keep_largest(result_.largest_change, static_cast<double>(change));
    keep_largest(result_.largest_terms, energy_.terms(state));
  }

  /// Raises a maximum; NaN counts as infinite, because it must not be lost.
  static void keep_largest(double& largest, double value) {
    largest = std::isnan(value) ? std::numeric_limits<double>::infinity()
                                : std::max(largest, std::abs(value));
  }

  const ComputedProblem& problem_;
  std::size_t dimension_;
  EnergyError energy_;
  EnergyAlongNominal result_;
  double largest_ = 0;
  double last_energy_error_ = 0;
  std::optional<LowestPointSearch> lowest_point_;
  ThinnedList<NominalPoint> points_;
};

}  // namespace hamjet
