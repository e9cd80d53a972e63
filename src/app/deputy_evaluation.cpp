#include "deputy_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "../integrators/concurrent_tasks.hpp"
#include "../studies/checks/flight_checks.hpp"
#include "../studies/exact_flow.hpp"
#include "../studies/formation/charts/deputy_flows.hpp"
#include "../studies/formation/formation_problem.hpp"
#include "../studies/formation/single_transfer.hpp"
#include "../studies/stopwatch.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/charts/flow_box_states.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/validity.hpp"
#include "prediction_rounding.hpp"

namespace hamjet::cli {

namespace {

/// Sets the rounding of a deputy's final position: that of flights, which is given, and that of
/// predictions about the chief's start are independent.
void set_rounding(EvaluatedScene& scene, const SixNumbers<double>& start, double of_flights) {
  scene.rounding_m = std::hypot(of_flights, rounding_of_predictions(*scene.flow, start)) *
                     scene.chief.units.length_km * 1000;
}

/// The chief's end as it is stored: that of a flow box's section, or of the flow itself.
std::vector<double> stored_end_of(const DeputyFlowPropagation& propagation,
                                  const DeputyFlow& flow) {
  const auto& box = propagation.flow_box();
  const SixNumbers<double>& end = box ? box->end->origin() : flow.chief_end();
  return {end.begin(), end.end()};
}

/// The highest order whose estimate has the next degree, which takes up to twice the time of all
/// others. Of higher orders, degrees enough tell how they decay.
constexpr int highest_with_next_degree = 4;

/// The flow to one degree more than the scene's; none if it cannot be integrated to that.
FurtherFlow flow_of_next_degree(const Scene& scene, const IntegratorSettings& integrator,
                                const CoordinatesAtEnds& coordinates) {
  Scene further = scene;
  ++further.order;
  try {
    const ComputedProblem problem = make_problem(further);
    DeputyFlowPropagation propagation(further, problem, integrator, coordinates);
    FurtherFlow result;
    result.flow = propagation.advance_to(scene.duration);
    result.stored_end = stored_end_of(propagation, *result.flow);
    return result;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    return {};
  }
}

}  // namespace

void set_chief_end(EvaluatedScene& scene, std::vector<double> end) {
  scene.chief.nominal_final = std::move(end);
  for (std::size_t i = 0; i < 6; ++i) {
    scene.companion[i] = scene.flow->chief_end()[i] - scene.chief.nominal_final[i];
  }
}

namespace {

/// Integrates the flow in the coordinates of the result, and what it is wrong by.
void integrate_flow(const Scene& scene, const ComputedProblem& problem, EvaluatedScene& result) {
  const IntegratorSettings& integrator = symplectic_integrator(scene);
  const Stopwatch watch(result.seconds);
  DeputyFlowPropagation propagation(scene, problem, integrator, result.coordinates);
  result.flow = propagation.advance_to(scene.duration);
  try {
    result.error = FlowError::measured(scene, problem, propagation.coordinates(), *result.flow);
  } catch (const Error& error) {
    // The flow is there all the same; nothing is known of its errors then, which is said.
    if (error.kind() != ErrorKind::numerical) throw;
  }
  if (scene.order >= 2 && scene.order <= highest_with_next_degree &&
      result.coordinates != JetCoordinates::cartesian) {
    result.further = flow_of_next_degree(scene, integrator, propagation.coordinates());
  }
  if (const auto& box = propagation.flow_box()) {
    result.chief.flow_box = {box->start->chart().name(), orbit_field(scene)};
  }
  result.stored_end = stored_end_of(propagation, *result.flow);
}

}  // namespace

EvaluatedScene evaluated_scene(const Scene& asked) {
  require_formation_problem(asked, true, "jet");
  require_states_alone(asked, "eval");
  const Scene scene = with_deputy_coefficients(asked);
  EvaluatedScene result;
  io::StoredJet& chief = result.chief;
  const ComputedProblem problem = make_problem(scene);
  result.coordinates = measured_coordinates_of(scene);
  integrate_flow(scene, problem, result);
  if (scene.eval) result.split_scene = std::make_shared<const Scene>(scene);
  chief.scene = scene.name;
  chief.label = symplectic_integrator(scene).label;
  chief.model = scene.system.model;
  chief.units = scene.units;
  set_rounding(result, six_numbers(scene.nominal), rounding_of_flights(problem, scene.duration));
  result.told = told_factors(scene);
  chief.duration = scene.duration;
  chief.start_time = scene.start_time;
  chief.is_autonomous = problem.system->is_autonomous();
  chief.nominal_initial = scene.nominal;
  chief.nominal_final.assign(result.flow->chief_end().begin(), result.flow->chief_end().end());
  if (!is_like_chief(asked)) {
    set_chief_end(result, exact_flow(make_problem(asked).system, scene.nominal, scene.start_time,
                                     scene.duration));
  }
  chief.coordinates = result.coordinates;
  chief.components.resize(scene.nominal.size());
  std::iota(chief.components.begin(), chief.components.end(), std::size_t{0});
  chief.variables = chief.components;
  chief.ephemeris = scene.ephemeris;
  result.checks = flight_checks(asked, flights_of(asked, scene.duration, false));
  return result;
}

EvaluatedScene evaluated_about(const EvaluatedScene& about_chief,
                               const SixNumbers<double>& deviation) {
  Scene scene = *about_chief.split_scene;
  for (std::size_t i = 0; i < deviation.size(); ++i) scene.nominal[i] += deviation[i];
  EvaluatedScene result;
  result.chief = about_chief.chief;
  result.chief.nominal_initial = scene.nominal;
  result.coordinates = about_chief.coordinates;
  result.told = about_chief.told;
  const ComputedProblem problem = make_problem(scene);
  integrate_flow(scene, problem, result);
  set_rounding(result, six_numbers(scene.nominal), rounding_of_flights(problem, scene.duration));
  set_chief_end(result, about_chief.chief.nominal_final);
  return result;
}

namespace {

/// The linear part of the jet in positions and momenta of a flow-box map.
Matrix<double> linear_part_of(const ZonalGravity& field, FlowBoxMap<double> map) {
  const SpacePointer linear = SeriesSpace::create(map.start->variables(), 1);
  map.time = in_space(map.time, linear);
  for (Series<double>& coordinate : map.coordinates) coordinate = in_space(coordinate, linear);
  return linear_part(without_constants(flow_box_jet(field, map).jet()));
}

}  // namespace

EvaluatedScene evaluated_jet(const io::StoredJet& stored) {
  EvaluatedScene result;
  result.chief = stored;
  result.chief.jet.clear();
  result.coordinates = stored.coordinates;
  result.stored_end = stored.nominal_final;
  const SixNumbers<double> start = six_numbers(stored.nominal_initial);
  const SixNumbers<double> end = six_numbers(stored.nominal_final);
  const auto set_rounding_of = [&](const Matrix<double>& linear) {
    set_rounding(result, start,
                 rounding_of_flights(linear, start, end, stored.momentum_exponent()));
  };
  if (stored.flow_box) {
    const FlowBoxMap<double> map = flow_box_map(stored);
    result.flow = flow_box_deputy_flow(stored.flow_box->field, map);
    // What deviations are counted from, as where a scene is integrated.
    result.chief.nominal_final.assign(result.flow->chief_end().begin(),
                                      result.flow->chief_end().end());
    set_rounding_of(linear_part_of(stored.flow_box->field, map));
    result.error = FlowError::stated(stored, *result.flow);
    return result;
  }
  const FlowMap<double> map(convert_map<double>(stored.jet));
  if (stored.coordinates == JetCoordinates::cartesian) {
    result.flow = cartesian_deputy_flow(map);
  } else {
    const CanonicalChart<double> first(chart_of(stored.coordinates.start), start, canonical_mu);
    const CanonicalChart<double> last(chart_of(stored.coordinates.end), end, canonical_mu);
    result.flow = charted_deputy_flow(first, start, last, end, map);
  }
  // The linear part in positions and momenta is that of the jet, whatever it is written in.
  set_rounding_of(result.flow->exit_derivative() * linear_part(without_constants(map.jet())) *
                  result.flow->entry_derivative());
  result.error = FlowError::stated(stored, *result.flow);
  return result;
}

io::StoredJet stored_polynomials(const EvaluatedScene& scene) {
  if (scene.coordinates == JetCoordinates::flow_box && !scene.chief.flow_box) {
    throw Error(
        ErrorKind::usage,
        "jet.coordinates: polynomials of flow boxes are not kept where the forces depend on "
        "the time, got flow-box, must be other coordinates");
  }
  io::StoredJet stored = scene.chief;
  stored.nominal_final = scene.stored_end;
  // The polynomials are evaluated in double precision, whatever precision they were stored in.
  stored.precision = Precision::double_precision;
  stored.jet = convert_map<Extended>(scene.flow->polynomials());
  if (stored.flow_box) return stored;
  // Of other flows they are deviations from the chief's end.
  const SixNumbers<double> end = six_numbers(stored.nominal_final);
  const SixNumbers<double> coordinates =
      CanonicalChart<double>(chart_of(stored.coordinates.end), end, canonical_mu).coordinates(end);
  for (std::size_t i = 0; i < coordinates.size(); ++i) stored.jet[i][0] = coordinates[i];
  return stored;
}

double DeputyEvaluation::multiply_adds() const {
  double sum = 0;
  for (const Worker& worker : workers_) {
    sum += worker.predictor.multiply_adds();
    if (worker.further) sum += worker.further->multiply_adds();
  }
  return sum;
}

double DeputyEvaluation::chart_seconds() const {
  double all = 0;
  double polynomials = 0;
  for (const Worker& worker : workers_) {
    all += worker.seconds;
    polynomials += worker.predictor.polynomial_seconds();
    if (worker.further) polynomials += worker.further->polynomial_seconds();
  }
  return all > 0 ? seconds_ * (1 - polynomials / all) : 0;
}

void DeputyEvaluation::add(const std::vector<double>& deviation) {
  pending_.push_back(six_numbers(deviation));
}

void DeputyEvaluation::predict(std::span<const SixNumbers<double>> initial, Worker& worker) const {
  const bool is_curved = scene_.coordinates != JetCoordinates::cartesian;
  const std::size_t start = worker.predictions.size();
  worker.predictions.resize(start + initial.size());
  const auto predictions = std::span(worker.predictions).subspan(start);
  worker.predictor.predict(initial, degree_, predictions);
  worker.estimates.resize(start + initial.size());
  std::vector<DeputyPrediction> next(worker.further ? initial.size() : 0);
  if (worker.further) worker.further->predict(initial, degree_ + 1, next);
  const auto next_of = [&](std::size_t k) { return next.empty() ? nullptr : &next[k]; };
  std::vector<std::size_t> bent;
  for (std::size_t k = 0; k < initial.size(); ++k) {
    const DeputyPrediction& found = predictions[k];
    MissEstimate& told = worker.estimates[start + k];
    if (!is_curved) {
      told = estimate(found);
      add_errors(initial[k], found.deviation, told);
    } else if (degree_ > 1 && !is_nearly_straight(initial[k], found)) {
      bent.push_back(k);
    } else {
      std::array<SixNumbers<double>, 3> lower;
      for (std::size_t h = 0; h < lower.size(); ++h) {
        lower[h] = h == 0 ? found.deviation : lower[h - 1];
        for (std::size_t i = 0; i < 6; ++i) lower[h][i] -= found.highest[h][i];
      }
      told = curved_estimate(initial[k], found.deviation, lower, next_of(k));
    }
  }
  std::vector<std::array<SixNumbers<double>, 3>> lower(bent.size());
  worker.predictor.predict_lower(bent, lower);
  for (std::size_t j = 0; j < bent.size(); ++j) {
    const std::size_t k = bent[j];
    worker.estimates[start + k] =
        curved_estimate(initial[k], predictions[k].deviation, lower[j], next_of(k));
  }
}

void DeputyEvaluation::run(
    const std::function<void(const std::vector<double>&, const MissEstimate&)>& take) {
  // Fewer take no longer than a thread takes to start.
  constexpr std::size_t fewest_points = 256;
  const std::size_t tasks = std::clamp<std::size_t>(pending_.size() / fewest_points, 1, threads_);
  const DeputyFlow* const further = further_flow();
  while (workers_.size() < tasks) {
    workers_.push_back({DeputyPredictor(*scene_.flow), {}, {}, {}, 0});
    if (further) workers_.back().further.emplace(*further);
  }
  const auto first_of = [&](std::size_t task) { return pending_.size() * task / tasks; };
  {
    const Stopwatch watch(seconds_);
    run_concurrently(
        tasks, tasks,
        [&](std::size_t task, TaskControl&) {
          Worker& worker = workers_[task];
          const Stopwatch own(worker.seconds);
          worker.predictions.clear();
          worker.estimates.clear();
          const std::size_t end = first_of(task + 1);
          constexpr std::size_t most = DeputyPredictor::most_at_once;
          for (std::size_t first = first_of(task); first < end; first += most) {
            predict(std::span(pending_).subspan(first, std::min(most, end - first)), worker);
          }
        },
        [](long) {});
  }
  std::vector<double> deviation(6);
  for (std::size_t task = 0; task < tasks; ++task) {
    const Worker& worker = workers_[task];
    for (std::size_t k = 0; k < worker.predictions.size(); ++k) {
      const SixNumbers<double>& found = worker.predictions[k].deviation;
      for (std::size_t i = 0; i < 6; ++i) deviation[i] = found[i] + scene_.companion[i];
      take(deviation, worker.estimates[k]);
    }
  }
  pending_.clear();
}

const DeputyFlow* DeputyEvaluation::further_flow() const {
  if (degree_ < 2 || scene_.coordinates == JetCoordinates::cartesian) return nullptr;
  return scene_.flow->order() > degree_ ? scene_.flow.get() : scene_.further.flow.get();
}

}  // namespace hamjet::cli
