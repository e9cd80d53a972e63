#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "hamjet/integrators/gauss_collocation.hpp"
#include "real_number.hpp"
#include "stage_slopes.hpp"
#include "summed_jet.hpp"

namespace hamjet {

/// Chooses the steps of a Gauss method from the nominal: see GaussSettings and integrate_gauss.
template <class Real, int Lanes>
class GaussStepControl {
 public:
  using P = Pack<Real, Lanes>;

  /// Looks at what the integrator that it serves has in these objects.
  GaussStepControl(const GaussSettings& settings, const GaussTableau& tableau,
                   StageSlopes<Real, Lanes>& stages, SummedJet<Real, Lanes>& jet, int order)
      : settings_(settings), stages_(stages), jet_(jet), order_(order) {
    for (std::size_t i = 0; i < tableau.stages; ++i) {
      last_mode_.set_lane(static_cast<int>(i), convert<Real>(tableau.last_mode[i]));
    }
    const double s = settings.stages;
    pade_constant_ =
        std::pow(std::tgamma(s + 1), 2) / (std::tgamma(2 * s + 1) * std::tgamma(2 * s + 2));
  }

  /// The time in which the slopes change by about their own size, from the gradient at the start,
  /// where `point` has the vector field; for an orbit it is proportional to r^(3/2).
  Real first_step(SliceEvaluator<Real, Real>& point, const Real& duration) {
    const std::size_t m = stages_.system().components();
    double norm = 0;
    for (std::size_t c = 0; c < m; ++c) {
      double row = 0;
      for (std::size_t k = 0; k < m; ++k) {
        row += std::abs(static_cast<double>(point.output_gradient(c, k)));
      }
      norm = std::max(norm, row);
    }
    const double span = static_cast<double>(magnitude(duration));
    double h = span;
    if (norm > 0) h = (stages_.system().second_order() ? 1 / std::sqrt(norm) : 1 / norm);
    h *= 2 * std::pow(*settings_.tolerance / error_constant, 0.5 / settings_.stages) *
         settings_.stages;
    h = std::min(h, span);
    return duration < 0 ? Real(-h) : Real(h);
  }

  /// Distance, at the start of the step, between the slope there and the collocation polynomial.
  double start_defect(const std::vector<Real>& end_slope) {
    double result = 0;
    for (std::size_t c = 0; c < end_slope.size(); ++c) {
      const Real difference = stages_.slope_polynomial(c, Real(0)) - end_slope[c];
      result = std::max(result, std::abs(static_cast<double>(difference)));
    }
    return result;
  }

  /// The square of the first neglected Legendre mode of the slopes, relative to the slopes. That
  /// mode shows as the defect at the start of the step; where it happens to vanish, the last mode
  /// kept, which has the other parity, does not.
  double error_estimate(const Real& h, const std::vector<Real>& start_slope) {
    const double slope = slope_scale();
    if (slope == 0) return linearised_error(h);
    double ratio = start_defect(start_slope) / slope;
    const double s = settings_.stages;
    if (s > 1) ratio = std::max(ratio, std::pow(last_mode() / slope, s / (s - 1)));
    return std::max(error_constant * ratio * ratio, linearised_error(h));
  }

  /// Error of the deviations after one of their own periods. A nominal at rest, or one that does
  /// not move in a direction in which the deviations oscillate, shows nothing of it. For
  /// y' = i omega y the method is the diagonal Pade approximant of the exponential, with an error
  /// of
  ///   (s!)^2 / ((2s)! (2s+1)!) (h omega)^(2s+1)     (Hairer and Wanner, Solving ODEs II, IV.3)
  /// in each of 2 pi / (h omega) steps. The coefficients of degree d hold harmonics too; measured
  /// on circular orbits, whose nominal shows least, (1 + d/4) omega keeps them to the tolerance.
  double linearised_error(const Real& h) {
    double frequency = stages_.largest_gradient();
    if (stages_.system().second_order()) frequency = std::sqrt(frequency);
    frequency *= 1 + 0.25 * std::min(order_, 4);
    return 2 * std::numbers::pi * pade_constant_ *
           std::pow(static_cast<double>(magnitude(h)) * frequency, 2 * settings_.stages);
  }

  /// The largest component of the Legendre mode of degree s - 1 of the slopes.
  double last_mode() {
    double result = 0;
    for (const P& slope : stages_.slopes()) {
      result = std::max(result, std::abs(static_cast<double>(dot(last_mode_, slope))));
    }
    return result;
  }

  double step_factor(double error) const {
    if (error <= 0) return 4;
    const double factor = 0.95 * std::pow(*settings_.tolerance / error, 0.5 / settings_.stages);
    return std::clamp(factor, 0.1, 4.0);
  }

  /// How the time scale of the dynamics changes over the step, from the slopes' gradients at its
  /// first and last stage: the next step starts where this one ends, and an orbit's time scale,
  /// which goes as r^(3/2), changes much from one step to the next.
  double time_scale_ratio() {
    const double first = stages_.largest_gradient(0);
    const double last = stages_.largest_gradient(settings_.stages - 1);
    if (first == 0 || last == 0) return 1;
    const double ratio = stages_.system().second_order() ? std::sqrt(first / last) : first / last;
    return std::clamp(ratio, 0.25, 4.0);
  }

 private:
  /// Measured: with this factor the global error of all coefficients of degree 0..4 over a few
  /// revolutions comes out near the tolerance, for 4 to 16 stages.
  static constexpr double error_constant = 100;

  /// Size of the slopes, which does not vanish where a single force passes through zero: with a
  /// second-order system a frequency times the velocity is a slope too.
  double slope_scale() {
    const double slope = stages_.largest_slope();
    if (!stages_.system().second_order()) return slope;
    const std::size_t m = stages_.system().components();
    double velocity = 0;
    for (std::size_t c = 0; c < m; ++c) {
      velocity = std::max(velocity, std::abs(static_cast<double>(jet_.value()[m + c][0])));
    }
    if (!stages_.system().unit_mass()) {
      velocity *= std::abs(static_cast<double>(stages_.system().inverse_mass(0, 0)));
    }
    return std::max(slope, 0.5 * std::sqrt(stages_.largest_gradient(0)) * velocity);
  }

  const GaussSettings& settings_;
  StageSlopes<Real, Lanes>& stages_;
  SummedJet<Real, Lanes>& jet_;
  int order_;             ///< of the jet
  double pade_constant_;  ///< (s!)^2 / ((2s)! (2s+1)!)
  P last_mode_{Real(0)};  ///< weights of the Legendre mode of degree s - 1
};

}  // namespace hamjet
