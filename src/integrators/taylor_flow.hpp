#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "time_expansion.hpp"

namespace hamjet {

/// Short flights of several states side by side, in double precision, by Taylor's method: with
/// z(t) = sum of z_k t^k,
///
///   z_(k+1) = f_k(z_0..z_k) / (k + 1) ,
///
/// f_k the k-th coefficient of the vector field on the series, of which each operation is done
/// once. For flights of a part of a revolution, where an implicit method spends most on its set-up;
/// each state is a lane of the machine's vectors and has a time of its own. A flight takes as many
/// powers as its time needs: of 220 km along a low orbit ten, whose products cost a sixth of those
/// of the highest power. Source: A. Jorba and M. Zou, "A software package for the numerical
/// integration of ODEs by means of high-order Taylor methods", Experimental Mathematics 14 (2005)
/// 99.
///
/// An object has work space of its own: each thread needs one.
class TaylorFlow {
 public:
  static constexpr std::size_t lanes = 8;
  /// The highest power of time.
  static constexpr int order = 24;

  explicit TaylorFlow(SharedSystem system);

  /// Sets the state, of 2n numbers, that a lane is to be expanded about.
  void set_state(std::size_t lane, std::span<const double> state);
  /// Expands the flow of all lanes: to the highest power, or to those at which each of the first
  /// lanes leaves out no more than rounding at its time of `times`. A lane has powers of its own,
  /// so that no digit of it depends on the others.
  void expand(std::span<const double> times = {});
  /// The power that a lane's last expansion went to.
  int powers(std::size_t lane) const { return powers_[lane]; }
  /// A lane's unit of time, a power of two.
  double unit(std::size_t lane) const { return units_.lane(static_cast<int>(lane)); }
  /// Of a lane's component, the coefficient of a power of the time in that unit.
  double coefficient(std::size_t lane, std::size_t component, int power) const {
    return field_.input(component)[power].lane(static_cast<int>(lane));
  }
  /// The time, either way, within which a lane's polynomial leaves out no more than rounding; 0
  /// where the vector field is not finite.
  double reach(std::size_t lane) const;
  /// A time, or as much of it as the lane's polynomial reaches.
  double within_reach(std::size_t lane, double time) const;
  /// A lane's state at a time from the one that it was expanded about.
  void evaluate(std::size_t lane, double time, std::span<double> state) const;

  /// Carries the states of so many lanes along the flow, each by a time of its own, in as many
  /// expansions as it takes; those of collisions, or of a field that is not finite, become NaN.
  /// `states` has 2n numbers for each.
  void advance(std::span<double> states, std::span<const double> times);

 private:
  /// `advance` of no more states than lanes.
  void advance_lanes(std::span<double> states, std::span<const double> times);

  using Lanes = Pack<double, static_cast<int>(lanes)>;

  /// The units of the lanes, of states and rates that are there.
  void choose_units();
  /// Of the positions, or of the momenta, the sum of the squares of a power's coefficients, in
  /// parts of the state.
  Lanes squares(int power, bool is_of_momenta) const;

  SharedSystem system_;
  TimeExpansion<Lanes, double> field_;
  /// Of the lanes' coefficients, which are those of (t / unit)^k: whatever units the system is in,
  /// they are about as large as the state, and their squares neither vanish nor overflow.
  Lanes units_ = Lanes(1);
  std::array<Lanes, 2> inverse_sizes_;  ///< of the positions and of the momenta
  std::array<int, lanes> powers_{};
  Lanes proved_;  ///< times that the last expansion is known to reach, where it ended early
};

}  // namespace hamjet
