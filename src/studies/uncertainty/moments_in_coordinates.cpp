#include "moments_in_coordinates.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "../formation/charts/deputy_flows.hpp"
#include "../formation/single_transfer.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// A flow box has, instead of the energy E, with which its coordinates would be canonical, the
/// difference of the period u = (E/E_chief)^(-3/2) - 1. This change of variable multiplies volumes
/// by its value at the chief, the determinant of the coordinates' linear part, times (1 + u)^(5/3).
/// The entropy of the distribution grows by the mean of the logarithm of this factor, which is
/// computed here to the fourth moment of u.
void told_of_period(std::vector<Cumulants>& all, std::size_t period_place,
                    const std::vector<Series<double>>& coordinates) {
  const auto place = static_cast<Eigen::Index>(period_place);
  const double at_chief = std::log(
      std::abs(Eigen::PartialPivLU<Matrix<double>>(linear_part(coordinates)).determinant()));
  for (Cumulants& one : all) {
    if (!one.gaussian_log_volume()) continue;
    const double of_mean = 1 + one.mean()[place];
    const double s = one.standard_deviations()[place] / of_mean;
    const double logarithm = std::log(of_mean) - s * s / 2 +
                             std::pow(s, 3) * one.skewness()[place] / 3 -
                             std::pow(s, 4) * (3 + one.excess_kurtosis()[place]) / 4;
    one.carried_without_compression(*one.gaussian_log_volume() + at_chief + 5.0 / 3 * logarithm);
  }
}

/// The moments in one kind of coordinates. Throws as DeputyFlowPropagation.
MomentsInCoordinates moments_in(JetCoordinates coordinates, const Scene& scene,
                                const ComputedProblem& problem,
                                const IntegratorSettings& integrator,
                                const std::vector<InitialState>& starts, const FlowJet<double>& jet,
                                const std::vector<MeanOfStart>& means,
                                const std::optional<Covariance>& noise) {
  DeputyFlowPropagation propagation(scene, problem, integrator, coordinates);
  const auto flow = propagation.advance_to(scene.uncertainty->times.back());
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const double miss = miss_of_mean(*flow, scene.order, starts[s], means[s]);
    if (miss <= largest_miss) continue;
    throw Error(
        ErrorKind::numerical,
        fmt::format("the {} starts {:.4g} km from the chief, whose polynomials of order {} {}; a "
                    "start nearer to the chief, or a higher jet.order, would be right",
                    starts[s].name,
                    starts[s].mean.head(3).norm() * metric_units(scene).length_m / 1000,
                    scene.order,
                    std::isfinite(miss)
                        ? fmt::format("miss its mean by {:.2g} of its standard deviations, above "
                                      "{:g}",
                                      miss, largest_miss)
                        : "have no place for its mean"));
  }
  const std::vector<Series<double>> series = propagation.end_coordinates();
  MomentsInCoordinates result;
  result.coordinates = coordinates;
  result.components = propagation.end_coordinate_names();
  for (const InitialState& start : starts) {
    result.states.push_back(start.name);
    result.by_order.push_back(
        charted_moments(series, propagation.end_period_place(), start, jet, noise));
  }
  if (starts.size() == 2) {
    result.states.emplace_back("relative");
    result.by_order.push_back(difference_by_order(result.by_order[1], result.by_order[0]));
  }
  return result;
}

}  // namespace

std::vector<Cumulants> moments_by_order(const std::vector<Series<double>>& map,
                                        const InitialState& start) {
  const int order = map[0].order();
  const bool is_moved = (start.mean.array() != 0).any();
  const SpacePointer space = map[0].space_pointer();
  // Polynomials in linear deviations from the mean, up to the order of their space.
  const auto in_linear = [&](std::vector<Series<double>> polynomials) {
    if (!start.straight) return polynomials;
    const SpacePointer own = polynomials[0].space_pointer();
    std::vector<Series<double>> inner = start.straight->series(own);
    for (std::size_t k = inner.size(); k < own->variables(); ++k) {
      inner.push_back(Series<double>::variable(own, k, 0));
    }
    return compose(polynomials, inner);
  };
  std::vector<Cumulants> result;
  std::vector<Series<double>> whole;
  if (!is_moved) whole = in_standard_normals(in_linear(map), start.covariance);
  const auto variables = static_cast<Eigen::Index>(space->variables());
  const Covariance itself = Covariance::of_factor(Matrix<double>::Identity(variables, variables));
  for (int n = 1; n <= order; ++n) {
    if (is_moved) {
      // A lower order drops terms before the mean is inserted.
      const SpacePointer low = SeriesSpace::create(space->variables(), n);
      std::vector<Series<double>> lower;
      for (const Series<double>& component : map) lower.push_back(in_space(component, low));
      if (start.straight) lower = in_linear(in_standard_normals(lower, itself, start.mean));
      result.push_back(Cumulants::of_polynomials(
          start.straight ? in_standard_normals(lower, start.covariance)
                         : in_standard_normals(lower, start.covariance, start.mean)));
    } else {
      result.push_back(Cumulants::of_polynomials(whole, n));
    }
  }
  return result;
}

double miss_of_mean(const DeputyFlow& flow, int order, const InitialState& start,
                    const MeanOfStart& mean) {
  if ((start.mean.array() == 0).all()) return 0;
  std::vector<SixNumbers<double>> deviations(1);
  std::copy_n(start.mean.data(), 6, deviations[0].begin());
  std::vector<DeputyPrediction> predictions(1);
  flow.predict(deviations, order, predictions);
  const Vector<double> flown = mean.to_frame * mean.deviation;
  const Vector<double> predicted =
      mean.to_frame * Eigen::Map<const Vector<double>>(predictions[0].deviation.data(), 6);
  double worst = 0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double sigma = mean.standard_deviations[i] > 0
                             ? mean.standard_deviations[i]
                             : 1e-3 * flown.segment<3>(i < 3 ? 0 : 3).norm();
    const double miss = std::abs(predicted[i] - flown[i]) / sigma;
    // The comparison is written so that NaN counts as worst.
    worst = miss <= worst ? worst : std::isfinite(miss) ? miss : never;
    if (worst == never) break;
  }
  return worst;
}

void told_of_start(std::vector<Cumulants>& all, const InitialState& start, double log_change) {
  if (!start.parameters.empty()) return;
  const auto volume = Cumulants(Vector<double>::Zero(6), start.covariance).log_volume();
  for (Cumulants& one : all) {
    if (volume) one.carried_without_compression(*volume + log_change);
  }
}

std::vector<Cumulants> charted_moments(const std::vector<Series<double>>& coordinates,
                                       std::optional<std::size_t> period_place,
                                       const InitialState& start, const FlowJet<double>& jet,
                                       const std::optional<Covariance>& noise) {
  std::vector<Cumulants> moments = moments_by_order(coordinates, start);
  told_of_start(moments, start);
  if (period_place) told_of_period(moments, *period_place, coordinates);
  if (noise) {
    // The derivative of the coordinates at the end by the states there, from both as linear maps of
    // the start's deviations.
    const Matrix<double> by_state =
        linear_part(coordinates) * Eigen::PartialPivLU<Matrix<double>>(linear_part(jet)).inverse();
    add_noise(moments, Cumulants(Vector<double>::Zero(6), *noise).mapped(by_state));
  }
  return moments;
}

void add_noise(std::vector<Cumulants>& all, const Cumulants& noise) {
  for (Cumulants& one : all) one = Cumulants::of_sum(one, noise);
}

std::vector<Cumulants> difference_by_order(const std::vector<Cumulants>& from,
                                           const std::vector<Cumulants>& what) {
  const Matrix<double> minus = -Matrix<double>::Identity(6, 6);
  std::vector<Cumulants> all;
  for (std::size_t i = 0; i < std::min(from.size(), what.size()); ++i) {
    all.push_back(Cumulants::of_sum(from[i], what[i].mapped(minus)));
  }
  return all;
}

std::vector<MomentsInCoordinates> moments_in_coordinates(
    const Scene& scene, const ComputedProblem& problem, const IntegratorSettings& integrator,
    const std::vector<InitialState>& starts, const FlowJet<double>& jet,
    const std::vector<MeanOfStart>& means, const std::optional<Covariance>& noise,
    const ProgressCallback& progress) {
  const std::vector<JetCoordinates>& asked = scene.uncertainty->coordinates;
  std::vector<MomentsInCoordinates> all;
  for (const JetCoordinates coordinates : asked) {
    if (progress) {
      progress("coordinates", static_cast<double>(all.size()) / static_cast<double>(asked.size()));
    }
    try {
      all.push_back(moments_in(coordinates, scene, problem, integrator, starts, jet, means, noise));
    } catch (const Error& error) {
      // An orbit may lack some coordinates, and a method may not support some.
      if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::scene) throw;
      all.emplace_back();
      all.back().coordinates = coordinates;
      all.back().refusal = error.what();
    }
  }
  return all;
}

}  // namespace hamjet
