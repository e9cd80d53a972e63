#include "bang_bang_search.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The share of the smoothed thrust's cost that is quadratic while its limit moves: burns then
/// appear and vanish smoothly.
constexpr double moving_smoothing = 0.1;
/// The flights of a search, counted in phases: a few thousand are usual.
constexpr long most_phases_flown = 6000;
/// The miss that an answer may have, in parts of that of the deputy that coasts. What it costs is
/// then right to a few parts of this, whatever miss the task allows.
constexpr double most_of_coasting_miss = 1e-6;
/// A miss that is rounding, in canonical units.
constexpr double rounded_miss = 1e-14;
/// A thruster so many times stronger than the thrust of least energy burns for so short that the
/// flights have no digits left.
constexpr double most_strength = 1e7;
/// A burn of the length L stays smoothed until e is below some L^2: this is one of 0.05 s in a low
/// orbit.
constexpr double least_smoothing = 1e-10;

class BangBangSearch {
 public:
  BangBangSearch(const SwitchedFlight& flight, const BangBangTask& task)
      : flight_(flight), task_(task) {}

  BangBangThrust run() {
    std::optional<Point> coasting =
        flown(std::vector<double>(SwitchedFlight::states, 0.0), {task_.most, 0});
    if (!coasting) return failed("the deputy cannot be flown without thrust");
    const double asked = coasting->miss.norm();
    if (asked <= rounded_miss) return found(std::move(*coasting));
    tolerance_ = std::min(task_.tolerance, std::max(rounded_miss, most_of_coasting_miss * asked));
    if (task_.most > most_strength * task_.energy_largest) {
      return failed(
          fmt::format("the thruster is {:.3g} times as strong as least energy asks for: its burns "
                      "are impulses",
                      task_.most / task_.energy_largest));
    }
    std::optional<Point> point = first();
    if (!point) return failed("the energy-optimal thrust is not found again");
    if (!follow(*point, {point->law.most, moving_smoothing}, 1e-3)) {
      return failed(fmt::format("the energy-optimal thrust was followed to {:.3g} parts of it only",
                                point->law.smoothing));
    }
    const double ratio = std::log(task_.most / point->law.most);
    // A thruster that is too weak at first may gain by the fall of the mass what it lacks.
    if (task_.inverse_exhaust > 0 && ratio < 0) return finished(std::move(*point));
    if (!follow(*point, {task_.most, moving_smoothing}, std::min(0.1, 0.005 / std::abs(ratio)))) {
      return failed_at(*point);
    }
    return finished(std::move(*point));
  }

 private:
  using State = SwitchedFlight::State;
  struct Point {
    SwitchedThrust law;
    std::vector<double> costates;
    std::vector<ThrustSpan> flown;
    State miss = State::Zero();
  };

  /// From a smoothed thrust to one without smoothing at the same limit; then to the task's fall of
  /// the mass, and last to its limit.
  BangBangThrust finished(Point point) {
    std::optional<Point> sharp = without_smoothing(point);
    if (!sharp) {
      return failed(
          fmt::format("the smoothed thrust was followed to {:.3g} parts of energy in its "
                      "cost, and none without was found",
                      point.law.smoothing));
    }
    if (!follow(*sharp, {sharp->law.most, 0, task_.inverse_exhaust}, 1e-3)) {
      return failed(fmt::format("thrust was followed to {:.3g} parts of the fall of the mass",
                                sharp->law.inverse_exhaust / task_.inverse_exhaust));
    }
    if (!follow(*sharp, {task_.most, 0, task_.inverse_exhaust}, 1e-3)) return failed_at(*sharp);
    return found(polished(std::move(*sharp)));
  }

  BangBangThrust failed_at(const Point& point) {
    if (task_.most < point.law.most) result_.lowest = point.law.most;
    return failed(
        fmt::format("thrust was followed to {:.4g} times the thruster's acceleration, "
                    "and no further",
                    point.law.most / task_.most));
  }
  BangBangThrust failed(std::string reason) {
    if (phases_ > most_phases_flown) reason += ", after so many flights that it was given up";
    result_.failure = std::move(reason);
    return std::move(result_);
  }
  BangBangThrust found(Point point) {
    result_.costates = std::move(point.costates);
    result_.flown = std::move(point.flown);
    result_.miss = point.miss;
    return std::move(result_);
  }

  /// The thrust with e = 0 and the same limit; the point is then the last smoothed one.
  std::optional<Point> without_smoothing(Point& point) {
    while (point.law.smoothing > least_smoothing) {
      if (std::optional<Point> sharp = sharpened(point)) return sharp;
      if (!follow(point, {point.law.most, point.law.smoothing / 10}, 1e-2)) break;
    }
    return std::nullopt;
  }

  /// On to rounding.
  Point polished(Point point) {
    for (int k = 0; k < 4; ++k) {
      std::optional<Point> better = improved(point);
      if (!better || better->miss.norm() > 0.5 * point.miss.norm()) break;
      point = std::move(*better);
    }
    return point;
  }

  std::optional<Point> first() {
    constexpr double above = 1.02;  // the largest of the nodes of an integral
    Point point;
    point.law = {above * task_.energy_largest, 1};
    for (const double costate : task_.energy_costates) {
      point.costates.push_back(2 / point.law.most * costate);
    }
    return solved(point.costates, point.law);
  }

  std::optional<Point> flown(const std::vector<double>& costates, const SwitchedThrust& law) {
    Point point{law, costates, {}, State::Zero()};
    std::vector<double> start = task_.start;
    start.insert(start.end(), costates.begin(), costates.end());
    if (phases_ > most_phases_flown) return std::nullopt;
    ++result_.flights;
    try {
      point.flown = flight_.fly(start, law);
      phases_ += static_cast<long>(point.flown.size());
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      constexpr long phases_of_failure = 50;
      phases_ += phases_of_failure;
      return std::nullopt;
    }
    for (std::size_t i = 0; i < SwitchedFlight::states; ++i) {
      point.miss[static_cast<Eigen::Index>(i)] = point.flown.back().state[i] - task_.end[i];
    }
    return point;
  }

  std::optional<SwitchedFlight::Commanded> commanded(const Point& point,
                                                     const SwitchedThrust& change) {
    phases_ += static_cast<long>(point.flown.size());
    try {
      const auto matrix = flight_.commanded(point.flown, point.law, change);
      return matrix.allFinite() ? std::optional(matrix) : std::nullopt;
    } catch (const Error& error) {
      // More steps than are ever taken are a path that is not followed either.
      if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
      return std::nullopt;
    }
  }

  static std::vector<double> moved(std::vector<double> costates, const State& by) {
    for (std::size_t i = 0; i < costates.size(); ++i) {
      costates[i] += by[static_cast<Eigen::Index>(i)];
    }
    return costates;
  }

  /// A step of Newton's method, as long as makes the miss smaller.
  std::optional<Point> improved(const Point& point) {
    const auto matrix = commanded(point, {0, 0});
    if (!matrix) return std::nullopt;
    const State step = -matrix->leftCols<6>().partialPivLu().solve(point.miss);
    if (!step.allFinite()) return std::nullopt;
    for (double share = 1; share > 0.05; share /= 2) {
      auto next = flown(moved(point.costates, share * step), point.law);
      if (next && next->miss.norm() < (1 - share / 4) * point.miss.norm()) return next;
    }
    return std::nullopt;
  }

  std::optional<Point> solved(const std::vector<double>& guess, const SwitchedThrust& law) {
    constexpr int most_steps = 12;
    std::optional<Point> point = flown(guess, law);
    for (int k = 0; point && k < most_steps; ++k) {
      if (point->miss.norm() <= tolerance_) return point;
      point = improved(*point);
    }
    return std::nullopt;
  }

  /// Where the tangent leads when the law moves by `change`; the costates as they are where there
  /// is none, as at e = 1, at which the thrust changes its form.
  std::vector<double> predicted(const Point& point, const SwitchedThrust& change) {
    if (point.law.smoothing == 1) return point.costates;
    const auto matrix = commanded(point, change);
    if (!matrix) return point.costates;
    const State step = -matrix->leftCols<6>().partialPivLu().solve(matrix->col(6));
    return step.allFinite() ? moved(point.costates, step) : point.costates;
  }

  /// Follows the law in steps down to a least part of the way, limit and smoothing by their
  /// logarithms; the point is then the last one that was found.
  bool follow(Point& point, const SwitchedThrust& to, double least_step) {
    constexpr int most_attempts = 120;
    const SwitchedThrust from = point.law;
    if (from == to) return true;
    const double most_rate = std::log(to.most / from.most);
    const double smoothing_rate = to.smoothing > 0 ? std::log(to.smoothing / from.smoothing) : 0;
    const double exhaust_rate = to.inverse_exhaust - from.inverse_exhaust;
    double done = 0;
    double step = 0.25;
    for (int attempts = 0; attempts < most_attempts && done < 1; ++attempts) {
      const bool is_last = done + step >= 1;
      if (is_last) step = 1 - done;
      const double share = done + step;
      const SwitchedThrust law =
          is_last ? to
                  : SwitchedThrust{from.most * std::exp(share * most_rate),
                                   from.smoothing * std::exp(share * smoothing_rate),
                                   from.inverse_exhaust + share * exhaust_rate};
      const SwitchedThrust change = {point.law.most * most_rate * step,
                                     point.law.smoothing * smoothing_rate * step,
                                     exhaust_rate * step};
      std::optional<Point> next = solved(predicted(point, change), law);
      if (!next) {
        step /= 3;
        if (step < least_step) return false;
        continue;
      }
      point = std::move(*next);
      done = is_last ? 1 : share;
      ++result_.steps;
      step *= 2;
    }
    return done == 1;
  }

  /// The thrust with e = 0 beside a smoothed one.
  std::optional<Point> sharpened(const Point& smooth) {
    const SwitchedThrust law = {smooth.law.most, 0};
    for (const bool is_predicted : {true, false}) {
      std::optional<Point> sharp = solved(
          is_predicted ? predicted(smooth, {0, -smooth.law.smoothing}) : smooth.costates, law);
      if (!sharp || fuel(*sharp) > (1 + 1e-6) * fuel(smooth)) continue;
      ++result_.steps;
      return sharp;
    }
    return std::nullopt;
  }

  /// The integral of |u|, by Simpson's rule in parts of each step.
  double fuel(const Point& point) const {
    constexpr int parts = 16;
    const double e = point.law.smoothing;
    double sum = 0, first = 0;
    std::vector<double> shares;  // of the step's parts so far
    flight_.visit(point.flown, point.law, parts, [&](const SwitchedFlight::Instant& instant) {
      if (shares.empty()) first = instant.time;
      shares.push_back(instant.phase == ThrustPhase::off ? 0
                       : instant.phase == ThrustPhase::full
                           ? 1
                           : (primer_length(instant.state) - 1 + e) / (2 * e));
      if (shares.size() <= parts) return;
      double weighted = shares.front() + shares.back();
      for (std::size_t k = 1; k < parts; ++k) weighted += (k % 2 == 1 ? 4 : 2) * shares[k];
      sum += weighted * (instant.time - first) / (3 * parts);
      shares.clear();
    });
    return sum * point.law.most;
  }

  const SwitchedFlight& flight_;
  const BangBangTask& task_;
  double tolerance_ = 0;
  long phases_ = 0;
  BangBangThrust result_;
};

}  // namespace

BangBangThrust bang_bang_thrust(const SwitchedFlight& flight, const BangBangTask& task) {
  return BangBangSearch(flight, task).run();
}

}  // namespace hamjet
