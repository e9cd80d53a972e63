#pragma once

#include <cstddef>
#include <functional>

#include "hamjet/detail/studies/energy_optimal.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The thrust of least energy for each of at most 48 of the scene's transfer times. One jet of the
/// flow of states and costates about the coasting chief (see costate_system) is propagated through
/// all of them; at each time its generating function F1 gives costates and cost for the ends by
/// evaluation. Each answer is flown, and corrected by flying. Throws Error(too_large) if the jets
/// would not fit the memory.
EnergyOptimalTransfers energy_optimal_transfers(const Scene& scene, const ComputedProblem& problem,
                                                const ProgressCallback& progress);

/// What the polynomials of one time answer for the ends of a scene's transfer, which may be those
/// of any pair of a deputy and a slot.
struct EnergyOptimalPairs {
  /// The least integral of |u|^2 / 2 by the generating function. Throws Error(numerical) for an end
  /// that the chief's orbit does not define.
  std::function<double(const Scene& pair)> energy_m2_s3;
  /// The transfer, corrected by flying.
  std::function<EnergyOptimalTransfer(const Scene& pair)> transfer;
};

/// Calls `visit` for each of the scene's transfer times at which the states can be commanded.
void visit_energy_optimal(const Scene& scene, const ComputedProblem& orbit,
                          const std::function<void(std::size_t, EnergyOptimalPairs&)>& visit);

}  // namespace hamjet
