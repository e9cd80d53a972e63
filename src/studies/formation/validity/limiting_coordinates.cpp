#include "limiting_coordinates.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "../charts/free_coordinates.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"

namespace hamjet {
namespace {

using Columns6 = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The transposed derivative of the polynomials' variables by a deputy's coordinates.
Columns6 variables_by_coordinates(FlownDeputies& deputies, const Vector6& deputy, double step) {
  Columns6 result(6, static_cast<Eigen::Index>(deputies.predictor().flow().variables()));
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Vector6 change = step * Vector6::Unit(i);
    const auto ahead = deputies.predictor().variables(deputies.deviation(deputy + change));
    const auto behind = deputies.predictor().variables(deputies.deviation(deputy - change));
    for (std::size_t v = 0; v < ahead.size(); ++v) {
      result(i, static_cast<Eigen::Index>(v)) = (ahead[v] - behind[v]) / (2 * step);
    }
  }
  return result;
}

/// The relative change of the chief's distance and speed at the end per unit of one of the
/// polynomials' values.
double relative_size(const DeputyFlow& flow, std::size_t value) {
  const Eigen::Map<const Vector6> end(flow.chief_end().data());
  const Vector6 moved = flow.exit_derivative().col(static_cast<Eigen::Index>(value));
  return std::hypot(moved.head<3>().norm() / end.head<3>().norm(),
                    moved.tail<3>().norm() / end.tail<3>().norm());
}

/// The derivative, at a deputy, of the final deviation by the polynomials' values.
Columns6 deviation_by_values(DeputyPredictor& predictor, const SixNumbers<double>& initial,
                             int order) {
  constexpr double share = 1e-6;  // as a fraction of the chief's distance and speed
  const DeputyFlow& flow = predictor.flow();
  MonomialValues point(flow.polynomials()[0].space_pointer());
  point.set_point(predictor.variables(initial));
  std::vector<double> values;
  for (const Series<double>& series : flow.polynomials()) {
    values.push_back(point.value(series, order));
  }
  Columns6 result(6, static_cast<Eigen::Index>(values.size()));
  for (std::size_t c = 0; c < values.size(); ++c) {
    const double value = values[c];
    const double step = share / relative_size(flow, c);
    values[c] = value + step;
    const SixNumbers<double> ahead = predictor.leave(initial, values);
    values[c] = value - step;
    const SixNumbers<double> behind = predictor.leave(initial, values);
    values[c] = value;
    for (std::size_t i = 0; i < 6; ++i) {
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
          (ahead[i] - behind[i]) / (2 * step);
    }
  }
  return result;
}

}  // namespace

LimitCoordinates limit_coordinates(const DeputyFlowPropagation& propagation, const DeputyFlow& flow,
                                   RelativeFrame frame, const SystemSettings& system) {
  const CoordinatesAtEnds& ends = propagation.coordinates();
  const auto components = component_names(system, frame);
  LimitCoordinates names;
  names.start = propagation.variable_names();
  names.end = propagation.value_names();
  if (ends.start == JetCoordinates::cartesian) {
    names.start.assign(components.begin(), components.end());
  }
  if (ends.end == JetCoordinates::cartesian) {
    names.end.assign(components.begin(), components.begin() + 3);
    const ChiefFrame at_end(flow.chief_end(), MetricUnits{}, frame);
    for (Eigen::Index i = 0; i < 3; ++i) {
      names.end_axes.col(i) = at_end.along_axes(Eigen::Vector3d::Unit(i));
    }
  }
  return names;
}

ReachLimit reach_limit(FlownDeputies& deputies, int order, const Vector6& deputy,
                       const CoordinatesAtEnds& coordinates, const LimitCoordinates& names) {
  constexpr double step = 1e-3;  // step of differences, as a fraction of the separation
  const double separation = std::max(deputy.head<3>().norm(), deputy.tail<3>().norm());
  const Vector6 error = deputies.error(deputy, order);
  const Eigen::Vector3d miss = error.head<3>();
  const Vector6 gradient = deputies.gradient(deputy, order, step * separation) / miss.norm();
  ReachLimit limit;
  limit.degree = gradient.dot(deputy);

  // The part of the degree that belongs to each variable: its derivative along the ray times the
  // logarithmic slope by the variable.
  Eigen::VectorXd degrees = gradient.cwiseProduct(deputy);
  if (coordinates.start != JetCoordinates::cartesian) {
    const Columns6 by_coordinates = variables_by_coordinates(deputies, deputy, 1e-4 * separation);
    const Eigen::VectorXd slopes = by_coordinates.colPivHouseholderQr().solve(gradient);
    degrees = slopes.cwiseProduct(by_coordinates.transpose() * deputy);
  }
  Eigen::Index place = 0;
  limit.start_degree = degrees.maxCoeff(&place);
  limit.start_coordinate = names.start[static_cast<std::size_t>(place)];

  // The part of the miss that belongs to each value, along the direction of the miss.
  Eigen::VectorXd shares = (names.end_axes * miss).cwiseAbs2();
  if (coordinates.end != JetCoordinates::cartesian) {
    const Columns6 by_values =
        deviation_by_values(deputies.predictor(), deputies.deviation(deputy), order);
    const Eigen::VectorXd missed = by_values.colPivHouseholderQr().solve(error);
    shares = (by_values.topRows<3>().transpose() * miss).cwiseProduct(missed);
  }
  shares /= miss.squaredNorm();
  limit.end_share = shares.maxCoeff(&place);
  limit.end_coordinate = names.end[static_cast<std::size_t>(place)];
  return limit;
}

}  // namespace hamjet
