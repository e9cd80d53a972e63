#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/dynamics/thrust_axes.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/relative_motion/deputy_coordinates.hpp"

namespace hamjet {

/// A velocity change that a spacecraft's orbit message tells: an impulse, or a burn whose direction
/// stays the same along its axes.
struct Manoeuvre {
  double start = 0;   ///< since the scene's start, in canonical units
  double length = 0;  ///< of the burn; 0 for an impulse
  ThrustAxes axes = ThrustAxes::inertial;
  Eigen::Vector3d change = Eigen::Vector3d::Zero();  ///< along these axes, canonical
  /// The part of the mass that the burn takes at a constant rate; with 0 the acceleration is
  /// constant.
  double mass_share = 0;

  double end() const { return start + length; }
};

/// Table `[deputy]`: the second satellite at the start.
struct DeputySettings {
  RelativeFrame frame = RelativeFrame::rtn_rotating;  ///< frame of the state, and of its motion
  RelativeState start;
  std::optional<double> drag_m2_kg = {};       ///< C_D A / m; the chief's if absent
  std::optional<double> radiation_m2_kg = {};  ///< C_R A / m, likewise
  std::vector<Manoeuvre> manoeuvres = {};      ///< of its orbit message, in order of time
};

/// A deputy at its arrival, relative to the chief at that time: a state along the axes of the
/// frame, or one of the two members below in its place.
struct ArrivalState : RelativeState {
  ArrivalState() = default;
  ArrivalState(const RelativeState& state) : RelativeState(state) {}
  ArrivalState(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity)
      : RelativeState{position, velocity} {}

  /// Six numbers of a form that is a nonlinear function of the deviation (DeputyCoordinates).
  struct InForm {
    DeputyForm form = DeputyForm::curvilinear;
    std::array<double, 6> numbers{};
  };
  std::optional<InForm> in_form = {};
  /// The deputy's own inertial state (q, p) at its arrival, canonical.
  std::optional<std::array<double, 6>> own_state = {};

  bool is_along_axes() const { return !in_form && !own_state; }
  /// The canonical deviation (dq, dp) from a chief on an orbit with mu = 1. Throws Error(numerical)
  /// if the form is not defined at this chief.
  std::vector<double> deviation(const std::vector<double>& chief, const MetricUnits& units,
                                RelativeFrame frame) const;
};

/// A place through which a transfer passes, along the axes of its frame at that time.
struct Waypoint {
  double time = 0;  ///< in canonical units
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

/// The number of impulses that a transfer may have.
enum class TransferImpulses {
  two,      ///< one at the start and one at the end
  optimal,  ///< in addition, impulses of least cost, of free number and times
};

/// The thrust by which a transfer is made.
enum class TransferThrust {
  impulses,        ///< impulses alone
  energy_optimal,  ///< in addition, a thrust that lasts, of least energy
  fuel_optimal,    ///< and, followed from it, one of least fuel within the thruster's acceleration
};

/// Table `[transfer.errors]`: errors drawn at random under which the law of feedback is flown. They
/// are independent, of mean 0, and given by standard deviations.
struct ThrustErrorSettings {
  /// Of the state that the controller believes at each of its instants, along the axes of the
  /// frame.
  RelativeState navigation;
  /// Of the thrust: of its size, as a share of the size, and of its direction about each of the two
  /// axes across it. Both stay the same between instants.
  double magnitude = 0;
  double direction_deg = 0;
  int samples = 200;
  std::uint64_t seed = 1;
};

/// Table `[transfer]`: from one relative state to another in given times.
struct TransferSettings {
  RelativeFrame frame = RelativeFrame::rtn_rotating;  ///< frame of both ends
  /// Velocities are those before the first impulse and after the second one. A velocity that is
  /// absent is zero: at rest in the frame.
  RelativeState start;
  ArrivalState end;
  std::vector<double> times;  ///< in canonical units, moving away from 0; none is 0
  /// F1..F4, letters, or auto: the kind whose polynomials decay fastest, with hysteresis.
  std::string kind = "auto";
  double tolerance_m = 1;  ///< a larger miss of the highest order is marked
  /// Whether to correct all answers by flying until the miss is below `refined_miss_m`. Answers
  /// beyond the tolerance that are away from singularities are corrected in any case.
  bool refine = false;
  double refined_miss_m = 1e-3;
  /// Answers nearer than this, in canonical time, to a time at which positions cannot be commanded
  /// are marked.
  double singular_margin = 0;
  TransferImpulses impulses = TransferImpulses::two;
  TransferThrust thrust = TransferThrust::impulses;
  int thrust_order = 3;  ///< the order of the jets in states and costates, twelve variables
  std::optional<double> largest_thrust_m_s2;  ///< largest acceleration that its thruster has
  int feedback = 0;  ///< instants at which the law of feedback is told; 0 for none
  std::optional<ThrustErrorSettings> errors;  ///< under which the law is flown
  std::optional<double> budget_m_s;  ///< if given, spans of time are sought in which a transfer
                                     ///< costs no more than this
  std::optional<double> largest_impulse_m_s;  ///< largest impulse that a transfer may have
  /// If the largest impulse divides optimal impulses, the least time between the parts, in
  /// canonical units; absent for a 72nd of a period.
  std::optional<double> impulse_gap;
  /// Semi-axes, along the chief's R, T, N, of an ellipsoid about the chief that the deputy must not
  /// enter.
  std::optional<Eigen::Vector3d> keep_out_m;
  /// The longest time, in canonical units, that the first of two impulses may wait for a cheaper
  /// transfer; absent if this is not sought.
  std::optional<double> longest_coast;
  /// Numbers of whole revolutions by which a deputy may exceed the chief, for transfers that lead
  /// far from the chief; empty if these are not sought.
  std::vector<int> revolutions;
  std::vector<Waypoint> waypoints;  ///< places to pass, at times moving away from 0; may be empty
  bool strict = false;              ///< an answer beyond the tolerance makes the command fail
};

/// The axes in which the direction of a thrust stays the same during a burn.
enum class BurnAttitude {
  rtn,       ///< R, T, N of the spacecraft's own orbit, with which it turns
  inertial,  ///< the inertial axes of the orbit
};

/// Table `[thruster]`: what makes the velocity changes of `[transfer]`.
struct ThrusterSettings {
  double acceleration_m_s2 = 0;       ///< the acceleration of the full spacecraft
  std::optional<double> exhaust_m_s;  ///< if absent, the acceleration stays the same
  double mass_kg = 0;  ///< the mass of the full spacecraft; used with `exhaust_m_s` alone
  std::optional<double> propellant_kg;  ///< the propellant on board; absent if none is counted
  std::optional<double> longest_burn_s;
  std::optional<double> shortest_burn_s;
  BurnAttitude attitude = BurnAttitude::rtn;
};

/// Table `[validity]`: the separation up to which a polynomial's miss stays below a tolerance.
struct ValiditySettings {
  double tolerance_m = 1;
  std::vector<double> times;  ///< in canonical units, moving away from 0; none is 0
  /// Semi-axes of the ellipsoid of positions along the axes of the frame, relative to the largest.
  /// The velocities, of the frame's kind, fill the same ellipsoid times the mean motion.
  std::vector<double> semi_axes = {1, 1, 1};
  int samples = 40;  ///< number of deputies that are flown
  RelativeFrame frame = RelativeFrame::rtn_rotating;
  /// If given, the domains are counted that a set of this separation is split into at the last
  /// time, and no more than so many are made.
  std::optional<double> separation_m = {};
  int most_domains = 256;
};

/// The deputy in a box: one held at rest at a place, or a deputy of `[bounded]`.
enum class BoxReference { rest, member };

/// Table `[bounded.box]`: a box along the chief's R, T and N in which impulses keep a deputy.
struct BoxSettings {
  std::optional<Eigen::Vector3d> half_widths_m;  ///< absent if there is no box
  BoxReference reference = BoxReference::member;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< place of a deputy at rest
  /// Durations that a return may have, in units of the chief's nodal period at its start.
  std::vector<double> return_orbits = {0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.15,
                                       0.2,  0.3,  0.4,  0.6,  0.7, 0.8,  0.9};
  double days = 10;
};

/// Table `[bounded]`: deputies that stay with the chief for long.
struct BoundedSettings {
  std::vector<double> sizes_m = {1e3, 1e4, 1e5, 1e6};  ///< largest distances over a revolution
  /// Direction of the difference of the eccentricity vectors: at 0 degrees the eccentricity grows,
  /// at 90 degrees the pericentre turns ahead.
  double phase_deg = 90;
  double cross_track = 0.5;  ///< part of the size that the difference of the nodes makes; below 1
  double along_track =
      0;  ///< mean place ahead of the chief, as a fraction of the size; between -1 and 1
  int revolutions =
      1000;  ///< number of revolutions over which the drifts equal the chief's and that are flown
  bool refine = true;  ///< whether to refine by Newton's method on flown drifts
  BoxSettings box;
};

/// A function of the state whose zeros are events: the height above the equator, the height above a
/// plane, the distance from the centre minus a radius, the product of position and velocity, or an
/// expression in the names of the scene's variables.
enum class EventSurface { equator, plane, distance, apsis, expression };
/// Whether the function grows or falls with time at the event.
enum class EventDirection { either, rising, falling };

/// Table `[event]`: a condition along the orbit, whose time and state are computed as polynomials.
struct EventSettings {
  EventSurface surface = EventSurface::equator;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< normal of a plane, in inertial axes
  double offset_km = 0;    ///< distance of a plane from the centre, along its normal
  double distance_km = 0;  ///< radius for `distance`
  std::string
      expression;  ///< for `expression`: of an orbit in km and km/s, else as the scene has it
  EventDirection direction = EventDirection::either;
  int number = 1;  ///< number of the event, among those that the chief meets after its start
  /// Sizes of the position deviations of the deputies that are flown.
  std::vector<double> amplitudes_m = {1, 10, 100, 1e3, 1e4};
};

/// Table `[periodic.family]`: how a family of periodic orbits is followed.
struct PeriodicFamilySettings {
  std::string along;           ///< "energy", "period", a variable, or "parameters." and a name
  double to = 0;               ///< the last member's value of it, as the scene tells it
  std::optional<double> step;  ///< of it between members; absent for a twentieth of the way
  int members = 200;           ///< the most
};

/// Table `[periodic]`: a periodic orbit near the nominal.
struct PeriodicSettings {
  double period = 0;            ///< the guess, in canonical units
  std::string hold = "energy";  ///< "energy", "period" or a variable
  std::optional<double> value;  ///< of what is held, as the scene tells it; absent: the guess's
  int arcs = 4;                 ///< the number of arcs of multiple shooting
  double tolerance = 1e-10;  ///< the tolerance of the arcs' mismatch, in parts of the orbit's size
  std::optional<PeriodicFamilySettings> family;  ///< absent for one orbit
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
  /// Least distance that deputies must keep from each other on their ways.
  std::optional<double> keep_apart_m;
};

}  // namespace hamjet
