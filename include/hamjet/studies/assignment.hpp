#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The cheapest transfer of one deputy to one slot.
struct AssignmentCost {
  /// Index into the transfer times; absent if no time has an answer.
  std::optional<std::size_t> time;
  double total_change_m_s = 0;  ///< of two impulses
  /// With a thrust that lasts, which is then what counts: the integral of |u|^2 / 2 by the
  /// generating function.
  double energy_m2_s3 = 0;
};

/// A deputy sent to a slot.
struct AssignedTransfer {
  std::size_t deputy = 0;
  std::size_t slot = 0;
  TransferPoint transfer;  ///< the transfer, proved by flying; without an answer beside a thrust
  std::optional<EnergyOptimalTransfer> thrust = {};  ///< if the scene asks for a thrust that lasts
};

/// The least separation of two deputies during their transfers.
struct DeputyPair {
  std::size_t first = 0;
  std::size_t second = 0;
  double time = 0;  ///< in canonical units
  double separation_m = 0;
};

/// All results of the study of table `[assignment]`.
struct AssignmentResult {
  Scene scene;  ///< with `transfer` and `assignment`
  std::string integrator;
  ChosenCoordinates coordinates;  ///< coordinates of the polynomials; not automatic
  /// [deputy][slot], each at its best time (or at the common time).
  std::vector<std::vector<AssignmentCost>> costs;
  /// Index of the time, if the scene asks for a common one.
  std::optional<std::size_t> common_time;
  std::vector<AssignedTransfer> transfers;  ///< in the order of the deputies that have a transfer
  /// For each pair of deputies that fly, while both fly; see AssignmentSettings::keep_apart_m.
  std::vector<DeputyPair> pairs;
  double total_change_m_s = 0;    ///< of a thrust that lasts, the integrals of |u|
  double total_energy_m2_s3 = 0;  ///< of a thrust that lasts, the integrals of |u|^2 / 2
  double flight_floor_m = 0;
  double study_seconds = 0;
  double proof_seconds = 0;
  /// Checks of the chief's flight; transfers have marks of their own.
  std::vector<SelfCheck> checks;
  std::string failure;  ///< if not empty, the reason why some deputies or slots have no transfer
};

/// The study of table `[assignment]`. Velocity changes for all pairs come from the generating
/// functions at the times of `[transfer]`. The assignment has as many pairs as there are deputies
/// or slots, whichever are fewer, and the least total (a flow of least cost; Boost Graph). Only
/// transfers away from singularities count; the chosen ones are proved by flying. With a thrust
/// that lasts the least total is that of the integrals of |u|^2 / 2, from the generating function
/// of states and costates; nothing is then said of pairs of deputies. Throws as study_transfer.
AssignmentResult study_assignment(const Scene& scene, const ProgressCallback& progress = {});

/// The pair that comes nearest; no value for fewer than two deputies.
std::optional<DeputyPair> nearest_pair(const AssignmentResult& result);

/// The indices, below `count`, of the deputies (or slots) that have no transfer.
std::vector<std::size_t> left_out(const std::vector<AssignedTransfer>& transfers, std::size_t count,
                                  std::size_t AssignedTransfer::*which);

/// Exit code: 0; 1 if a self-check failed, if a chosen transfer is not as the scene allows (its
/// impulses or its thrust), if two deputies come nearer than the scene's `keep_apart_m`, or if the
/// scene is strict and a chosen transfer is beyond its tolerance or could not be refined; 4 if
/// there is no assignment, or a chosen transfer has no answer.
int exit_code(const AssignmentResult& result);

}  // namespace hamjet
