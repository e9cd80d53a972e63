#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "hamjet/dynamics/slice_evaluator.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Collects the nominal trajectory and its energy error along an integration. When it has grown to
/// its largest size every second point is dropped, so that a million steps fit too.
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
    last_ = std::move(point);
    if (calls_++ % stride_ != 0) return;
    points_.push_back(last_);
    if (points_.size() < largest_size) return;
    for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = std::move(points_[2 * i]);
    points_.resize((points_.size() + 1) / 2);
    stride_ *= 2;
  }

  double largest_energy_error() const { return largest_; }
  double last_energy_error() const { return last_.energy_error; }

  /// The points, the last one always among them.
  std::vector<NominalPoint> take() {
    if (points_.empty() || points_.back().time != last_.time) points_.push_back(last_);
    return std::move(points_);
  }

 private:
  static constexpr std::size_t largest_size = 20001;

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
  long stride_ = 1;
  NominalPoint last_;
  std::vector<NominalPoint> points_;
};

}  // namespace hamjet
