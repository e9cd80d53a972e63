#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "hamjet/dynamics/slice_evaluator.hpp"
#include "hamjet/studies/propagation.hpp"
#include "thinned_list.hpp"

namespace hamjet {

/// Collects the nominal trajectory and its energy error along an integration.
class NominalRecorder {
 public:
  NominalRecorder(const ComputedProblem& problem, std::size_t dimension)
      : problem_(problem),
        dimension_(dimension),
        energy_(problem.system.hamiltonian,
                SeriesSpace::create(problem.system.hamiltonian.inputs(), 0), 0) {}

  template <class Number>
  void record(double time, const std::vector<Number>& state) {
    const double error = energy_error(state);
    largest_ = std::max(largest_, std::abs(error));
    NominalPoint point{time, std::vector<double>(dimension_, 0), error};
    for (std::size_t i = 0; i < state.size(); ++i) {
      point.state[problem_.components[i]] = static_cast<double>(state[i]);
    }
    last_energy_error_ = error;
    ++calls_;
    points_.add(std::move(point));
  }

  double largest_energy_error() const { return largest_; }
  double last_energy_error() const { return last_energy_error_; }

  /// The points, the last one always among them.
  std::vector<NominalPoint> take() { return points_.take(); }

 private:
  /// The energy is evaluated in extended precision: its own rounding would hide a good
  /// integrator's.
  template <class Number>
  double energy_error(const std::vector<Number>& state) {
    for (std::size_t i = 0; i < state.size(); ++i) *energy_.input(i) = Extended(state[i]);
    energy_.evaluate_constant_terms();
    const Extended value = *energy_.output(0);
    if (calls_ == 0) initial_ = value;
    const Extended scale = initial_ == 0 ? Extended(1) : Extended(abs(initial_));
    return static_cast<double>(Extended((value - initial_) / scale));
  }

  const ComputedProblem& problem_;
  std::size_t dimension_;
  SliceEvaluator<Extended, Extended> energy_;
  Extended initial_ = 0;
  double largest_ = 0;
  long calls_ = 0;
  double last_energy_error_ = 0;
  ThinnedList<NominalPoint> points_;
};

}  // namespace hamjet
