#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The times at which steps of a flight must end: those at which the system's forces have no
/// derivatives, and the end of the duration. Times are counted from the start of the flight.
template <class Real>
class StepEnds {
 public:
  StepEnds(const DynamicalSystem& system, const ClockTime& start_time, const Real& duration)
      : is_backwards_(duration < 0) {
    const std::vector<double>& breaks = system.break_times;
    const auto start = start_time.template in<Extended>();
    for (const double time : breaks) {
      const Real after = convert<Real>(Extended(time - start));
      // A step of no more than the rounding of the clock would end at a time that is no other one.
      const double rounding = nearness * std::abs(time);
      const double from_start = std::abs(static_cast<double>(after));
      const double to_end = std::abs(static_cast<double>(Real(duration - after)));
      const bool is_inside =
          is_backwards_ ? after < 0 && after > duration : after > 0 && after < duration;
      if (is_inside && from_start > rounding && to_end > rounding) ends_.push_back(after);
    }
    if (is_backwards_) std::reverse(ends_.begin(), ends_.end());
    ends_.push_back(duration);
  }
  explicit StepEnds(const FlowProblem<Real>& problem)
      : StepEnds(*problem.system, problem.start_time, problem.duration) {}

  /// The first end that a flight meets after a time; that of the duration if there is no other.
  const Real& after(const Real& time) const {
    const auto next = std::upper_bound(
        ends_.begin(), ends_.end() - 1, time,
        [this](const Real& a, const Real& b) { return is_backwards_ ? b < a : a < b; });
    return *next;
  }

  /// Times of the clock that differ by less than this part of them are the same.
  static constexpr double nearness = 1e-14;

 private:
  bool is_backwards_;
  std::vector<Real> ends_;  ///< in the order in which the flight meets them
};

/// The proposal for the step after one that was cut by an end within the flight: the cut says
/// nothing about the length that the error allows, so that a step may be as long as it was to be.
template <class Real>
Real proposal_after_cut(const Real& proposed, const Real& wanted) {
  return std::abs(static_cast<double>(proposed)) < std::abs(static_cast<double>(wanted)) ? wanted
                                                                                         : proposed;
}

}  // namespace hamjet
