#pragma once

#include <vector>

#include "hamjet/detail/algebra/pack.hpp"

namespace hamjet {

/// How far the steps of a Gauss integration have come.
template <class Real>
struct GaussStepping {
  long taken = 0;  ///< steps
  Real time = 0;
  Real lost_time = 0;  ///< see add_compensated; with controlled steps
  Real proposed = 0;   ///< size of the next step
  Real previous_step = 0;
  long remaining_steps = 0;  ///< with fixed steps
};

/// Where the nominal of a Gauss integration stands between two steps: all that its next steps
/// depend on.
template <class Real, int Lanes>
struct GaussCheckpoint {
  std::vector<Real> state;
  std::vector<Real> lost;  ///< of the state, to rounding; empty if not compensated
  GaussStepping<Real> at;
  std::vector<Pack<Real, Lanes>> slopes;  ///< of the last step's stages
  bool is_by_newton = false;              ///< see StageSlopes
  std::vector<Real> end_slope;
};

}  // namespace hamjet
