#include "initial_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../../uncertainty/track_axes.hpp"
#include "../formation/charts/deputy_flows.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "hamjet/error.hpp"
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

/// Adds the parameters of a spacecraft, and those that all share, to a start whose covariance is
/// that of its state.
void add_parameters(const UncertaintySettings& settings, const StateUncertainty* known,
                    const Vector<double>& state, const MetricUnits& units, InitialState& start) {
  const auto common = static_cast<Eigen::Index>(settings.common.size());
  const auto own = known ? static_cast<Eigen::Index>(known->parameters.size()) : 0;
  if (common + own == 0) return;
  start.common = common;
  for (const UncertainParameter& one : settings.common) start.parameters.push_back(one.name);
  Matrix<double> of_own = Matrix<double>::Zero(6 + own, start.covariance.rank() + own);
  of_own.topLeftCorner(6, start.covariance.rank()) = start.covariance.factor();
  bool are_independent = true;
  for (Eigen::Index k = 0; k < own; ++k) {
    const UncertainParameter& one = known->parameters[static_cast<std::size_t>(k)];
    start.parameters.push_back(one.name);
    of_own(6 + k, start.covariance.rank() + k) = one.deviation;
    for (const double covariance : one.covariances) {
      are_independent = are_independent && covariance == 0;
    }
  }
  if (!are_independent) {
    Matrix<double> to_canonical = Matrix<double>::Identity(6 + own, 6 + own);
    to_canonical.topLeftCorner(6, 6) =
        deviations_of_relative_states(ChiefFrame(std::span(state.data(), 6), units, known->frame));
    of_own = Covariance(known->joint_matrix()).mapped(to_canonical).factor();
  }
  Matrix<double> factor = Matrix<double>::Zero(6 + common + own, common + of_own.cols());
  for (Eigen::Index k = 0; k < common; ++k) {
    factor(6 + k, k) = settings.common[static_cast<std::size_t>(k)].deviation;
  }
  factor.block(0, common, 6, of_own.cols()) = of_own.topRows(6);
  factor.bottomRightCorner(own, of_own.cols()) = of_own.bottomRows(own);
  start.covariance = Covariance::of_factor(std::move(factor));
}

/// How far an orbit bends away from the line of a Gaussian in positions.
struct LineOfPositions {
  double deviation = 0;  ///< standard deviation along the track
  double bend = 0;       ///< T^2 / (2 r) at three such standard deviations
  double radial = 0;     ///< standard deviation along R if that along T is known
};

LineOfPositions line_of_positions(const Covariance& covariance, const Vector<double>& state) {
  const TrackAxes axes(state.data());
  Matrix<double> rows = Matrix<double>::Zero(2, 6);
  rows.row(0).head(3) = axes.along.transpose();
  rows.row(1).head(3) = axes.radial.transpose();
  const Matrix<double> along = covariance.mapped(rows).matrix();
  constexpr double far_out = 3;
  return {std::sqrt(along(0, 0)), far_out * far_out * along(0, 0) / (2 * axes.distance),
          std::sqrt(variance_beside(along(1, 1), along(0, 1), along(0, 0)))};
}

/// The length beside which the scene asks where spacecraft are; 0 without one.
double asked_length_m(const UncertaintySettings& settings) {
  double length = 0;
  if (settings.collision) length = settings.collision->radius_m;
  if (settings.safety) length = std::max(length, settings.safety->keep_apart_m);
  return length;
}

/// Makes a start Gaussian in elements where the scene wants this or the orbit bends too much.
/// `covariance` is that of the state, which the errors of a burn do not belong to.
void choose_coordinates(const Scene& scene, const Covariance& covariance, InitialState& start) {
  const UncertaintySettings& settings = *scene.uncertainty;
  // Without an orbit there are no elements.
  if (!is_orbit(scene.system.model)) return;
  if (settings.gaussian_in == GaussianIn::positions || covariance.rank() == 0) return;
  const Vector<double> state = as_vector(scene.nominal) + start.mean;
  const MetricUnits units = metric_units(scene);
  const LineOfPositions line = line_of_positions(covariance, state);
  const bool is_automatic = settings.gaussian_in == GaussianIn::automatic;
  // The comparison is written so that NaN leaves positions, whose errors are told elsewhere.
  constexpr double small = 0.1;
  if (is_automatic &&
      !(line.bend > small * std::hypot(line.radial, asked_length_m(settings) / units.length_m))) {
    return;
  }
  SixNumbers<double> numbers{};
  std::copy_n(state.data(), 6, numbers.begin());
  try {
    start.straight.emplace(CanonicalChart<double>(ChartName::poincare, numbers, canonical_mu),
                           numbers);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    if (is_automatic) return;
    throw Error(ErrorKind::scene,
                fmt::format("uncertainty.gaussian_in: not possible for the {}, got \"elements\", "
                            "must be \"positions\" or \"auto\": {}",
                            start.name, error.what()));
  }
  if (!is_automatic) return;
  start.why_straight = fmt::format(
      "The start of the {} is taken as Gaussian in elements, not in positions: it is uncertain by "
      "{:.3g} m along its track, and within three times that the orbit bends {:.3g} m away from a "
      "straight line, beside {:.3g} m that are uncertain across it.",
      start.name, line.deviation * units.length_m, line.bend * units.length_m,
      line.radial * units.length_m);
}

/// A deputy at a start, in positions.
InitialState deputy_in_positions(const Scene& scene, const RelativeState& start) {
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

}  // namespace

Vector<double> InitialState::deviation(const Vector<double>& linear) const {
  Vector<double> result = linear;
  const Eigen::Matrix<double, 6, 1> of_state = linear.head<6>();
  if (straight) result.head(6) = (*straight)(of_state);
  result.head(6) += mean;
  return result;
}

InitialState initial_deputy(const Scene& scene, const RelativeState& start) {
  InitialState result = deputy_in_positions(scene, start);
  choose_coordinates(scene, result.covariance, result);
  return result;
}

EncounterSystems::EncounterSystems(const Scene& scene) : chief(make_system(scene)) {
  if (!is_like_chief(scene)) unlike_deputies = make_system(with_deputy_coefficients(scene));
}

EncounterProblem empty_encounter(const Scene& scene, const SharedSystem& chief, double from,
                                 double to, double radius) {
  EncounterProblem problem{chief, {}, scene.start_time};
  problem.from = from;
  problem.to = to;
  problem.radius = radius;
  problem.order = scene.order;
  problem.settings.tolerance = 1e-12;
  return problem;
}

UncertainSpacecraft uncertain_spacecraft(const Scene& scene, const EncounterSystems& systems,
                                         const InitialState& start) {
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
  craft.straight = start.straight;
  if (!start.is_chief()) craft.own_system = systems.unlike_deputies;
  return craft;
}

std::vector<InitialState> initial_states(const Scene& scene, double burn_share) {
  const UncertaintySettings& settings = *scene.uncertainty;
  const MetricUnits units = metric_units(scene);
  const Vector<double> chief = as_vector(scene.nominal);
  std::vector<InitialState> result;
  const bool is_uncertain = settings.chief || !settings.common.empty();
  if (is_uncertain || !scene.deputy) result.push_back({"chief", Vector<double>::Zero(6), {}});
  if (settings.chief) {
    result.back().covariance =
        canonical_covariance(settings.chief->covariance, settings.chief->frame, chief, units);
  }
  if (scene.deputy) result.push_back(deputy_in_positions(scene, scene.deputy->start));
  std::vector<Covariance> of_states;
  for (const InitialState& start : result) of_states.push_back(start.covariance);
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
  for (std::size_t i = 0; i < result.size(); ++i) {
    choose_coordinates(scene, of_states[i], result[i]);
    const bool is_deputy = result[i].name == "deputy";
    const auto& known = is_deputy ? settings.deputy : settings.chief;
    add_parameters(settings, known ? &*known : nullptr, chief + result[i].mean, units, result[i]);
  }
  return result;
}

}  // namespace hamjet
