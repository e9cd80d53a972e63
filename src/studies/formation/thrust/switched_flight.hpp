#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "../../../dynamics/thrusting_system.hpp"
#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/dynamics/clock_time.hpp"

namespace hamjet {

/// How the size of a thrust follows from the length p of the primer vector: with the largest
/// acceleration a it takes the least integral of a ((1 - e) s + e s^2), where s = |u| / a is
///
///   s = (p - 1 + e) / (2 e) , not below 0 and not above 1.
///
/// With e = 1 that is the thrust of least energy below a, with e = 0 that of least fuel, which is
/// full where p > 1 and zero where p < 1. (Bertrand and Epenoy, Optimal Control Applications and
/// Methods 23, 2002.)
struct SwitchedThrust {
  double most = 0;       ///< a, canonical; at the start where the mass falls
  double smoothing = 0;  ///< e, from 0 to 1
  /// Where the mass falls, one over the speed of the exhaust, and e = 0: the acceleration grows
  /// with the change w that was spent as a exp(w / exhaust). The costate of w, which is 1 at the
  /// start and grows while there is thrust, then stands for the 1 at which the thrust is switched.
  double inverse_exhaust = 0;

  bool mass_falls() const { return inverse_exhaust > 0; }
  bool operator==(const SwitchedThrust&) const = default;
};

enum class ThrustPhase { off, between, full };

/// A part of a flight in which the thrust follows one law.
struct ThrustSpan {
  ThrustPhase phase = ThrustPhase::off;
  double start = 0;
  double end = 0;
  std::vector<double> state;  ///< states and costates at the start, twelve numbers
  double primer_rate = 0;     ///< of the primer vector's length, at the switch at the start
  double acceleration = 0;    ///< the full acceleration at the start
  double threshold = 1;       ///< the length of the primer vector at which thrust is switched

  double length() const { return end - start; }
};

/// The flights of states with costates over one time, whose thrust is switched where the primer
/// vector -lambda_v passes the thresholds of the law. Each phase is flown to rounding by Taylor's
/// method, on whose polynomials the times of the switches are found.
class SwitchedFlight {
 public:
  static constexpr std::size_t states = 6;
  using State = Eigen::Matrix<double, 6, 1>;
  using Commanded = Eigen::Matrix<double, 6, 7>;

  /// The system has three degrees of freedom, and momenta that are velocities.
  SwitchedFlight(const DynamicalSystem& system, const ClockTime& start_time, double duration);

  double duration() const noexcept { return duration_; }
  bool is_autonomous() const noexcept { return is_autonomous_; }

  /// The phases of a flight, and its last state as the start of a phase of no length. Throws
  /// Error(numerical) if a field is not finite, or for more than some hundred switches.
  std::vector<ThrustSpan> fly(const std::vector<double>& start, const SwitchedThrust& law) const;
  /// How the state of the end moves with the costates of the start (six columns), and when the law
  /// moves by `change` (the seventh): the flow of each phase, and what the switches in between are
  /// later. Throws as integrate_gauss.
  Commanded commanded(const std::vector<ThrustSpan>& flown, const SwitchedThrust& law,
                      const SwitchedThrust& change) const;

  /// A time on the way, with the states, costates and their rates there.
  struct Instant {
    double time;
    ThrustPhase phase;
    const std::vector<double>& state;
    const std::vector<double>& rates;
    double acceleration;  ///< full
    double threshold;     ///< see ThrustSpan
  };
  /// Visits the start and the end of every phase and times in between: `each_step` equal parts of
  /// each step of the integration.
  void visit(const std::vector<ThrustSpan>& flown, const SwitchedThrust& law, int each_step,
             const std::function<void(const Instant&)>& visitor) const;
  /// A flight at ascending times, as phases that begin and end there.
  std::vector<ThrustSpan> at(const std::vector<ThrustSpan>& flown, const SwitchedThrust& law,
                             const std::vector<double>& times) const;

 private:
  const SharedSystem& system_of(ThrustPhase phase, const SwitchedThrust& law) const;
  Commanded commanded_across_switches(const std::vector<ThrustSpan>& flown,
                                      const SwitchedThrust& law,
                                      const SwitchedThrust& change) const;

  SharedSystem coasting_;  ///< and of a linear thrust
  SharedSystem directed_;
  SharedSystem falling_;
  ClockTime start_time_;
  double duration_;
  bool is_autonomous_;
};

/// The length of the primer vector of states with costates.
double primer_length(const std::vector<double>& state);

}  // namespace hamjet
