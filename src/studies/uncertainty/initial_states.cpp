#include "initial_states.hpp"

#include "../formation/single_transfer.hpp"

namespace hamjet {
namespace {

Vector<double> as_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Vector<double>>(numbers.data(),
                                          static_cast<Eigen::Index>(numbers.size()));
}

/// A covariance along axes of the spacecraft's own orbit as one of canonical deviations.
Covariance canonical_covariance(const Covariance& covariance, RelativeFrame frame,
                                const Vector<double>& state, const MetricUnits& units) {
  const ChiefFrame own(std::span(state.data(), 6), units, frame);
  return covariance.mapped(deviations_of_relative_states(own));
}

}  // namespace

std::vector<InitialState> initial_states(const Scene& scene) {
  const UncertaintySettings& settings = *scene.uncertainty;
  const MetricUnits units = metric_units(scene);
  const Vector<double> chief = as_vector(scene.nominal);
  std::vector<InitialState> result;
  if (settings.chief || !scene.deputy) result.push_back({"chief", Vector<double>::Zero(6), {}});
  if (settings.chief) {
    result.back().covariance =
        canonical_covariance(settings.chief->covariance, settings.chief->frame, chief, units);
  }
  if (scene.deputy) {
    const std::vector<double> deviation =
        ChiefFrame(scene.nominal, units, scene.deputy->frame).deviation(scene.deputy->start);
    result.push_back({"deputy", as_vector(deviation), {}});
    if (settings.deputy) {
      result.back().covariance = canonical_covariance(
          settings.deputy->covariance, settings.deputy->frame, chief + result.back().mean, units);
    }
  }
  if (settings.burn) {
    InitialState& burning = result.back();
    burning.covariance = burning.covariance.plus(canonical_covariance(
        settings.burn->covariance(), settings.burn->frame, chief + burning.mean, units));
  }
  return result;
}

}  // namespace hamjet
