#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/relative_motion/deputy_coordinates.hpp"

namespace hamjet {

/// Table `[deputy]`: the second satellite at the start.
struct DeputySettings {
  RelativeFrame frame = RelativeFrame::rtn_rotating;  ///< of the state, and of its motion
  RelativeState start;
};

/// A deputy at its arrival, relative to where its chief is then: a state along the axes of the
/// frame, or what takes its place.
struct ArrivalState : RelativeState {
  ArrivalState() = default;
  ArrivalState(const RelativeState& state) : RelativeState(state) {}
  ArrivalState(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity)
      : RelativeState{position, velocity} {}

  /// Six numbers of a form that is no linear function of the deviation (DeputyCoordinates).
  struct InForm {
    DeputyForm form = DeputyForm::curvilinear;
    std::array<double, 6> numbers{};
  };
  std::optional<InForm> in_form = {};
  /// The deputy's own inertial state (q, p) at its arrival, canonical.
  std::optional<std::array<double, 6>> own_state = {};

  bool is_along_axes() const { return !in_form && !own_state; }
  /// The canonical deviation (dq, dp) from a chief of an orbit with mu = 1. Throws
  /// Error(numerical) where the form is not defined at this chief.
  std::vector<double> deviation(const std::vector<double>& chief, const MetricUnits& units,
                                RelativeFrame frame) const;
};

/// A place on the way of a transfer, along the axes of its frame at that time.
struct Waypoint {
  double time = 0;  ///< canonical
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
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
  ArrivalState end;
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
  /// Least time between optimal impulses that this divides, canonical; absent: a 72nd of a period.
  std::optional<double> impulse_gap;
  /// Semi-axes along the chief's R, T, N of an ellipsoid about it that the deputy keeps out of.
  std::optional<Eigen::Vector3d> keep_out_m;
  /// The first of two impulses may wait so long for the least change, canonical; absent: it is not
  /// looked for.
  std::optional<double> longest_coast;
  /// By how many whole revolutions more than the chief a deputy is to make, for transfers that are
  /// far from it; empty: they are not looked for.
  std::vector<int> revolutions;
  std::vector<Waypoint> waypoints;  ///< moving away from 0; empty: none
  bool strict = false;              ///< an answer beyond the tolerance fails the command
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

/// What a box is about: a place at which the deputy is held at rest, or a deputy of `[bounded]`.
enum class BoxReference { rest, member };

/// Table `[bounded.box]`: a box along the chief's R, T and N that a deputy is kept in by impulses.
struct BoxSettings {
  std::optional<Eigen::Vector3d> half_widths_m;  ///< none: there is no box
  BoxReference reference = BoxReference::member;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< of `rest`
  /// Times that a return may take, in the chief's nodal periods at its start.
  std::vector<double> return_orbits = {0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.15,
                                       0.2,  0.3,  0.4,  0.6,  0.7, 0.8,  0.9};
  double days = 10;
};

/// Table `[bounded]`: deputies that stay with the chief for long.
struct BoundedSettings {
  std::vector<double> sizes_m = {1e3, 1e4, 1e5, 1e6};  ///< largest distances over a revolution
  /// Direction in which the eccentricity vector differs: at 0 the eccentricity grows, at 90 degrees
  /// the pericentre turns ahead.
  double phase_deg = 90;
  double cross_track = 0.5;  ///< by the node's difference, of the size; below 1
  double along_track = 0;    ///< mean place ahead of the chief, of the size; between -1 and 1
  int revolutions = 1000;    ///< over which drifts are the chief's, and are flown
  bool refine = true;        ///< also by Newton's method on flown drifts
  BoxSettings box;
};

/// A function of the state whose zeros are events: the height over the equator, that over a plane,
/// the distance from the centre less a radius, the product of position and velocity.
enum class EventSurface { equator, plane, distance, apsis };
/// Whether the function grows or falls with time at the event.
enum class EventDirection { either, rising, falling };

/// Table `[event]`: a condition along the orbit, whose time and state are wanted as polynomials.
struct EventSettings {
  EventSurface surface = EventSurface::equator;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of a plane, inertial
  double offset_km = 0;    ///< of a plane, along its normal from the centre
  double distance_km = 0;  ///< of `distance`
  EventDirection direction = EventDirection::either;
  int number = 1;  ///< among those that the chief meets after its start
  /// Sizes of the deviations in position with which deputies are flown.
  std::vector<double> amplitudes_m = {1, 10, 100, 1e3, 1e4};
};

/// How the transfer times of an assignment are chosen.
enum class AssignmentTime {
  per_pair,  ///< the best time for each deputy and slot
  common,    ///< one time for all
};

/// Table `[assignment]`: deputies and the slots that they may fill, in the frame of `[transfer]`.
struct AssignmentSettings {
  std::vector<RelativeState> deputies;
  std::vector<ArrivalState> slots;
  AssignmentTime time = AssignmentTime::per_pair;
  std::optional<double> keep_apart_m;  ///< that deputies on their ways may not come nearer than
};

}  // namespace hamjet
