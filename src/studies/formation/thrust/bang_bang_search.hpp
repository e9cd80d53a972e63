#pragma once

#include <optional>
#include <string>
#include <vector>

#include "switched_flight.hpp"

namespace hamjet {

/// A transfer by thrust below a limit, in canonical units.
struct BangBangTask {
  std::vector<double> start;            ///< six numbers
  std::vector<double> end;              ///< likewise
  std::vector<double> energy_costates;  ///< at the start, of the least integral of |u|^2 / 2
  double energy_largest = 0;            ///< the largest |u| of that thrust
  double most = 0;                      ///< the largest |u| that is allowed, at the start
  double inverse_exhaust = 0;           ///< see SwitchedThrust; 0 if the mass stays the same
  double tolerance = 0;                 ///< of the end, and at most
};

/// The thrust of least fuel for it, or how far it was followed.
struct BangBangThrust {
  std::vector<double> costates;  ///< at the start, where thrust is switched at the length 1
  std::vector<ThrustSpan> flown;
  SwitchedFlight::State miss = SwitchedFlight::State::Zero();
  int steps = 0;    ///< from the energy-optimal thrust on
  int flights = 0;  ///< without derivatives
  /// If the limit is too low, the lowest to which thrust was followed.
  std::optional<double> lowest;
  std::string failure;  ///< if not empty, the reason why there is none
};

/// Follows the thrust of least energy, which is that of SwitchedThrust with e = 1 and a limit that
/// it does not meet, to a small e, then to the task's limit, and then to e = 0, each time by
/// Newton's method from where the tangent leads. Of e = 0 an answer is taken only if it does not
/// take more fuel than the smoothed thrust that it comes from, which is allowed too. A deputy that
/// arrives by coasting needs none. A falling mass comes after that, and after it the limit again if
/// it is below what least energy asks for; what fuel such an answer takes is not compared. A search
/// that takes too many flights is given up, and so is one whose limit is far above that of least
/// energy.
BangBangThrust bang_bang_thrust(const SwitchedFlight& flight, const BangBangTask& task);

}  // namespace hamjet
