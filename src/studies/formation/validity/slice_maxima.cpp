#include "slice_maxima.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hamjet {

SliceMaxima::SliceMaxima(const DeputyFlow& flow, const Matrix6& axes)
    : variables_(flow.entry_derivative() * axes), values_(flow.polynomials()[0].space_pointer()) {
  const Matrix<double> exit = flow.exit_derivative();
  for (Eigen::Index i = 0; i < 3; ++i) {
    Series<double> position(flow.polynomials()[0].space_pointer());
    for (std::size_t c = 0; c < flow.polynomials().size(); ++c) {
      position += exit(i, static_cast<Eigen::Index>(c)) * flow.polynomials()[c];
    }
    positions_.push_back(std::move(position));
  }
}

SliceMaxima::SliceMaxima(std::vector<Series<double>> positions, Matrix<double> variables)
    : positions_(std::move(positions)),
      variables_(std::move(variables)),
      values_(positions_[0].space_pointer()) {}

void SliceMaxima::set_point(const Vector6& coordinates) {
  const Matrix<double> point = variables_ * coordinates;
  values_.set_point({point.data(), static_cast<std::size_t>(point.size())});
}

double SliceMaxima::size(const Vector6& coordinates, int degree) {
  set_point(coordinates);
  return std::hypot(values_.slice(positions_[0], degree), values_.slice(positions_[1], degree),
                    values_.slice(positions_[2], degree));
}

Vector6 SliceMaxima::worst_from(Vector6 point, int degree) {
  constexpr int most_iterations = 30;
  double largest = size(point, degree);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    set_point(point);
    Matrix<double> by_variable = Matrix<double>::Zero(variables_.rows(), 1);
    for (const Series<double>& position : positions_) {
      const double value = values_.slice(position, degree);
      for (Eigen::Index v = 0; v < variables_.rows(); ++v) {
        const auto variable = static_cast<std::size_t>(v);
        by_variable(v, 0) += value * (values_.derivative(position, variable, degree) -
                                      values_.derivative(position, variable, degree - 1));
      }
    }
    const Vector6 gradient = variables_.transpose() * by_variable;
    Vector6 next = point;
    for (Eigen::Index first : {Eigen::Index{0}, Eigen::Index{3}}) {
      const double length = gradient.segment<3>(first).norm();
      if (length > 0) next.segment<3>(first) = gradient.segment<3>(first) / length;
    }
    const double found = size(next, degree);
    if (!(found > largest * (1 + 1e-6))) break;
    largest = found;
    point = next;
  }
  return point;
}

std::vector<Vector6> SliceMaxima::maxima(const std::vector<Vector6>& samples, int degree) {
  // The results of two ascents to one maximum are no further apart.
  constexpr double same = 0.1;
  std::vector<std::pair<double, Vector6>> maxima;
  for (const Vector6& sample : samples) {
    const Vector6 found = worst_from(sample, degree);
    const bool is_known = std::any_of(maxima.begin(), maxima.end(), [&](const auto& maximum) {
      return (maximum.second - found).norm() < same;
    });
    if (!is_known) maxima.emplace_back(size(found, degree), found);
  }
  std::sort(maxima.begin(), maxima.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Vector6> deviations;
  for (const auto& [contribution, deviation] : maxima) deviations.push_back(deviation);
  return deviations;
}

std::vector<Vector6> SliceMaxima::maxima_and(const std::vector<Vector6>& samples, int degree) {
  // The worst deviations come first, because a deputy that misses by far ends the trial.
  std::vector<Vector6> all = maxima(samples, degree);
  all.insert(all.end(), samples.begin(), samples.end());
  return all;
}

}  // namespace hamjet
