#include "lowest_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "../algebra/scalar_search.hpp"
#include "exact_flow.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "stopwatch.hpp"

namespace hamjet {
namespace {

constexpr std::size_t most_passages = 64;
constexpr double refinement_tolerance = 1e-12;

/// The smallest value on [0, h] of the cubic with these values and slopes at its ends; the cubic
/// falls at the start and rises at the end.
double smallest_of_cubic(double h, double start, double start_slope, double end, double end_slope) {
  double smallest = std::min(start, end);
  constexpr int parts = 32;
  for (int i = 1; i < parts; ++i) {
    const double x = static_cast<double>(i) / parts;
    const double value = start * (1 + 2 * x) * (1 - x) * (1 - x) + end * x * x * (3 - 2 * x) +
                         h * x * (1 - x) * (start_slope * (1 - x) - end_slope * x);
    smallest = std::min(smallest, value);
  }
  return smallest;
}

}  // namespace

LowestPointSearch::Point LowestPointSearch::point(double time, const std::vector<double>& state,
                                                  double direction) const {
  Point result{time, state, 0, 0};
  const std::size_t n = problem_.system->degrees_of_freedom;
  double square = 0;
  for (std::size_t i = 0; i < n; ++i) {
    square += state[i] * state[i];
    result.radial += direction * state[i] * state[n + i];
  }
  result.distance = std::sqrt(square);
  return result;
}

void LowestPointSearch::keep_lower(const Point& candidate) {
  if (candidate.distance >= result_.distance) return;
  result_.distance = candidate.distance;
  result_.time = candidate.time;
}

void LowestPointSearch::record(double time, const std::vector<double>& state) {
  const Stopwatch stopwatch(result_.seconds);
  if (!is_started_) {
    is_started_ = true;
    last_ = point(time, state, 1);
    result_.distance = last_.distance;
    result_.time = time;
    return;
  }
  const double direction = time < last_.time ? -1 : 1;
  if (direction != direction_) {
    direction_ = direction;
    last_ = point(last_.time, last_.state, direction);
  }
  Point now = point(time, state, direction);
  keep_lower(now);
  if (last_.radial < 0 && now.radial > 0) keep_passage(now);
  last_ = std::move(now);
}

void LowestPointSearch::keep_passage(const Point& end) {
  const auto is_lower = [](const Passage& a, const Passage& b) { return a.estimate < b.estimate; };
  const double h = std::abs(end.time - last_.time);
  const double estimate = smallest_of_cubic(h, last_.distance * last_.distance, 2 * last_.radial,
                                            end.distance * end.distance, 2 * end.radial);
  if (passages_.size() == most_passages) {
    if (estimate >= passages_.front().estimate) return;
    std::pop_heap(passages_.begin(), passages_.end(), is_lower);
    passages_.pop_back();
  }
  passages_.push_back({last_, end.time - last_.time, estimate});
  std::push_heap(passages_.begin(), passages_.end(), is_lower);
}

LowestPointSearch::Point LowestPointSearch::advanced(const Point& start, double duration,
                                                     double direction) const {
  if (duration == 0) return start;
  GaussSettings gauss;
  gauss.tolerance = refinement_tolerance;
  IntegrationStatistics statistics;
  const auto jet = integrate_gauss(
      trajectory_problem(problem_.system, start.state, problem_.start_time + start.time, duration),
      gauss, statistics);
  return point(start.time + duration, nominal_of(jet), direction);
}

void LowestPointSearch::refine(const Passage& passage) {
  const double direction = passage.duration < 0 ? -1 : 1;
  try {
    const Point end = advanced(passage.start, passage.duration, direction);
    keep_lower(end);
    if (!(end.radial > 0)) {
      // The run's own step is too coarse to end where the nominal does, so that it is divided.
      constexpr int parts = 16;
      Point inside = passage.start;
      for (int i = 1; i < parts; ++i) {
        inside = advanced(inside, passage.duration / parts, direction);
        keep_lower(inside);
      }
      return;
    }
    const auto radial = [&](double s) {
      const Point inside = advanced(passage.start, s, direction);
      keep_lower(inside);
      return inside.radial;
    };
    // The distance is stationary there, so that half the digits of the time suffice.
    root_between("lowest point", radial, {0, passage.start.radial}, {passage.duration, end.radial},
                 26);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    result_.failure = error.what();
    result_.failure_time = passage.start.time;
  }
}

LowestPoint LowestPointSearch::take() {
  {
    const Stopwatch stopwatch(result_.seconds);
    for (const Passage& passage : passages_) refine(passage);
  }
  return result_;
}

}  // namespace hamjet
