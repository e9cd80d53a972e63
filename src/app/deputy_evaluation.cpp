#include "deputy_evaluation.hpp"

#include <cmath>
#include <numeric>

#include "../studies/formation/deputy_flows.hpp"
#include "../studies/formation/formation_problem.hpp"
#include "../studies/formation/single_transfer.hpp"
#include "../studies/stopwatch.hpp"
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

void DeputyEvaluation::add(const std::vector<double>& deviation) {
  pending_.push_back(six_numbers(deviation));
}

void DeputyEvaluation::run(
    const std::function<void(const std::vector<double>&, const MissEstimate&)>& take) {
  std::vector<DeputyPrediction> predictions(pending_.size());
  {
    const Stopwatch watch(seconds_);
    scene_.flow->predict(pending_, degree_, predictions);
  }
  for (const DeputyPrediction& prediction : predictions) {
    take({prediction.deviation.begin(), prediction.deviation.end()}, estimate(prediction));
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

}  // namespace hamjet::cli
