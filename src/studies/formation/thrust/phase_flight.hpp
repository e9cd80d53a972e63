#pragma once

#include <cstddef>
#include <vector>

#include "../../../integrators/taylor_flow.hpp"
#include "switched_flight.hpp"

namespace hamjet {

/// The costates of the velocities, whose opposite is the primer vector.
Eigen::Vector3d primer_costate(const std::vector<double>& state);

/// Whether the thrust of a phase is linear in the costates, as none is too.
bool is_linear(ThrustPhase phase, double smoothing);

/// The parameters of a phase's system (thrusting_system), if the mass stays the same.
std::vector<double> parameters_of(const ThrustSpan& span, const SwitchedThrust& law);

/// The steps of one phase by Taylor's method, whose polynomials tell what happens within a step.
/// System, phase and law must outlive it.
class PhaseFlight {
 public:
  static constexpr std::size_t states = SwitchedFlight::states;

  PhaseFlight(const SharedSystem& system, const ThrustSpan& span, const SwitchedThrust& law,
              const ClockTime& start_time);

  double now() const { return now_; }
  double unit() const { return flow_.unit(0); }
  /// Whether the thrust burns a mass that falls.
  bool burns_mass() const { return falls_; }
  /// As a phase that begins here.
  ThrustSpan place() const { return place_of(state_, now_); }

  /// Expands about the present state; the length of the step that may be taken, up to a time.
  /// Throws Error(numerical) where there is none.
  double expand(double to);
  /// The squared length of the primer vector as a polynomial of the time in units. While mass is
  /// burnt the threshold moves, and its square is taken off, so that the threshold becomes 0.
  std::vector<double> switching_function() const;
  /// The place at a time after the present one, and the rates of its state.
  ThrustSpan evaluate(double after, std::vector<double>& rates) const;
  void step(double length);
  /// A step of a length, but no further than to a time, which rounding shall not miss.
  void step(double length, double to);

 private:
  void evaluate(double after, std::vector<double>& all, std::vector<double>* rates) const;
  std::vector<double> outer(const std::vector<double>& all) const;
  ThrustSpan place_of(const std::vector<double>& all, double time) const;
  double direction_reach() const;

  TaylorFlow flow_;
  ClockTime start_time_;
  const ThrustSpan& span_;
  const SwitchedThrust& law_;
  bool is_directed_;
  bool falls_;
  std::size_t first_costate_;
  double now_;
  std::vector<double> state_;  ///< what is integrated: with parameters, and with what a mass needs
};

}  // namespace hamjet
