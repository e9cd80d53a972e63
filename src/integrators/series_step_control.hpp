#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gauss/stage_slopes.hpp"
#include "summed_jet.hpp"

namespace hamjet {

/// Judges a step of a Gauss method by every degree of the series, not by the nominal alone. In
/// complex time, coefficients of high degree have the same singularities as the nominal, but
/// stronger ones, so that their Legendre modes decay later.
///
/// With r_j the last Legendre mode of the slopes of degree j relative to these slopes, the local
/// error of degree d is about
///
///   100 max over j <= d of r_j r_(d-j) ,
///
/// which for d = 0 is the estimate of GaussStepControl for the nominal. The reason is that the
/// error of a Gauss method is bilinear in the neglected modes of the solution and of its adjoint,
/// and the degree-d part of a product is a sum of products of degrees that add up to d.
template <class Real, int Lanes>
class SeriesStepControl {
 public:
  using P = Pack<Real, Lanes>;

  /// The largest local error of a degree. The stages must hold all slices of the degrees 0..order
  /// of the step.
  static double error_estimate(const StageSlopes<Real, Lanes>& stages, const P& last_mode,
                               const FlowJet<Real>& jet, int order) {
    std::vector<double> ratios;
    for (int d = 0; d <= order; ++d) ratios.push_back(mode_ratio(stages, last_mode, jet, d));
    double largest = 0;
    for (std::size_t d = 0; d < ratios.size(); ++d) {
      for (std::size_t j = 0; 2 * j <= d; ++j) {
        largest = std::max(largest, ratios[j] * ratios[d - j]);
      }
    }
    return error_constant * largest;
  }

 private:
  /// The error_constant of GaussStepControl.
  static constexpr double error_constant = 100;

  static double mode_ratio(const StageSlopes<Real, Lanes>& stages, const P& last_mode,
                           const FlowJet<Real>& jet, int d) {
    const auto& system = stages.system();
    const std::size_t m = system.components();
    const SeriesSpace& space = jet[0].space();
    double mode = 0;
    double size = 0;
    double velocity = 0;
    for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
      const auto slope = [&](std::size_t c) { return stages.slope(c, k); };
      mode = std::max(mode, static_cast<double>(stages.template largest_component<Real>(
                                [&](std::size_t c) { return dot(last_mode, slope(c)); })));
      size = std::max(size, static_cast<double>(
                                largest_magnitude(stages.template largest_component<P>(slope))));
      if (!system.second_order()) continue;
      for (std::size_t c = 0; c < m; ++c) {
        velocity = std::max(velocity, std::abs(static_cast<double>(jet[m + c][k])));
      }
    }
    if (system.second_order()) {
      // Where a force passes through zero the slope alone would be too small a scale.
      if (!system.unit_mass()) {
        velocity *= std::abs(static_cast<double>(system.inverse_mass(0, 0)));
      }
      size = std::max(
          size, 0.5 * std::sqrt(static_cast<double>(stages.gradient_sizes().lane(0))) * velocity);
    }
    return size > 0 ? mode / size : 0;
  }
};

}  // namespace hamjet
