#pragma once

#include <span>
#include <vector>

#include "../formation/validity/flown_deputies.hpp"
#include "event_study.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The value of an event's condition at a state.
double condition_at(const EventCondition<double>& condition, std::span<const double> state);

/// Deputies flown to the events that polynomials predict for them. Their deviations, of one size in
/// position and of that times the mean motion in velocity (of systems without an orbit, over the
/// time of the event), are random ones, and those at which the
/// degrees that decide about the error contribute most to the place of the event: near a surface
/// that the flow almost touches, misses differ by powers of ten from direction to direction, and
/// random ones would tell of the usual alone.
class EventFlights {
 public:
  /// `steering` is a map of order 2 at least, of which the highest degree and the second choose the
  /// deviations. All arguments must outlive this object.
  EventFlights(const Scene& scene, const EventCondition<double>& condition,
               const EventMap<double>& map, const EventMap<double>& steering);

  int count() const { return static_cast<int>(directions_.size()); }
  EventMisses fly(double amplitude_m) const;

 private:
  struct Miss {
    double position_m = 0;
    double time_s = 0;
  };
  double metres() const { return scene_.units.length_km * 1000; }
  Miss largest_miss(double amplitude_m, bool is_linear) const;
  Miss miss(const std::vector<double>& deviation, bool is_linear) const;

  const Scene& scene_;
  const EventCondition<double>& condition_;
  const EventMap<double>& map_;
  SharedSystem system_;
  /// Mean motion of a circle through the chief's start; one over the event's time without an orbit.
  double mean_motion_;
  Matrix<double> to_canonical_;      ///< of a direction, for an amplitude of a metre
  std::vector<Vector6> directions_;  ///< a unit vector of position and one of velocity
};

}  // namespace hamjet
