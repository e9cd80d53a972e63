#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet {

/// Table `[deputy]`: the second satellite at the start.
struct DeputySettings {
  RelativeFrame frame = RelativeFrame::rtn_rotating;  ///< of the state, and of its motion
  RelativeState start;
};

/// How many impulses a transfer may have.
enum class TransferImpulses {
  two,      ///< at the start and at the end
  optimal,  ///< beside these the least, as many and when it likes
};

/// Table `[transfer]`: from one relative state to another in given times.
struct TransferSettings {
  RelativeFrame frame = RelativeFrame::rtn_rotating;  ///< of both ends
  /// Velocities are those before the first impulse and after the second; absent ones are zero, at
  /// rest in the frame.
  RelativeState start;
  RelativeState end;
  std::vector<double> times;  ///< canonical, moving away from 0; none is 0
  /// F1..F4, letters, or auto: the one whose polynomials decay fastest, with hysteresis.
  std::string kind = "auto";
  double tolerance_m = 1;  ///< a larger miss of the highest order is marked
  /// Correct all answers by flying until the miss is below `refined_miss_m`; those beyond the
  /// tolerance, away from singularities, are corrected in any case.
  bool refine = false;
  double refined_miss_m = 1e-3;
  /// Answers nearer than this to a time at which positions cannot be commanded are marked;
  /// canonical.
  double singular_margin = 0;
  TransferImpulses impulses = TransferImpulses::two;
  std::optional<double> budget_m_s;           ///< times are sought that take no more than this
  std::optional<double> largest_impulse_m_s;  ///< that a transfer may have
  /// Semi-axes along the chief's R, T, N of an ellipsoid about it that the deputy keeps out of.
  std::optional<Eigen::Vector3d> keep_out_m;
  bool strict = false;  ///< an answer beyond the tolerance fails the command
};

/// Table `[validity]`: up to what separation a polynomial's miss stays below a tolerance.
struct ValiditySettings {
  double tolerance_m = 1;
  std::vector<double> times;  ///< canonical, moving away from 0; none is 0
  /// Semi-axes of the ellipsoid of positions relative to its largest, along the axes of the frame;
  /// the velocities, of the frame's kind, fill the same ellipsoid times the mean motion.
  std::vector<double> semi_axes = {1, 1, 1};
  int samples = 40;  ///< deputies that are flown
  RelativeFrame frame = RelativeFrame::rtn_rotating;
};

/// How the transfer times of an assignment are chosen.
enum class AssignmentTime {
  per_pair,  ///< the best time for each deputy and slot
  common,    ///< one time for all
};

/// Table `[assignment]`: deputies and the slots that they may fill, in the frame of `[transfer]`.
struct AssignmentSettings {
  std::vector<RelativeState> deputies;
  std::vector<RelativeState> slots;  ///< as many as deputies
  AssignmentTime time = AssignmentTime::per_pair;
  std::optional<double> keep_apart_m;  ///< that deputies on their ways may not come nearer than
};

}  // namespace hamjet
