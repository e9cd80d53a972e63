#pragma once

#include "hamjet/algebra/composition.hpp"
#include "hamjet/charts/canonical_chart.hpp"

namespace hamjet {

/// Six series in six variables, where series i is the i-th number plus the i-th variable.
template <class Real>
SixNumbers<Series<Real>> moved(const SixNumbers<Real>& z, const SpacePointer& space) {
  const auto one = [&](std::size_t i) { return Series<Real>::variable(space, i, z[i]); };
  return {one(0), one(1), one(2), one(3), one(4), one(5)};
}

/// The linear part of six series, 6 x variables.
inline Matrix<double> linear_part(const SixNumbers<Series<double>>& z) {
  return linear_part(std::vector<Series<double>>(z.begin(), z.end()));
}

/// The derivative of a chart's coordinates by the state, 6 x 6.
inline Matrix<double> coordinates_derivative(const CanonicalChart<double>& chart,
                                             const SixNumbers<double>& state) {
  return linear_part(chart.coordinates(moved(state, SeriesSpace::create(6, 1))));
}

/// The derivative of the state by a chart's coordinates, 6 x 6.
inline Matrix<double> state_derivative(const CanonicalChart<double>& chart,
                                       const SixNumbers<double>& coordinates) {
  return linear_part(chart.state(moved(coordinates, SeriesSpace::create(6, 1))));
}

}  // namespace hamjet
