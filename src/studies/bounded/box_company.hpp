#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "../../algebra/state_sums.hpp"
#include "../../integrators/taylor_flow.hpp"
#include "../formation/single_transfer.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The chief, the deputy and the reference, flown side by side.
class Company {
 public:
  Company(const Scene& scene, std::vector<double> chief, std::vector<double> deputy,
          std::vector<double> member)
      : settings_(&scene.bounded->box), units_(metric_units(scene)), now_(scene.start_time) {
    for (const auto* state : {&chief, &deputy, &member}) {
      states_.insert(states_.end(), state->begin(), state->end());
    }
  }

  void advance(TaylorFlow& flow, double time) {
    std::array<double, 3> times;
    times.fill(time);
    flow.advance(states_, now_, std::span(times).first(states_.size() / numbers_of_state));
    now_ = now_ + time;
    for (const double x : states_) {
      if (!std::isfinite(x)) {
        throw Error(ErrorKind::numerical, "bounded: the flight in the box ends in a collision");
      }
    }
  }

  const ClockTime& now() const { return now_; }
  std::vector<double> chief() const { return state(0); }
  std::vector<double> deputy() const { return state(1); }
  void set_deputy(std::span<const double> deputy) {
    std::copy(deputy.begin(), deputy.end(), states_.begin() + numbers_of_state);
  }
  /// The reference's deviation from the chief.
  std::vector<double> reference() const {
    if (settings_->reference == BoxReference::member) return state_difference(state(2), chief());
    return frame().deviation({settings_->position_m, Eigen::Vector3d::Zero()});
  }
  std::vector<double> deviation() const { return state_difference(deputy(), chief()); }
  ChiefFrame frame() const { return {chief(), units_, RelativeFrame::rtn_rotating}; }
  Eigen::Vector3d place_m() const { return frame().relative(deviation()).position_m; }
  Eigen::Vector3d from_reference_m() const {
    return frame().relative(state_difference(deviation(), reference())).position_m;
  }
  /// The largest of the distances from the reference, in parts of the box.
  double part() const {
    return from_reference_m().cwiseQuotient(*settings_->half_widths_m).cwiseAbs().maxCoeff();
  }

 private:
  static constexpr std::size_t numbers_of_state = 6;

  std::vector<double> state(std::size_t lane) const {
    const auto first = states_.begin() + static_cast<std::ptrdiff_t>(lane * numbers_of_state);
    return {first, first + numbers_of_state};
  }

  const BoxSettings* settings_;
  MetricUnits units_;
  ClockTime now_;  ///< the system's clock at the states
  std::vector<double> states_;
};

}  // namespace hamjet
