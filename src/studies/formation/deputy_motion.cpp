#include "deputy_motion.hpp"

#include <algorithm>
#include <cmath>

#include "../exact_flow.hpp"
#include "../formation_scale.hpp"
#include "../jets_along_time.hpp"
#include "flown_trajectory.hpp"
#include "formation_problem.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/error.hpp"
#include "single_transfer.hpp"

namespace hamjet {
namespace {

/// A jet takes longer than a flight does: long motions have fewer points than their path needs.
constexpr IntervalCount points_of_motion = {48, 64, 1024};

}  // namespace

double DeputyMotion::largest_error_m(int order) const {
  double largest = 0;
  for (const DeputyMotionPoint& point : points) {
    largest = std::max(largest, point.errors_m[static_cast<std::size_t>(order - 1)]);
  }
  return largest;
}

DeputyMotion study_deputy_motion(const Scene& scene, const ProgressCallback& progress) {
  require_formation_problem(scene, scene.deputy.has_value(), "deputy");
  if (scene.duration == 0) {
    throw Error(ErrorKind::scene, "deputy: no motion in no time, got a jet.duration of 0");
  }
  DeputyMotion result;
  result.scene = scene;
  const MetricUnits units = metric_units(scene);
  const RelativeFrame frame = scene.deputy->frame;
  const std::vector<double> deviation =
      ChiefFrame(scene.nominal, units, frame).deviation(scene.deputy->start);
  const int count = interval_count(scene, scene.duration, points_of_motion);
  const int parts = (interval_count(scene, scene.duration, drawn_path) + count - 1) / count;
  if (progress) progress("flight", 0);
  result.flown = flown_trajectory(scene, deviation, frame, scene.duration, count, parts);
  result.extremes = extreme_separations(scene, result.flown);
  const auto orders = static_cast<std::size_t>(scene.order);
  result.points.push_back({0, scene.deputy->start, std::vector<double>(orders, 0.0), 0});

  const ComputedProblem problem = make_problem(scene, available_memory());
  MonomialValues values(problem.space);
  values.set_point(deviation);
  const IntegratorSettings& integrator = symplectic_integrator(scene);
  result.integrator = integrator.label;
  const auto flown_index = [&](std::size_t index) {
    return (index + 1) * static_cast<std::size_t>(parts);
  };
  std::vector<double> times;
  for (std::size_t index = 0; index < static_cast<std::size_t>(count); ++index) {
    times.push_back(result.flown.times[flown_index(index)]);
  }
  const auto visit = [&](std::size_t index, const FlowJet<double>& jet) {
    if (progress) progress("motion", static_cast<double>(index) / count);
    const std::vector<double>& flown_chief = result.flown.chief[flown_index(index)];
    const std::vector<double>& flown_deputy = result.flown.deputy[flown_index(index)];
    DeputyMotionPoint point{times[index], result.flown.states[flown_index(index)], {}, 0};
    // Degree by degree: what is relative to the chief would lose its digits in the chief's place.
    std::vector<double> relative(jet.size(), 0.0);
    for (int order = 1; order <= scene.order; ++order) {
      double square = 0;
      for (std::size_t i = 0; i < jet.size(); ++i) {
        relative[i] += values.slice(jet[i], order);
        if (i >= 3) continue;
        square += std::pow(relative[i] - (flown_deputy[i] - flown_chief[i]), 2);
      }
      point.errors_m.push_back(std::sqrt(square) * units.length_m);
    }
    // Every flight from time to time rounds its start anew, and independently.
    point.flight_floor_m = std::sqrt(static_cast<double>(index + 1)) *
                           rounding_of_flights(problem, jet) * units.length_m;
    result.flight_floor_m = std::max(result.flight_floor_m, point.flight_floor_m);
    result.points.push_back(std::move(point));
  };
  const auto statistics = visit_jets(problem, integrator, times, visit);
  result.propagation_seconds = statistics.wall_seconds;
  return result;
}

}  // namespace hamjet
