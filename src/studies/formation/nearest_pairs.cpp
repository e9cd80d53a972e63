#include "nearest_pairs.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <span>

#include "../exact_flow.hpp"
#include "flown_trajectory.hpp"
#include "single_transfer.hpp"

namespace hamjet {
namespace {

/// Where a deputy is at both ends of an interval, relative to the chief along inertial axes;
/// velocities are those within it.
struct Piece {
  RelativeState begin;
  RelativeState end;
};

/// Hermite's cubic from 0 to 1; `length_s` is the interval's.
Eigen::Vector3d place_in(const Piece& piece, double length_s, double u) {
  const double v = 1 - u;
  return v * v * (1 + 2 * u) * piece.begin.position_m + u * u * (3 - 2 * u) * piece.end.position_m +
         u * v * length_s * (v * piece.begin.velocity_m_s - u * piece.end.velocity_m_s);
}

/// One deputy's way through all times, the first of which is 0.
class Way {
 public:
  Way(const Scene& scene, const AssignedTransfer& assigned, std::span<const double> times,
      const std::vector<std::vector<double>>& chief)
      : units_(metric_units(scene)) {
    const SharedSystem system = make_system(scene);
    const TransferAnswer& answer = assigned.transfer.best();
    const RelativeFrame frame = scene.transfer->frame;
    RelativeState start = scene.assignment->deputies[assigned.deputy];
    start.velocity_m_s += answer.start_change_m_s;
    std::vector<double> state = sum(chief[0], ChiefFrame(chief[0], units_, frame).deviation(start));
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
      if (times[k] == assigned.transfer.time) {
        const RelativeState change = {Eigen::Vector3d::Zero(), answer.end_change_m_s};
        state = sum(state, ChiefFrame(chief[k], units_, frame).deviation(change));
      }
      const RelativeState begin = relative(state, chief[k]);
      state = exact_flow(system, state, times[k + 1] - times[k]);
      pieces_.push_back({begin, relative(state, chief[k + 1])});
    }
  }

  const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  static std::vector<double> sum(std::vector<double> a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    return a;
  }

  RelativeState relative(std::vector<double> state, const std::vector<double>& chief) const {
    for (std::size_t i = 0; i < state.size(); ++i) state[i] -= chief[i];
    return ChiefFrame(chief, units_, RelativeFrame::inertial).relative(state);
  }

  MetricUnits units_;
  std::vector<Piece> pieces_;
};

DeputyPair nearest_of(const Way& a, const Way& b, std::span<const double> times, double unit_s) {
  constexpr int parts = 8;
  const auto separation = [&](std::size_t k, double u) {
    const double length_s = (times[k + 1] - times[k]) * unit_s;
    return (place_in(a.pieces()[k], length_s, u) - place_in(b.pieces()[k], length_s, u)).norm();
  };
  std::size_t interval = 0;
  int part = 0;
  double least = separation(0, 0);
  for (std::size_t k = 0; k < a.pieces().size(); ++k) {
    for (int i = 0; i <= parts; ++i) {
      const double here = separation(k, static_cast<double>(i) / parts);
      if (!(here < least)) continue;
      least = here;
      interval = k;
      part = i;
    }
  }
  constexpr int bits = 26;
  std::uintmax_t most_evaluations = 100;
  const auto [u, turn] = boost::math::tools::brent_find_minima(
      [&](double at) { return separation(interval, at); }, std::max(0.0, (part - 1.0) / parts),
      std::min(1.0, (part + 1.0) / parts), bits, most_evaluations);
  DeputyPair pair;
  const bool is_between = turn < least;
  pair.separation_m = is_between ? turn : least;
  const double share = is_between ? u : static_cast<double>(part) / parts;
  pair.time = times[interval] + share * (times[interval + 1] - times[interval]);
  return pair;
}

}  // namespace

std::vector<DeputyPair> nearest_of_pairs(const Scene& scene,
                                         const std::vector<AssignedTransfer>& transfers) {
  constexpr IntervalCount points_of_way = {64, 64, 4096};
  std::vector<const AssignedTransfer*> flown;
  double last = 0;
  for (const AssignedTransfer& assigned : transfers) {
    if (!assigned.transfer.has_answer()) continue;
    flown.push_back(&assigned);
    if (std::abs(assigned.transfer.time) > std::abs(last)) last = assigned.transfer.time;
  }
  if (flown.size() < 2) return {};
  // Arrivals are ends of intervals, for there velocities jump.
  std::vector<double> times;
  const int count = interval_count(scene, last, points_of_way);
  for (int k = 0; k <= count; ++k) times.push_back(last * k / count);
  for (const AssignedTransfer* assigned : flown) times.push_back(assigned->transfer.time);
  std::sort(times.begin(), times.end(),
            [](double a, double b) { return std::abs(a) < std::abs(b); });
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const SharedSystem system = make_system(scene);
  std::vector<std::vector<double>> chief = {scene.nominal};
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    chief.push_back(exact_flow(system, chief.back(), times[k + 1] - times[k]));
  }
  std::vector<Way> ways;
  for (const AssignedTransfer* assigned : flown) ways.emplace_back(scene, *assigned, times, chief);
  std::vector<DeputyPair> pairs;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    for (std::size_t j = i + 1; j < ways.size(); ++j) {
      DeputyPair pair = nearest_of(ways[i], ways[j], times, scene.units.time_s);
      pair.first = flown[i]->deputy;
      pair.second = flown[j]->deputy;
      pairs.push_back(pair);
    }
  }
  return pairs;
}

}  // namespace hamjet
