#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "energy_error.hpp"
#include "hamjet/studies/propagation.hpp"
#include "thinned_list.hpp"

namespace hamjet {

/// Collects the nominal trajectory, from its start, and its energy error along an integration.
class NominalRecorder {
 public:
  NominalRecorder(const ComputedProblem& problem, std::size_t dimension)
      : problem_(problem), dimension_(dimension), energy_(problem.system, problem.nominal) {
    record(0, extended(problem.nominal));
  }

  void record(double time, const std::vector<Extended>& state) {
    last_energy_error_ = energy_.error(state);
    largest_ = std::max(largest_, std::abs(last_energy_error_));
    NominalPoint point{time, std::vector<double>(dimension_, 0), last_energy_error_};
    for (std::size_t i = 0; i < state.size(); ++i) {
      point.state[problem_.components[i]] = static_cast<double>(state[i]);
    }
    points_.add(std::move(point));
  }

  double largest_energy_error() const { return largest_; }
  double last_energy_error() const { return last_energy_error_; }

  /// The points, the last one always among them.
  std::vector<NominalPoint> take() { return points_.take(); }

 private:
  const ComputedProblem& problem_;
  std::size_t dimension_;
  EnergyError energy_;
  double largest_ = 0;
  double last_energy_error_ = 0;
  ThinnedList<NominalPoint> points_;
};

}  // namespace hamjet
