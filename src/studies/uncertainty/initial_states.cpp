#include "initial_states.hpp"

#include "../formation/single_transfer.hpp"
#include "hamjet/uncertainty/polynomial_moments.hpp"

namespace hamjet {
namespace {

Vector<double> as_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Vector<double>>(numbers.data(),
                                          static_cast<Eigen::Index>(numbers.size()));
}

/// Converts a covariance along axes of the spacecraft's own orbit to one of canonical deviations.
Covariance canonical_covariance(const Covariance& covariance, RelativeFrame frame,
                                const Vector<double>& state, const MetricUnits& units) {
  const ChiefFrame own(std::span(state.data(), 6), units, frame);
  return covariance.mapped(deviations_of_relative_states(own));
}

}  // namespace

InitialState initial_deputy(const Scene& scene, const RelativeState& start) {
  const UncertaintySettings& settings = *scene.uncertainty;
  const MetricUnits units = metric_units(scene);
  InitialState result{
      "deputy",
      as_vector(ChiefFrame(scene.nominal, units, scene.deputy->frame).deviation(start)),
      {}};
  if (settings.deputy) {
    result.covariance = canonical_covariance(settings.deputy->covariance, settings.deputy->frame,
                                             as_vector(scene.nominal) + result.mean, units);
  }
  return result;
}

EncounterProblem empty_encounter(const Scene& scene, double from, double to, double radius) {
  EncounterProblem problem{make_system(scene), {}, scene.start_time};
  problem.from = from;
  problem.to = to;
  problem.radius = radius;
  problem.order = scene.order;
  problem.settings.tolerance = 1e-12;
  return problem;
}

UncertainSpacecraft uncertain_spacecraft(const Scene& scene, const InitialState& start) {
  UncertainSpacecraft craft;
  craft.state = scene.nominal;
  for (std::size_t i = 0; i < 6; ++i) {
    craft.state[i] += start.mean[static_cast<Eigen::Index>(i)];
  }
  // The factor of a sum of covariances has more columns than there are directions.
  const Matrix<double> factor = start.covariance.rank() <= 6
                                    ? start.covariance.factor()
                                    : Cumulants(Vector<double>::Zero(6), start.covariance).axes();
  craft.factor.leftCols(factor.cols()) = factor;
  return craft;
}

std::vector<InitialState> initial_states(const Scene& scene, double burn_share) {
  const UncertaintySettings& settings = *scene.uncertainty;
  const MetricUnits units = metric_units(scene);
  const Vector<double> chief = as_vector(scene.nominal);
  std::vector<InitialState> result;
  if (settings.chief || !scene.deputy) result.push_back({"chief", Vector<double>::Zero(6), {}});
  if (settings.chief) {
    result.back().covariance =
        canonical_covariance(settings.chief->covariance, settings.chief->frame, chief, units);
  }
  if (scene.deputy) result.push_back(initial_deputy(scene, scene.deputy->start));
  if (settings.burn) {
    InitialState& burning = result.back();
    const Vector<double> state = chief + burning.mean;
    const Matrix<double> factor = burn_share * settings.burn->covariance().factor();
    burning.covariance = burning.covariance.plus(
        canonical_covariance(Covariance::of_factor(factor), settings.burn->frame, state, units));
    Vector<double> change = Vector<double>::Zero(6);
    change.tail(3) = (1 - burn_share) * settings.burn->velocity_change_m_s;
    const ChiefFrame own(std::span(state.data(), 6), units, settings.burn->frame);
    burning.mean -= deviations_of_relative_states(own) * change;
  }
  return result;
}

}  // namespace hamjet
