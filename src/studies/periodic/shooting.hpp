#pragma once

#include <vector>

#include "periodic_orbit.hpp"

namespace hamjet {

/// The linearised equations of shooting. Columns are the changes of the start, of the period and,
/// if it is an unknown, of the parameter, each in parts of its size; rows are in the same parts.
struct LinearShooting {
  Matrix<double>
      rows;  ///< derivatives of the conditions "the last arc ends at the start" and of the phase
  Vector<double>
      residuals;  ///< residuals of these conditions, after the other arcs' mismatches are taken out
  std::vector<Matrix<double>>
      of_states;  ///< derivatives of each node's state by the unknowns of the columns
  std::vector<Vector<double>> offsets;  ///< what takes out the mismatches, of each node
  double mismatch = 0;
};

/// A further equation: its gradient by the columns, of length 1, and its value in the same unit.
struct ShootingEquation {
  Vector<double> gradient;
  double value = 0;
};

/// The equations of a problem near one orbit, whose sizes make all unknowns comparable.
class Shooting {
 public:
  using Equations = std::function<std::vector<ShootingEquation>(const OrbitNodes&)>;
  struct Solution {
    OrbitNodes nodes;
    LinearShooting linear;
    int iterations = 0;
  };

  /// The problem must outlive this.
  Shooting(const PeriodicProblem& problem, const OrbitNodes& near);

  /// Starts move across the flow at this state.
  void set_phase(const OrbitNodes& nodes);

  Eigen::Index columns() const { return scale_.size(); }
  const Vector<double>& scale() const { return scale_; }

  /// Throws as integrate_gauss.
  LinearShooting linearize(const OrbitNodes& nodes) const;
  /// The nodes after a part of a step, which is in parts of the sizes.
  OrbitNodes moved(const OrbitNodes& nodes, const LinearShooting& linear,
                   const Vector<double>& step, double part) const;
  /// Start, period and parameter, in parts of their sizes.
  Vector<double> unknowns(const OrbitNodes& nodes) const;

  /// The equation "quantity = value".
  ShootingEquation held(const OrbitQuantity& quantity, double value, const OrbitNodes& nodes) const;
  /// The gradient of a quantity by the columns, not of length 1.
  Vector<double> gradient(const OrbitQuantity& quantity, const OrbitNodes& nodes) const;

  /// The solution of the equations together with the `further` ones. Throws Error(numerical) where
  /// Newton's method does not end within `most_iterations` steps.
  Solution solve(const OrbitNodes& guess, const Equations& further, int most_iterations) const;

 private:
  const PeriodicProblem* problem_;
  /// Flies an arc alone. Throws Error(numerical) where it takes far more steps than arcs near by:
  /// a trial that comes close to a centre of attraction would take them without end.
  void require_few_steps(const SharedSystem& system, const Vector<double>& start,
                         double time) const;

  SpacePointer space_;
  long most_steps_ = 0;
  Vector<double> scale_;
  Vector<double> phase_state_;
  Vector<double> phase_direction_;
};

/// An orbit from a solution of the equations. Throws Error(numerical) if it is none.
PeriodicOrbit orbit_of_solution(const PeriodicProblem& problem, Shooting::Solution solution,
                                const Vector<double>& scale);

}  // namespace hamjet
