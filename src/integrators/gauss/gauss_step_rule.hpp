#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace hamjet {

/// Measures of a step of a Gauss method: largest magnitudes over its stages and components.
struct StepMeasures {
  double defect = 0;            ///< GaussStepControl::start_defect
  double slope = 0;             ///< largest slope g
  double first_gradient = 0;    ///< largest entry of Dg at the first stage
  double last_gradient = 0;     ///< at the last stage
  double largest_gradient = 0;  ///< at all stages
  double place = 0;             ///< size of the part of the initial state on which g depends
  double velocity = 0;          ///< velocity at the start, for a second-order system
  double time_noise = 0;        ///< what the rounding of the time changes in slopes, if it is known
};

/// The rule by which a Gauss method of s stages chooses its steps, from their measures: see
/// integrate_gauss. It applies to a jet of `order`, in numbers of the given epsilon.
class GaussStepRule {
 public:
  GaussStepRule(int stages, bool is_second_order, int order, double epsilon)
      : s_(stages), is_second_order_(is_second_order), order_(order), epsilon_(epsilon) {
    const double s = stages;
    pade_constant_ =
        std::pow(std::tgamma(s + 1), 2) / (std::tgamma(2 * s + 1) * std::tgamma(2 * s + 2));
  }

  /// The first step: the time in which the slopes change by about their own size, from a norm of
  /// the gradient at the start; for an orbit it is proportional to r^(3/2). It is at most the
  /// duration.
  double first_step(double norm, double tolerance, double duration) const {
    const double span = std::abs(duration);
    double h = span;
    if (norm > 0) h = is_second_order_ ? 1 / std::sqrt(norm) : 1 / norm;
    h *= 2 * std::pow(tolerance / error_constant, 0.5 / s_) * s_;
    return std::copysign(std::min(h, span), duration);
  }

  /// The error of a step relative to the slopes, from the Legendre mode of degree 2s of the slopes,
  /// which is the first that the method does not integrate. It is estimated by the square of the
  /// mode of degree s, which appears as the defect at the start of the step or, if the defect
  /// happens to vanish, by the last mode kept, which has the other parity. If the decay of the last
  /// modes suggests a larger value, that value is taken. `mode(k)` is the largest component of the
  /// mode of degree k.
  template <class Mode>
  double error_estimate(const StepMeasures& step, double h, const Mode& mode) const {
    const double slope = slope_scale(step);
    const double noise = slope_noise(step);
    std::array<double, 3> errors = {linearised_error(step, h), 0, 0};
    if (slope != 0) {
      double ratio = std::max(0.0, step.defect - noise) / slope;
      if (s_ > 1) {
        const double last = std::max(0.0, mode(s_ - 1) - noise) / slope;
        const double s = s_;
        // For a number below 1, its power would be less than the number.
        if (last > std::min(ratio, 1.0)) ratio = std::max(ratio, std::pow(last, s / (s - 1)));
      }
      errors[1] = error_constant * ratio * ratio;
      errors[2] = continued_modes(slope, noise, mode);
    }
    // Where a force has a singularity, slopes or gradients are infinite or NaN, and the steps must
    // be shorter.
    if (std::any_of(errors.begin(), errors.end(), [](double x) { return std::isnan(x); })) {
      return std::numeric_limits<double>::infinity();
    }
    return *std::max_element(errors.begin(), errors.end());
  }

  /// The length of the next step in that of one that is accepted, from the ratio of time scales in
  /// it (time_scale_ratio).
  double growth(double error, double tolerance, double time_scales) const {
    return std::clamp(step_factor(error, tolerance) * time_scales, least_factor, largest_factor);
  }

  /// The length in which a step is tried again that had too large an error; infinite where its
  /// stages were not found.
  double reduction(double error, double tolerance) const {
    return std::isfinite(error) ? std::min(step_factor(error, tolerance), 0.9) : 0.5;
  }

  /// The ratio of the time scales at the end and at the start of the step, from the slopes'
  /// gradients at its last and first stage. The next step starts where this one ends, and the time
  /// scale of an orbit, which is proportional to r^(3/2), changes much from one step to the next.
  double time_scale_ratio(const StepMeasures& step) const {
    if (step.first_gradient == 0 || step.last_gradient == 0) return 1;
    const double ratio = step.first_gradient / step.last_gradient;
    if (std::isnan(ratio)) return 1;
    return std::clamp(is_second_order_ ? std::sqrt(ratio) : ratio, 1 / largest_factor,
                      largest_factor);
  }

  /// Number of periods of the linearised motion in a step.
  double periods(const StepMeasures& step, double h) const {
    return std::abs(h) * frequency(step) / (2 * std::numbers::pi);
  }

  /// The longest step on which the stages resolve the shortest wave of the field. A field of n
  /// waves on a circle about the origin passes with a frequency of at most n |v| / |q|, and a
  /// Legendre expansion begins to converge at pi points per wave (Gottlieb and Orszag, Numerical
  /// Analysis of Spectral Methods, 1977, section 3). The error at the end of the step then behaves
  /// as the Bessel function J_2s(s), which is four digits with 8 stages.
  double longest_sampling_step(int waves, double distance_by_speed) const {
    return 2 * s_ * distance_by_speed / waves;
  }

 private:
  static constexpr double least_factor = 0.1;
  static constexpr double largest_factor = 4;

  double step_factor(double error, double tolerance) const {
    if (error <= 0) return largest_factor;
    return std::clamp(0.95 * std::pow(tolerance / error, 0.5 / s_), least_factor, largest_factor);
  }

  /// A measured factor. With it the global error of all coefficients of degree 0..4 over a few
  /// revolutions is near the tolerance, for 4 to 16 stages.
  static constexpr double error_constant = 100;

  /// The mode of degree 2s relative to the slopes, if the modes continue as the last five or four
  /// do. The square of the mode of degree s is right for a field of a single scale. A weak field of
  /// short waves (a zonal harmonic of high degree) shows only in the last modes, which then no
  /// longer decay. Such modes are the error of the nominal itself.
  template <class Mode>
  double continued_modes(double slope, double noise, const Mode& mode) const {
    if (s_ < 4) return 0;
    const int gap = s_ < 6 ? 2 : 3;
    // One of two neighbouring modes may vanish by symmetry.
    const double near = std::max(mode(s_ - 1), mode(s_ - 2)) / slope;
    if (near <= 8 * std::max(epsilon_, noise / slope)) return 0;
    const double far = std::max(mode(s_ - 1 - gap), mode(s_ - 2 - gap)) / slope;
    return near < far ? near * std::pow(near / far, (s_ + 2.0) / gap) : near;
  }

  /// Error of the deviations after one of their own periods. It does not show on a nominal at rest,
  /// or on one that does not move in the direction in which the deviations oscillate. For y' = i
  /// omega y the method is the diagonal Pade approximant of the exponential, with an error of
  ///   (s!)^2 / ((2s)! (2s+1)!) (h omega)^(2s+1)     (Hairer and Wanner, Solving ODEs II, IV.3)
  /// in each of 2 pi / (h omega) steps. The coefficients of degree d contain harmonics as well; as
  /// measured on circular orbits, whose nominal shows least of them, the frequency (1 + d/4) omega
  /// keeps their error within the tolerance.
  double linearised_error(const StepMeasures& step, double h) const {
    const double x = std::abs(h) * frequency(step) * (1 + 0.25 * std::min(order_, 4));
    double power = 1;
    for (int i = 0; i < s_; ++i) power *= x * x;
    return 2 * std::numbers::pi * pade_constant_ * power;
  }

  /// The largest frequency of the linearised equations at the stages.
  double frequency(const StepMeasures& step) const {
    return is_second_order_ ? std::sqrt(step.largest_gradient) : step.largest_gradient;
  }

  /// The rounding of a slope. Near rest the terms of a slope cancel, and each is about the gradient
  /// times the distance from the origin; a time that is large beside the scale of the field has few
  /// digits of it; and denormal numbers have few digits or none.
  double slope_noise(const StepMeasures& step) const {
    return 8 * (epsilon_ * step.first_gradient * step.place + step.time_noise +
                std::numeric_limits<double>::min());
  }

  /// Size of the slopes, which must not vanish where a single force passes through zero. For a
  /// second-order system, a frequency times the velocity is therefore counted as a slope too.
  double slope_scale(const StepMeasures& step) const {
    if (!is_second_order_) return step.slope;
    return std::max(step.slope, 0.5 * std::sqrt(step.first_gradient) * step.velocity);
  }

  int s_;
  bool is_second_order_;
  int order_;
  double epsilon_;
  double pade_constant_;  ///< (s!)^2 / ((2s)! (2s+1)!)
};

}  // namespace hamjet
