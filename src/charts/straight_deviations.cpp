#include "hamjet/charts/straight_deviations.hpp"

namespace hamjet {
namespace {

Eigen::Matrix<double, 6, 1> column_of(const SixNumbers<double>& numbers) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(numbers.data());
}

}  // namespace

StraightDeviations::StraightDeviations(const CanonicalChart<double>& chart,
                                       const SixNumbers<double>& state)
    : chart_(chart), coordinates_(chart.coordinates(state)) {
  image_ = column_of(chart_.state(coordinates_));
  const SpacePointer space = SeriesSpace::create(6, 1);
  const auto variable = [&](std::size_t i) { return Series<double>::variable(space, i, state[i]); };
  const SixNumbers<Series<double>> coordinates = chart_.coordinates(SixNumbers<Series<double>>{
      variable(0), variable(1), variable(2), variable(3), variable(4), variable(5)});
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      slope_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          coordinates[i][space->linear_index(j)];
    }
  }
}

Eigen::Matrix<double, 6, 1> StraightDeviations::operator()(
    const Eigen::Matrix<double, 6, 1>& linear) const {
  const Eigen::Matrix<double, 6, 1> change = slope_ * linear;
  SixNumbers<double> moved = coordinates_;
  for (std::size_t i = 0; i < 6; ++i) moved[i] += change[static_cast<Eigen::Index>(i)];
  return column_of(chart_.state(moved)) - image_;
}

std::vector<Series<double>> StraightDeviations::series(const SpacePointer& space) const {
  const auto moved = [&](std::size_t i) {
    Series<double> coordinate(space, coordinates_[i]);
    for (std::size_t j = 0; j < 6 && space->order() > 0; ++j) {
      coordinate[space->linear_index(j)] =
          slope_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
    return coordinate;
  };
  SixNumbers<Series<double>> state = chart_.state(
      SixNumbers<Series<double>>{moved(0), moved(1), moved(2), moved(3), moved(4), moved(5)});
  for (Series<double>& component : state) component[0] = 0;
  return {state.begin(), state.end()};
}

}  // namespace hamjet
