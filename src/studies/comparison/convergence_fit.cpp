#include "convergence_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hamjet {
namespace {

/// Errors less than this many times the smallest error of all runs may be round-off.
constexpr double above_floor = 100;
/// The leading term does not yet dominate errors above this.
constexpr double largest_error = 1e-2;
constexpr std::size_t fewest_points = 3;
constexpr std::size_t most_points = 4;
/// Largest scatter of log10(error) about the line.
constexpr double largest_scatter = 0.1;

double smallest_error(const ComparisonResult& result, std::size_t degree) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ComparedRun& run : result.runs) {
    if (run.is_finished()) smallest = std::min(smallest, run.error_by_degree[degree]);
  }
  return smallest;
}

/// If the error of a series rises again at its finest step, its round-off is above that of the best
/// run; the result is then the smallest error of the series. It is 0 if the error still falls.
double turning_error(const std::vector<ConvergencePoint>& finest_first) {
  if (finest_first.empty()) return 0;
  const auto smallest =
      std::min_element(finest_first.begin(), finest_first.end(),
                       [](const auto& a, const auto& b) { return a.error < b.error; });
  return smallest == finest_first.begin() ? 0 : smallest->error;
}

}  // namespace

std::vector<ConvergencePoint> usable_points(const ComparisonResult& result,
                                            const std::string& series, int degree) {
  const auto index = static_cast<std::size_t>(degree);
  std::vector<ConvergencePoint> points;
  for (const ComparedRun& run : result.runs) {
    if (run.series != series || !run.is_finished() || !run.settings.step_canonical) continue;
    // The step that was really taken: the duration is divided into equal steps not longer than
    // requested.
    points.push_back({std::abs(result.scene.duration) / static_cast<double>(run.statistics.steps),
                      run.error_by_degree[index], run.settings.label});
  }
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.step < b.step; });
  const double floor =
      std::max({above_floor * smallest_error(result, index), above_floor * turning_error(points),
                above_floor * std::numeric_limits<double>::epsilon(),
                result.smallest_claimed_error(degree)});
  std::erase_if(points, [&](const ConvergencePoint& point) {
    return point.error < floor || point.error > largest_error;
  });
  if (points.size() > most_points) points.resize(most_points);
  return points;
}

LogarithmicFit fit_logarithms(const std::vector<ConvergencePoint>& points, int correction) {
  const auto rows = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd terms(rows, correction == 0 ? 2 : 3);
  Eigen::VectorXd errors(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const ConvergencePoint& point = points[static_cast<std::size_t>(i)];
    terms(i, 0) = 1;
    terms(i, 1) = std::log10(point.step);
    // Steps are relative to the coarsest one, so that the columns have similar sizes.
    if (correction != 0) terms(i, 2) = std::pow(point.step / points.back().step, correction);
    errors(i) = std::log10(point.error);
  }
  const Eigen::VectorXd fit = terms.colPivHouseholderQr().solve(errors);
  return {fit(1), (terms * fit - errors).lpNorm<Eigen::Infinity>()};
}

std::optional<double> fitted_slope(const std::vector<ConvergencePoint>& points, int correction) {
  const LogarithmicFit fit = fit_logarithms(points, correction);
  return fit.scatter <= largest_scatter ? std::optional<double>(fit.slope) : std::nullopt;
}

ConvergenceFit convergence_fit_of(const CandidateSeries& series, int degree, double slope,
                                  const std::vector<ConvergencePoint>& points) {
  ConvergenceFit fit{series.name, degree, slope, series.order, {}};
  for (const ConvergencePoint& point : points) {
    fit.labels.push_back(point.label);
    fit.points.emplace_back(point.step, point.error);
  }
  return fit;
}

std::optional<ConvergenceFit> fit_convergence(const ComparisonResult& result,
                                              const CandidateSeries& series, int degree) {
  const auto points = usable_points(result, series.name, degree);
  if (points.size() < fewest_points) return std::nullopt;
  const auto slope = fitted_slope(points, 0);
  if (!slope) return std::nullopt;
  return convergence_fit_of(series, degree, *slope, points);
}

}  // namespace hamjet
