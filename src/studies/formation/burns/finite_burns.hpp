#pragma once

#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The problem's system under a thruster that burns.
SharedSystem burning_system(const ComputedProblem& problem, const ThrusterSettings& thruster);

/// The burns of the scene's thruster in place of the two impulses at up to 48 of the transfer times
/// of a result whose least is known, and in place of its optimal impulses. Where the thruster is
/// too weak for the cheapest impulses, the least acceleration that is not is found too.
FiniteBurns finite_burns(const Scene& scene, const ComputedProblem& problem,
                         const TransferResult& result, const ProgressCallback& progress);

}  // namespace hamjet
