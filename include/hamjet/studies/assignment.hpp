#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The cheapest transfer of one deputy to one slot.
struct AssignmentCost {
  std::optional<std::size_t> time;  ///< index into the transfer times; absent: no answer at any
  double total_change_m_s = 0;
};

/// A deputy sent to a slot.
struct AssignedTransfer {
  std::size_t deputy = 0;
  std::size_t slot = 0;
  TransferPoint transfer;  ///< proved by flying
};

/// The least separation of two deputies on their ways.
struct DeputyPair {
  std::size_t first = 0;
  std::size_t second = 0;
  double time = 0;  ///< canonical
  double separation_m = 0;
};

/// All results of the study of table `[assignment]`.
struct AssignmentResult {
  Scene scene;  ///< with `transfer` and `assignment`
  std::string integrator;
  ChosenCoordinates coordinates;                   ///< of the polynomials; not automatic
  std::vector<std::vector<AssignmentCost>> costs;  ///< [deputy][slot], each at its best time (or at
                                                   ///< the common one)
  std::optional<std::size_t> common_time;          ///< index, where the scene asks for one
  std::vector<AssignedTransfer> transfers;         ///< in the order of the deputies that have one
  /// Of each pair of deputies that fly, while they do; see AssignmentSettings::keep_apart_m.
  std::vector<DeputyPair> pairs;
  double total_change_m_s = 0;
  double flight_floor_m = 0;
  double study_seconds = 0;
  double proof_seconds = 0;
  std::vector<SelfCheck> checks;  ///< of the chief's flight; transfers have marks of their own
  std::string
      failure;  ///< not empty: there are not as many transfers as deputies or slots, and why
};

/// The study of table `[assignment]`: a matrix of velocity changes from the generating functions of
/// `[transfer]`'s times, and the assignment of least total (a flow of least cost; Boost Graph), of
/// as many pairs as there are of the fewer, deputies or slots. Only transfers away from
/// singularities count; those chosen are proved by flying. Throws as study_transfer.
AssignmentResult study_assignment(const Scene& scene, const ProgressCallback& progress = {});

/// The pair that comes nearest; none of fewer than two deputies.
std::optional<DeputyPair> nearest_pair(const AssignmentResult& result);

/// Those of `count` deputies, or slots, that no transfer has.
std::vector<std::size_t> left_out(const std::vector<AssignedTransfer>& transfers, std::size_t count,
                                  std::size_t AssignedTransfer::*which);

/// Exit code: 0; 1 if a self-check failed, if a chosen transfer is not as the scene allows, if two
/// deputies come nearer than the scene's `keep_apart_m`, or if the scene is strict and a chosen
/// transfer is beyond its tolerance or could not be refined; 4 if there is no assignment, or a
/// chosen transfer has no answer.
int exit_code(const AssignmentResult& result);

}  // namespace hamjet
