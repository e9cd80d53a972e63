#include "deputy_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../checks/flight_checks.hpp"
#include "../flights/paced_times.hpp"
#include "../flights/relative_drift.hpp"
#include "../formation_scale.hpp"
#include "charts/deputy_flows.hpp"
#include "flown_trajectory.hpp"
#include "formation_problem.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/validity.hpp"
#include "manoeuvred_motion.hpp"
#include "single_transfer.hpp"

namespace hamjet {
namespace {

/// A jet takes longer than a flight, so that long motions have fewer points than their path would
/// need.
constexpr IntervalCount points_of_motion = {48, 64, 1024};

}  // namespace

double DeputyMotion::largest_error_m(int order) const {
  double largest = 0;
  for (const DeputyMotionPoint& point : points) {
    largest = std::max(largest, point.errors_m[static_cast<std::size_t>(order - 1)]);
  }
  return largest;
}

DeputyMotion study_deputy_motion(const Scene& asked, const ProgressCallback& progress) {
  require_formation_problem(asked, asked.deputy.has_value(), "deputy");
  if (!asked.manoeuvres.empty() || !asked.deputy->manoeuvres.empty()) {
    return manoeuvred_motion(asked, progress);
  }
  const bool is_automatic = asked.coordinates == JetCoordinates::automatic;
  if (!is_automatic && !serve_parameters(asked.coordinates) && !is_like_chief(asked)) {
    throw Error(ErrorKind::scene,
                fmt::format("jet.coordinates: of a deputy whose coefficients differ from its "
                            "chief's, got {}, must be cartesian, flow-box or auto",
                            name_of(asked.coordinates.start)));
  }
  const Scene scene = with_deputy_parameters(asked);
  if (scene.duration == 0) {
    throw Error(ErrorKind::scene, "deputy: no motion in no time, got a jet.duration of 0");
  }
  DeputyMotion result;
  result.scene = scene;
  const MetricUnits units = metric_units(scene);
  const RelativeFrame frame = scene.deputy->frame;
  const std::vector<double> deviation = deputy_deviation(scene);
  const int count = interval_count(scene, scene.duration, points_of_motion);
  const int parts = (interval_count(scene, scene.duration, drawn_path) + count - 1) / count;
  if (progress) progress("flight", 0);
  result.flown =
      flown_trajectory(scene, deviation, frame, paced_times(scene, scene.duration, count * parts),
                       static_cast<std::size_t>(parts));
  result.drift = deputy_drift(scene);
  const auto orders = static_cast<std::size_t>(scene.order);
  result.points.push_back({0, scene.deputy->start, std::vector<double>(orders, 0.0), 0});

  const ComputedProblem problem = make_problem(scene);
  const IntegratorSettings& integrator = symplectic_integrator(scene);
  result.integrator = integrator.label;
  result.coordinates = measured_coordinates_of(scene);
  DeputyFlowPropagation propagation(scene, problem, integrator, result.coordinates);
  ComputedProblem linear = problem;
  linear.space = SeriesSpace::create(problem.variables.size(), 1);
  JetPropagation linear_flow(linear, integrator);
  const SixNumbers<double> start = six_numbers(deviation);
  std::vector<int> degrees(orders);
  std::iota(degrees.begin(), degrees.end(), 1);
  std::vector<DeputyPrediction> predictions(orders);
  for (int index = 0; index < count; ++index) {
    if (progress) progress("motion", static_cast<double>(index) / count);
    const auto flown = static_cast<std::size_t>((index + 1) * parts);
    const double time = result.flown.times[flown];
    const std::vector<double>& chief = result.flown.chief[flown];
    const std::vector<double>& deputy = result.flown.deputy[flown];
    const std::unique_ptr<DeputyFlow> flow = propagation.advance_to(time);
    DeputyMotionPoint point{time, result.flown.states[flown], {}, 0};
    DeputyPredictor(*flow).predict(std::span(&start, 1), degrees, predictions);
    for (int order = 1; order <= scene.order; ++order) {
      const SixNumbers<double>& predicted =
          predictions[static_cast<std::size_t>(order) - 1].deviation;
      double square = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        square += std::pow(predicted[i] - (deputy[i] - chief[i]), 2);
      }
      if (!std::isfinite(square)) {
        throw Error(ErrorKind::numerical,
                    fmt::format("motion: order {} has no place for the deputy in {} coordinates "
                                "after {:.6g} s; other coordinates (jet.coordinates) may have one",
                                order, name_of(result.coordinates), time * units.time_s));
      }
      point.errors_m.push_back(std::sqrt(square) * units.length_m);
    }
    // Every flight from time to time has an independent rounding error of its start.
    point.flight_floor_m = std::sqrt(index + 1.0) *
                           rounding_of_flights(problem, linear_flow.advance_to(time)) *
                           units.length_m;
    result.flight_floor_m = std::max(result.flight_floor_m, point.flight_floor_m);
    result.points.push_back(std::move(point));
  }
  SeparationExtremes extremes(scene, frame);
  result.checks = flight_checks(scene, flights_of(scene, scene.duration, true),
                                [&](const FlightArc& arc) { extremes.add(arc); });
  result.extremes = extremes.found();
  result.propagation_seconds = propagation.statistics().wall_seconds;
  return result;
}

}  // namespace hamjet
