#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hamjet/integrators/energy_conserving.hpp"

namespace hamjet {

/// The result of the equation of one step: the step, or the reason why there is none.
template <class Real>
struct StepAttempt {
  bool is_taken = false;
  Real size = 0;
  std::vector<Real> end;
  int iterations = 0;
  EnergyConservingStopCause cause =
      EnergyConservingStopCause::no_root;  ///< cause, if the step was not taken
  std::string
      reason;  ///< if the step was not taken, the reason with numbers, but without step and time
};

template <class Real>
StepAttempt<Real> refused(EnergyConservingStopCause cause, std::string reason) {
  StepAttempt<Real> attempt;
  attempt.cause = cause;
  attempt.reason = std::move(reason);
  return attempt;
}

inline constexpr const char* not_finite_reason =
    "the Hamiltonian is not finite (a collision, or a point outside its domain)";

/// If round-off may change a step size by more than this fraction, the size counts as undetermined.
inline constexpr double largest_step_uncertainty = 0.01;

}  // namespace hamjet
