#include "extreme_separations.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "../exact_flow.hpp"
#include "single_transfer.hpp"

namespace hamjet {
namespace {

/// The squared separation, in semi-axes of an ellipsoid, and half its derivative by time.
struct Separation {
  double square = 0;
  double half_rate = 0;
};

/// An interval in which the separation turns, and the extreme that cubic interpolation has there.
struct Turn {
  std::size_t first = 0;
  double square = 0;
};

class Extremes {
 public:
  /// Of a sphere of 1 m the frame may be any, for then the velocity of its axes does not matter.
  Extremes(const Scene& scene, const RelativeTrajectory& flown,
           const Eigen::Vector3d& semi_axes_m = Eigen::Vector3d::Ones())
      : scene_(scene), flown_(flown), semi_axes_m_(semi_axes_m), system_(make_system(scene)) {
    for (const RelativeState& state : flown.states) separations_.push_back(separation_of(state));
  }

  /// `sign` is 1 for the nearest and -1 for the farthest.
  SeparationAt find(double sign) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < separations_.size(); ++k) {
      if (sign * separations_[k].square < sign * separations_[best].square) best = k;
    }
    SeparationAt extreme{flown_.times[best], flown_.states[best]};
    std::vector<Turn> turns = turns_of(sign);
    constexpr std::size_t most_turns = 8;
    const std::size_t tried = std::min(most_turns, turns.size());
    std::partial_sort(
        turns.begin(), turns.begin() + static_cast<std::ptrdiff_t>(tried), turns.end(),
        [&](const Turn& a, const Turn& b) { return sign * a.square < sign * b.square; });
    for (std::size_t i = 0; i < tried; ++i) {
      const SeparationAt found = flown_to_turn(turns[i].first);
      const double least = ratio(extreme.state);
      if (sign * ratio(found.state) < sign * least) extreme = found;
    }
    return extreme;
  }

  double ratio(const RelativeState& state) const {
    return state.position_m.cwiseQuotient(semi_axes_m_).norm();
  }

 private:
  Separation separation_of(const RelativeState& state) const {
    const Eigen::Vector3d place = state.position_m.cwiseQuotient(semi_axes_m_);
    const Eigen::Vector3d velocity = state.velocity_m_s.cwiseQuotient(semi_axes_m_);
    return {place.squaredNorm(), place.dot(velocity) * scene_.units.time_s};
  }

  std::vector<Turn> turns_of(double sign) const {
    std::vector<Turn> turns;
    for (std::size_t k = 0; k + 1 < separations_.size(); ++k) {
      const double h = flown_.times[k + 1] - flown_.times[k];
      const Separation& a = separations_[k];
      const Separation& b = separations_[k + 1];
      // Backwards in time the rate changes its sign.
      const double start = 2 * a.half_rate * h, end = 2 * b.half_rate * h;
      if (!(sign * start < 0 && sign * end > 0)) continue;
      Turn turn{k, a.square};
      constexpr int parts = 32;
      for (int i = 1; i <= parts; ++i) {
        const double u = static_cast<double>(i) / parts, v = 1 - u;
        // Hermite's cubic.
        const double square = v * v * (1 + 2 * u) * a.square + u * u * (3 - 2 * u) * b.square +
                              u * v * (v * start - u * end);
        if (sign * square < sign * turn.square) turn.square = square;
      }
      turns.push_back(turn);
    }
    return turns;
  }

  SeparationAt flown_to_turn(std::size_t first) const {
    const double h = flown_.times[first + 1] - flown_.times[first];
    const auto fly = [&](double time) {
      const std::vector<double> chief = exact_flow(system_, flown_.chief[first], time);
      std::vector<double> difference = exact_flow(system_, flown_.deputy[first], time);
      for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= chief[i];
      return ChiefFrame(chief, metric_units(scene_), flown_.frame).relative(difference);
    };
    std::uintmax_t most_flights = 40;
    const auto bracket = boost::math::tools::toms748_solve(
        [&](double time) { return separation_of(fly(time)).half_rate; }, 0.0, h,
        separations_[first].half_rate, separations_[first + 1].half_rate,
        boost::math::tools::eps_tolerance<double>(30), most_flights);
    const double time = (bracket.first + bracket.second) / 2;
    return {flown_.times[first] + time, fly(time)};
  }

  const Scene& scene_;
  const RelativeTrajectory& flown_;
  Eigen::Vector3d semi_axes_m_;
  SharedSystem system_;
  std::vector<Separation> separations_;
};

}  // namespace

double separation_m(const RelativeState& state) { return state.position_m.norm(); }

ExtremeSeparations extreme_separations(const Scene& scene, const RelativeTrajectory& flown) {
  const Extremes extremes(scene, flown);
  return {extremes.find(1), extremes.find(-1)};
}

double least_ratio(const Scene& scene, const RelativeTrajectory& flown,
                   const Eigen::Vector3d& semi_axes_m) {
  const Extremes extremes(scene, flown, semi_axes_m);
  return extremes.ratio(extremes.find(1).state);
}

}  // namespace hamjet
