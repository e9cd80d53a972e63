#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "../real_number.hpp"
#include "../summed_jet.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "stage_slopes.hpp"

namespace hamjet {

/// Chooses the steps of a Gauss method from the nominal: see GaussSettings and integrate_gauss.
template <class Real, int Lanes>
class GaussStepControl {
 public:
  using P = Pack<Real, Lanes>;

  /// Looks at the objects of the integrator that it serves, which must outlive it.
  GaussStepControl(const GaussSettings& settings, StageSlopes<Real, Lanes>& stages,
                   SummedJet<Real, Lanes>& jet, int order)
      : settings_(settings), stages_(stages), jet_(jet), order_(order) {
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
      const Real difference = stages_.slope_at_start(c) - end_slope[c];
      result = std::max(result, std::abs(static_cast<double>(difference)));
    }
    return result;
  }

  /// The error of a step, from the Legendre mode of degree 2s of the slopes, the first that the
  /// method does not integrate, relative to the slopes: the square of the mode of degree s, which
  /// shows as the defect at the start of the step (where that happens to vanish, the last mode
  /// kept, which has the other parity, does not), or what the decay of the last modes lets expect,
  /// if that is more.
  double error_estimate(const Real& h, const std::vector<Real>& start_slope) {
    const double slope = slope_scale();
    if (slope == 0) return linearised_error(h);
    const double noise = slope_noise();
    double ratio = std::max(0.0, start_defect(start_slope) - noise) / slope;
    const double s = settings_.stages;
    if (s > 1) {
      const double last = std::max(0.0, mode(settings_.stages - 1) - noise) / slope;
      ratio = std::max(ratio, std::pow(last, s / (s - 1)));
    }
    return std::max({error_constant * ratio * ratio, continued_modes(slope), linearised_error(h)});
  }

  /// The mode of degree 2s, relative to the slopes, if the modes go on as the last five or four do.
  /// The square of the mode of degree s is right for a field of one scale. A weak field of short
  /// waves (a zonal harmonic of high degree) shows only in the last modes, which then no longer
  /// decay. This is the error of the nominal itself.
  double continued_modes(double slope) {
    const int s = settings_.stages;
    if (s < 4) return 0;
    const int gap = s < 6 ? 2 : 3;
    // One of two neighbouring modes may vanish by symmetry.
    const double near = std::max(mode(s - 1), mode(s - 2)) / slope;
    if (near <= 8 * std::max(epsilon, slope_noise() / slope)) return 0;
    const double far = std::max(mode(s - 1 - gap), mode(s - 2 - gap)) / slope;
    const double decay = near < far ? std::pow(near / far, 1.0 / gap) : 1;
    return near * std::pow(decay, s + 2);
  }

  /// The longest step on which the stages resolve the shortest wave of the field, from a state: a
  /// field of n waves on a circle about the origin passes at n |v| / |q| at most, and a Legendre
  /// expansion begins to converge at pi points a wave (Gottlieb and Orszag, Numerical Analysis of
  /// Spectral Methods, 1977, section 3). The end of the step, whose error goes as the Bessel
  /// function J_2s(s) then, is good to four digits with 8 stages. Infinite where the system has no
  /// such field.
  template <class State>
  double longest_sampling_step(const DynamicalSystem& system, const State& state) const {
    if (system.waves_on_a_circle == 0) return std::numeric_limits<double>::infinity();
    const std::size_t n = system.degrees_of_freedom;
    double distance = 0;
    double speed = 0;
    for (std::size_t c = 0; c < n; ++c) {
      distance = std::hypot(distance, static_cast<double>(state(c)));
      speed = std::hypot(speed, static_cast<double>(state(n + c)));
    }
    return 2 * settings_.stages * distance / (system.waves_on_a_circle * speed);
  }

  /// Error of the deviations after one of their own periods. A nominal at rest, or one that does
  /// not move in a direction in which the deviations oscillate, shows nothing of it. For
  /// y' = i omega y the method is the diagonal Pade approximant of the exponential, with an error
  /// of
  ///   (s!)^2 / ((2s)! (2s+1)!) (h omega)^(2s+1)     (Hairer and Wanner, Solving ODEs II, IV.3)
  /// in each of 2 pi / (h omega) steps. The coefficients of degree d hold harmonics too; measured
  /// on circular orbits, whose nominal shows least, (1 + d/4) omega keeps them to the tolerance.
  double linearised_error(const Real& h) {
    const double frequency = this->frequency() * (1 + 0.25 * std::min(order_, 4));
    return 2 * std::numbers::pi * pade_constant_ *
           std::pow(static_cast<double>(magnitude(h)) * frequency, 2 * settings_.stages);
  }

  /// The largest frequency of the linearised equations at the stages.
  double frequency() {
    const double gradient = stages_.largest_gradient();
    return stages_.system().second_order() ? std::sqrt(gradient) : gradient;
  }

  /// Periods of the linearised motion in a step.
  double periods(const Real& h) {
    return static_cast<double>(magnitude(h)) * frequency() / (2 * std::numbers::pi);
  }

  /// The weights of the Legendre mode of degree s - 1.
  const P& last_mode_weights() const { return stages_.system().coefficients().modes.back(); }

  /// The largest component of the Legendre mode of one degree, below s, of the slopes.
  double mode(int degree) {
    double result = 0;
    const P& weights = stages_.system().coefficients().modes[static_cast<std::size_t>(degree)];
    for (const P& slope : stages_.slopes()) {
      result = std::max(result, std::abs(static_cast<double>(dot(weights, slope))));
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
  /// A measured factor: with it the global error of all coefficients of degree 0..4 over a few
  /// revolutions comes out near the tolerance, for 4 to 16 stages.
  static constexpr double error_constant = 100;

  /// What rounding makes of a slope: near rest its terms cancel, each about the gradient times the
  /// distance from the origin; and denormal numbers have few digits or none.
  double slope_noise() {
    double size = 0;
    for (std::size_t c = 0; c < stages_.system().components(); ++c) {
      size = std::max(size, std::abs(static_cast<double>(jet_.value()[c][0])));
    }
    return 8 * (epsilon * stages_.largest_gradient(0) * size + std::numeric_limits<double>::min());
  }

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

  const double epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());

  const GaussSettings& settings_;
  StageSlopes<Real, Lanes>& stages_;
  SummedJet<Real, Lanes>& jet_;
  int order_;             ///< of the jet
  double pade_constant_;  ///< (s!)^2 / ((2s)! (2s+1)!)
};

}  // namespace hamjet
