#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "hamjet/studies/comparison.hpp"

namespace hamjet {

/// Fits the order of convergence of a series with fixed steps at one degree, from the finest runs
/// that lie well above the rounding floor. No value with too few of them, or if the errors do not
/// yet follow a power of the step.
std::optional<ConvergenceFit> fit_convergence(const ComparisonResult& result,
                                              const CandidateSeries& series, int degree);

/// Fits the order of convergence from runs in extended precision, where many more digits lie
/// between the steps at which the leading term dominates and the rounding floor: these steps
/// continue those of the series' finest usable run. If the whole duration shows no order within 0.3
/// of theory, or would take longer than `seconds`, shorter arcs from its start are tried, with
/// references of their own; over these the leading term dominates at longer steps. `keep_going` is
/// called with the fraction that is done and may throw. No value if a custom integrator has no
/// extended precision, if no run of the series is usable, or if even the shortest arc takes too
/// long.
std::optional<ConvergenceFit> fit_extended_convergence(
    const ComparisonResult& result, const CandidateSeries& series, int degree, double seconds,
    const std::function<void(double)>& keep_going);

/// The finest runs of a series that can be used in a fit at one degree, the finest first: step
/// (canonical) and relative error, with labels.
struct ConvergencePoint {
  double step;
  double error;
  std::string label;
};
std::vector<ConvergencePoint> usable_points(const ComparisonResult& result,
                                            const std::string& series, int degree);

/// A least-squares fit of log10(error) against log10(step).
struct LogarithmicFit {
  double slope = 0;
  double scatter = 0;  ///< largest distance of a point, in decades
};

/// Fits the slope and, unless `correction` is 0, a term in step^correction beside it.
LogarithmicFit fit_logarithms(const std::vector<ConvergencePoint>& points, int correction);

/// The slope that fit_logarithms gives; no value if a point is further than a tenth of a decade
/// from the fitted line.
std::optional<double> fitted_slope(const std::vector<ConvergencePoint>& points, int correction);

/// The fit of a series at one degree, with this slope and these points.
ConvergenceFit convergence_fit_of(const CandidateSeries& series, int degree, double slope,
                                  const std::vector<ConvergencePoint>& points);

}  // namespace hamjet
