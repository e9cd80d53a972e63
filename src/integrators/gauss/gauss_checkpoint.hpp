#pragma once

#include <vector>

#include "hamjet/detail/algebra/pack.hpp"

namespace hamjet {

/// The progress of a Gauss integration through its steps.
template <class Real>
struct GaussStepping {
  long taken = 0;  ///< number of steps taken
  Real time = 0;
  Real lost_time = 0;  ///< see add_compensated; for controlled steps
  Real proposed = 0;   ///< size of the next step
  Real previous_step = 0;
  long remaining_steps = 0;  ///< for fixed steps
  double time_noise = 0;     ///< see StepMeasures
};

/// The slopes at a point of the nominal: the vector field, or what the collocation polynomial of
/// the step that ends there makes of it.
template <class Real>
struct EndSlope {
  std::vector<Real> value;
  bool is_evaluated = false;
};

/// The nominal of a Gauss integration between two steps: all data on which its next steps depend.
template <class Real, int Lanes>
struct GaussCheckpoint {
  std::vector<Real> state;
  std::vector<Real> lost;  ///< rounding lost by the state; empty if not compensated
  GaussStepping<Real> at;
  std::vector<Pack<Real, Lanes>> slopes;  ///< slopes of the last step's stages
  bool is_by_newton = false;              ///< see StageSlopes
  double contraction = 0;                 ///< see StageIteration
  EndSlope<Real> end_slope;
};

}  // namespace hamjet
