#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "time_expansion.hpp"

namespace hamjet {

/// Short flights of several states side by side, in double precision, by Taylor's method: with z(t)
/// = sum of z_k t^k,
///
///   z_(k+1) = f_k(z_0..z_k) / (k + 1) ,
///
/// where f_k is the k-th coefficient of the vector field on the series; each of its operations is
/// done once. This suits flights of a part of a revolution, in which an implicit method spends most
/// of its time on the set-up. Each state is a lane of the machine's vectors and has a time of its
/// own. A flight uses as many powers as its time needs: ten for 220 km along a low orbit, whose
/// products cost a sixth of those for the highest power. Source: A. Jorba and M. Zou, "A software
/// package for the numerical integration of ODEs by means of high-order Taylor methods",
/// Experimental Mathematics 14 (2005) 99.
///
/// An object has work space of its own, so that each thread needs one.
class TaylorFlow {
 public:
  static constexpr std::size_t lanes = 8;
  /// The highest power of time.
  static constexpr int order = 24;
  /// The highest power for systems with fields, whose monomials grow in number with its cube.
  static constexpr int highest_power_of_fields = 12;

  explicit TaylorFlow(SharedSystem system);

  /// Sets the state, of 2n numbers, about which a lane is to be expanded, and the system's clock at
  /// it. At a time at which the forces have no derivatives, the direction, 1 or -1, tells on which
  /// side the flight goes on.
  void set_state(std::size_t lane, const ClockTime& time, std::span<const double> state,
                 double direction = 1);
  /// Expands the flow of all lanes: to the highest power, or, for each of the first lanes, to the
  /// power that leaves out no more than rounding at its time in `times`. The power is chosen lane
  /// by lane, so that no digit of a lane depends on the others.
  void expand(std::span<const double> times = {});
  /// The power to which the last expansion of a lane went.
  int powers(std::size_t lane) const { return powers_[lane]; }
  /// A lane's unit of time, a power of two.
  double unit(std::size_t lane) const { return units_.lane(static_cast<int>(lane)); }
  /// The coefficient of a lane's component at a power of the time in that unit; 0 for those above
  /// the power to which the last expansion of the lane went.
  double coefficient(std::size_t lane, std::size_t component, int power) const {
    if (power > powers_[lane]) return 0;
    return field_.input(component)[power].lane(static_cast<int>(lane));
  }
  /// The time, forwards and backwards, within which a lane's polynomial leaves out no more than
  /// rounding; 0 if the vector field is not finite. Of that only a share is taken, if asked for. In
  /// the lane's direction it ends where the forces have no derivatives.
  double reach(std::size_t lane, double share = 1) const;
  /// Whether a step of a lane ends where the forces have no derivatives; it may be short.
  bool ends_at_break(std::size_t lane, double step) const {
    return std::abs(step) >= smooth_for_[lane];
  }
  /// The time, limited to the reach of the lane's polynomial.
  double within_reach(std::size_t lane, double time) const;
  /// The state of a lane at a time, counted from the state about which it was expanded.
  void evaluate(std::size_t lane, double time, std::span<double> state) const;

  /// Carries states, which all stand at `start_time` of the system's clock, along the flow, each
  /// over a time of its own, in as many expansions as needed. States that collide, or meet a field
  /// that is not finite, become NaN. `states` has 2n numbers for each.
  void advance(std::span<double> states, const ClockTime& start_time,
               std::span<const double> times);
  /// The same for states of which each stands at a time of its own of the system's clock.
  void advance(std::span<double> states, std::span<const double> start_times,
               std::span<const double> times);

 private:
  /// As `advance`, for no more states than lanes.
  void advance_lanes(std::span<double> states, std::span<const double> start_times,
                     std::span<const double> times);
  void set_state(std::size_t lane, double time, std::span<const double> state, double direction);
  /// The reach of a lane's polynomial alone.
  double reach_of_series(std::size_t lane) const;

  using Lanes = Pack<double, static_cast<int>(lanes)>;

  /// Chooses the units of the lanes from the present states and rates.
  void choose_units();
  void expand_in_units(std::span<const double> times);
  /// Shortens the units of the lanes whose highest power is not finite; whether there were any.
  bool shorten_overflowing_units();
  /// The sum of the squares of a power's coefficients, for positions or momenta, as fractions of
  /// the state.
  Lanes squares(int power, bool is_of_momenta) const;

  SharedSystem system_;
  int highest_power_;
  TimeExpansion<Lanes, double> field_;
  Lanes clock_;  ///< the system's clock at the states
  /// The times, in the lanes' directions, for which the forces have derivatives.
  std::array<double, lanes> smooth_for_{};
  /// The lanes' units. Coefficients belong to powers (t / unit)^k, so that in any units of the
  /// system they are about as large as the state, and their squares neither vanish nor overflow.
  Lanes units_ = Lanes(1);
  std::array<Lanes, 2> inverse_sizes_;          ///< for the positions and for the momenta
  std::array<int, lanes> longest_exponents_{};  ///< of the units as powers of two
  std::array<int, lanes> powers_{};
  Lanes proved_;  ///< times that the last expansion is known to reach, if it ended early
};

}  // namespace hamjet
