#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>

#include "../descriptions/method_description.hpp"
#include "../integration.hpp"
#include "../reference.hpp"
#include "convergence_fit.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr std::size_t runs = 4;
/// The error of the finest run must exceed the reference's uncertainty by this factor.
constexpr double above_claimed = 30;
/// Runs over the whole duration need no smaller error than this floor, and at most
/// `most_refinement` times as many steps as the runs in double precision.
constexpr double smallest_floor = 1e-20;
constexpr double most_refinement = 64;
/// The coarsest error is this many times the finest one, unless this would take more than half the
/// steps.
constexpr double error_range = 1e5;
/// The fractions of the duration that are tried, and the tolerance of the references for the
/// shorter ones.
constexpr std::array arcs = {1.0, 1.0 / 8, 1.0 / 64};
constexpr double arc_tolerance = 1e-31;
/// Number of steps after which the time of all runs is predicted.
constexpr long least_steps = 10;

using Clock = std::chrono::steady_clock;

/// Thrown if the runs would take longer than allowed.
struct AllTooSlow {};

/// The numbers of steps, the largest first, that continue a usable run down to the error `floor`.
std::vector<long> step_counts(const ConvergencePoint& start, double duration, double order,
                              double floor) {
  const double refinement = std::pow(start.error / floor, 1 / order);
  const double most = duration / start.step * std::min(refinement, most_refinement);
  const double ratio = std::min(2.0, std::pow(error_range, 1 / (order * (runs - 1))));
  std::vector<long> counts;
  for (std::size_t k = 0; k < runs; ++k) {
    counts.push_back(std::lround(most / std::pow(ratio, k)));
  }
  return counts;
}

/// One fit over one fraction of the duration.
std::optional<ConvergenceFit> fit_over_arc(const ComparisonResult& result,
                                           const CandidateSeries& series, int degree, double arc,
                                           double seconds,
                                           const std::function<void(double)>& keep_going) {
  ConvergencePoint finest = usable_points(result, series.name, degree).front();
  Scene scene = result.scene;
  scene.order = degree;
  scene.integrators.clear();
  scene.kinds.reset();
  scene.duration *= arc;
  finest.error *= arc;
  const ComputedProblem problem = make_problem(scene);
  const auto flow = flow_problem<Extended>(problem, scene.duration);
  const bool is_whole = arc == 1;
  const ReferenceResult reference =
      is_whole ? truncated_reference(result.reference, problem.space)
               : compute_reference(problem, scene.duration, {arc_tolerance}, Precision::extended,
                                   keep_going);
  const double claimed = is_whole ? result.smallest_claimed_error(degree)
                                  : 10 * reference.uncertainty_by_degree.back();
  const double floor = std::max(above_claimed * claimed, is_whole ? smallest_floor : 0);
  const double span = std::abs(scene.duration);
  const auto counts = step_counts(finest, span, series.order, floor);
  // With so few steps, runs become equal when their number of steps is rounded, and prove nothing.
  if (counts.back() < static_cast<long>(2 * runs)) return std::nullopt;
  const long total = std::accumulate(counts.begin(), counts.end(), 0L);

  IntegratorSettings settings = series.candidates.front().settings;
  std::vector<ConvergencePoint> points;
  long done = 0;
  const auto start = Clock::now();
  // The coarsest run comes first, because it shows how long the others take.
  for (std::size_t k = runs; k-- > 0;) {
    settings.step_canonical = span / (static_cast<double>(counts[k]) - 0.5);
    IntegrationStatistics statistics;
    const auto jet = integrate<Extended>(
        flow, settings, statistics, [&](const Extended&, const FlowJet<Extended>&) {
          keep_going(static_cast<double>(++done) / static_cast<double>(total));
          // The time so far predicts the time of the rest.
          const std::chrono::duration<double> spent = Clock::now() - start;
          if (spent.count() * static_cast<double>(total) > seconds * static_cast<double>(done) &&
              done >= least_steps) {
            throw AllTooSlow{};
          }
        });
    const double error =
        relative_error_by_degree(jet, reference.jet)[static_cast<std::size_t>(degree)];
    if (error < claimed) return std::nullopt;
    points.push_back({span / static_cast<double>(statistics.steps), error,
                      fmt::format("{} steps", statistics.steps)});
  }
  std::reverse(points.begin(), points.end());
  const auto slope = fitted_slope(points, description_of(settings.method).error_correction);
  if (!slope) return std::nullopt;
  ConvergenceFit fit = convergence_fit_of(series, degree, *slope, points);
  fit.is_extended = true;
  fit.arc = arc;
  return fit;
}

}  // namespace

std::optional<ConvergenceFit> fit_extended_convergence(
    const ComparisonResult& result, const CandidateSeries& series, int degree, double seconds,
    const std::function<void(double)>& keep_going) {
  if (usable_points(result, series.name, degree).empty() || series.candidates.front().integrate) {
    return std::nullopt;
  }
  std::optional<ConvergenceFit> best;
  for (const double arc : arcs) {
    try {
      auto fit = fit_over_arc(result, series, degree, arc, seconds, keep_going);
      if (fit && fit->agrees()) return fit;
      if (fit) best = std::move(fit);
    } catch (const AllTooSlow&) {
      continue;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
    }
  }
  return best;
}

}  // namespace hamjet
