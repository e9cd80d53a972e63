#include "deputy_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "../integrators/concurrent_tasks.hpp"
#include "../studies/formation/deputy_flows.hpp"
#include "../studies/formation/formation_problem.hpp"
#include "../studies/formation/single_transfer.hpp"
#include "../studies/stopwatch.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/charts/flow_box_states.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet::cli {

EvaluatedScene evaluated_scene(const Scene& scene) {
  require_formation_problem(scene, true, "jet");
  EvaluatedScene result;
  const ComputedProblem problem = make_problem(scene, available_memory());
  const IntegratorSettings& integrator = symplectic_integrator(scene);
  result.coordinates = measured_coordinates_of(scene);
  {
    const Stopwatch watch(result.seconds);
    DeputyFlowPropagation propagation(scene, problem, integrator, result.coordinates);
    result.flow = propagation.advance_to(scene.duration);
  }
  result.rounding_m = rounding_of_flights(problem, scene.duration) * metric_units(scene).length_m;
  io::StoredJet& chief = result.chief;
  chief.scene = scene.name;
  chief.label = integrator.label;
  chief.model = scene.system.model;
  chief.units = scene.units;
  chief.duration = scene.duration;
  chief.nominal_initial = scene.nominal;
  chief.nominal_final.assign(result.flow->chief_end().begin(), result.flow->chief_end().end());
  chief.components.resize(scene.nominal.size());
  std::iota(chief.components.begin(), chief.components.end(), std::size_t{0});
  chief.variables = chief.components;
  chief.ephemeris = scene.ephemeris;
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
  constexpr double canonical_mu = 1;
  EvaluatedScene result;
  result.chief = stored;
  result.chief.jet.clear();
  result.coordinates = stored.coordinates;
  const SixNumbers<double> start = six_numbers(stored.nominal_initial);
  const SixNumbers<double> end = six_numbers(stored.nominal_final);
  const auto set_rounding = [&](const Matrix<double>& linear) {
    result.rounding_m = rounding_of_flights(linear, start, end, stored.momentum_exponent()) *
                        stored.units.length_km * 1000;
  };
  if (stored.flow_box) {
    const FlowBoxMap<double> map = flow_box_map(stored);
    result.flow = flow_box_deputy_flow(stored.flow_box->field, map);
    // What deviations are counted from, as where a scene is integrated.
    result.chief.nominal_final.assign(result.flow->chief_end().begin(),
                                      result.flow->chief_end().end());
    set_rounding(linear_part_of(stored.flow_box->field, map));
    return result;
  }
  const CanonicalChart<double> first(chart_of(stored.coordinates.start), start, canonical_mu);
  const CanonicalChart<double> last(chart_of(stored.coordinates.end), end, canonical_mu);
  const FlowMap<double> map(convert_map<double>(stored.jet));
  result.flow = charted_deputy_flow(first, start, last, end, map);
  // The linear part in positions and momenta is that of the jet, whatever it is written in.
  set_rounding(result.flow->exit_derivative() * linear_part(without_constants(map.jet())) *
               result.flow->entry_derivative());
  return result;
}

double DeputyEvaluation::chart_seconds() const {
  double all = 0;
  double polynomials = 0;
  for (const Worker& worker : workers_) {
    all += worker.seconds;
    polynomials += worker.predictor.polynomial_seconds();
  }
  return all > 0 ? seconds_ * (1 - polynomials / all) : 0;
}

void DeputyEvaluation::add(const std::vector<double>& deviation) {
  pending_.push_back(six_numbers(deviation));
}

std::vector<int> DeputyEvaluation::degrees() const {
  // The curved ends are in no degree of the polynomials, so that lower degrees go through them too.
  const bool is_curved = scene_.coordinates != JetCoordinates::cartesian;
  std::vector<int> degrees = {degree_};
  for (int below = 1; is_curved && below <= 2 && degree_ - below >= 1; ++below) {
    degrees.push_back(degree_ - below);
  }
  return degrees;
}

void DeputyEvaluation::run(
    const std::function<void(const std::vector<double>&, const MissEstimate&)>& take) {
  const bool is_curved = scene_.coordinates != JetCoordinates::cartesian;
  const std::vector<int> degrees = this->degrees();
  // Fewer take no longer than a thread takes to start.
  constexpr std::size_t fewest_points = 256;
  const std::size_t tasks = std::clamp<std::size_t>(pending_.size() / fewest_points, 1, threads_);
  while (workers_.size() < tasks) workers_.push_back({DeputyPredictor(*scene_.flow), {}, 0});
  const auto first_of = [&](std::size_t task) { return pending_.size() * task / tasks; };
  const auto predict = [&](std::size_t task, TaskControl&) {
    Worker& worker = workers_[task];
    const Stopwatch watch(worker.seconds);
    const auto points =
        std::span(pending_).subspan(first_of(task), first_of(task + 1) - first_of(task));
    worker.predictions.resize(points.size() * degrees.size());
    worker.predictor.predict(points, degrees, worker.predictions);
  };
  {
    const Stopwatch watch(seconds_);
    run_concurrently(tasks, tasks, predict, [](long) {});
  }
  for (std::size_t task = 0; task < tasks; ++task) {
    const std::vector<DeputyPrediction>& predictions = workers_[task].predictions;
    const std::size_t count = first_of(task + 1) - first_of(task);
    for (std::size_t k = 0; k < count; ++k) {
      const SixNumbers<double>& found = predictions[k].deviation;
      const auto deviation = [&](std::size_t below) {
        return below < degrees.size() ? &predictions[below * count + k].deviation : nullptr;
      };
      take({found.begin(), found.end()},
           is_curved
               ? curved_estimate(pending_[first_of(task) + k], found, deviation(1), deviation(2))
               : estimate(predictions[k]));
    }
  }
  pending_.clear();
}

MissEstimate DeputyEvaluation::estimate(const DeputyPrediction& prediction) const {
  const io::StoredJet& chief = scene_.chief;
  const double length_m = chief.units.length_km * 1000;
  const double momentum_unit = std::ldexp(1.0, chief.momentum_exponent());
  SixNumbers<double> lower = prediction.deviation;
  for (std::size_t i = 0; i < 6; ++i) lower[i] -= prediction.last[i] + prediction.last_but_one[i];
  const auto norms = [&](const SixNumbers<double>& z) {
    const double position = std::hypot(z[0], z[1], z[2]);
    const double momentum = std::hypot(z[3], z[4], z[5]) / momentum_unit;
    return DegreeShares::Norms{std::hypot(position, momentum), position * length_m};
  };
  const TruncationEstimate truncation = estimate_truncation(
      degree_, {norms(lower), norms(prediction.last_but_one), norms(prediction.last)});
  return {truncation.support, truncation.miss, scene_.rounding_m};
}

MissEstimate DeputyEvaluation::curved_estimate(const SixNumbers<double>& initial,
                                               const SixNumbers<double>& found,
                                               const SixNumbers<double>* below,
                                               const SixNumbers<double>* two_below) const {
  using Support = TruncationEstimate::Support;
  constexpr double least_ratio = 0.5;  // of the changes of two degrees that is relied upon
  constexpr double largest_ratio = 2;
  const auto distance = [](const SixNumbers<double>& a, const SixNumbers<double>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  const SixNumbers<double> none{};
  MissEstimate result{Support::unknown, 0, scene_.rounding_m};
  if (below == nullptr) return result;
  const double change = distance(found, *below);
  if (!std::isfinite(change)) return result;
  const double size = std::max(distance(initial, none), distance(found, none));
  double ratio = 1;
  bool is_decaying = false;
  if (two_below != nullptr) {
    const double change_below = distance(*below, *two_below);
    // A change that is rounding says nothing of a decay; two degrees that change nothing have no
    // ratio, and need none.
    const double rounding = scene_.rounding_m / (scene_.chief.units.length_km * 1000);
    is_decaying = change < change_below || change <= rounding;
    constexpr double least_change = std::numeric_limits<double>::min();
    ratio = std::clamp(change / std::max(change_below, least_change), least_ratio,
                       is_decaying ? 1.0 : largest_ratio);
  }
  // Of the deviation that a degree may change. Degrees that are small already need not decay one by
  // one, for the lower may vanish by chance; less is relied upon then.
  const double largest_share = is_decaying ? 0.1 : 1e-4;
  result.support = change <= largest_share * size ? Support::inside : Support::outside;
  result.truncation_m = change * ratio * scene_.chief.units.length_km * 1000;
  return result;
}

}  // namespace hamjet::cli
