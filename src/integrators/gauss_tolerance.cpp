#include "gauss_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "directional_flow.hpp"
#include "gauss_lanes.hpp"
#include "hamjet/algebra/extended.hpp"

namespace hamjet {
namespace {

/// Of the tolerance and the number of periods, what the error of a degree may come to.
constexpr double allowed_excess = 3;
/// A trial aims this far below what is allowed, for the error is only about proportional.
constexpr double aim = 0.1;
/// The least factor between the tolerances of two trials.
constexpr double least_reduction = 1e-8;
constexpr int most_trials = 4;
/// From this degree on the zonal harmonics are weak and short enough to hide from the step control.
constexpr int least_short_waves = 5;

/// Below this the step control, which squares a defect of slopes, sees rounding alone.
template <class Real>
double smallest_step_tolerance() {
  const double noise = 64 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  return 100 * noise * noise;
}

/// The errors of one trial.
struct Trial {
  double tolerance = 0;
  std::vector<double> error_by_degree;
  double limit = 0;

  double excess(std::size_t degree) const { return error_by_degree[degree] / limit; }
  double largest_excess() const {
    return *std::max_element(error_by_degree.begin(), error_by_degree.end()) / limit;
  }
};

template <class Real>
FlowJet<Real> integrate_as_given(const FlowProblem<Real>& problem, const GaussSettings& settings,
                                 IntegrationStatistics& statistics) {
  statistics = {};
  return with_lanes(settings.stages, [&]<int Lanes>(std::integral_constant<int, Lanes>) {
    return run_gauss<Lanes>(problem, settings, statistics, StepObserver<Real>{});
  });
}

template <class Real>
Trial try_tolerance(const DirectionalFlow<Real>& flow, const GaussSettings& settings,
                    double tolerance) {
  GaussSettings coarse = settings;
  coarse.tolerance = tolerance;
  coarse.profile = nullptr;
  const GaussSettings fine = finer_gauss<Real>(settings, tolerance);
  IntegrationStatistics statistics;
  const auto with = [&](const GaussSettings& used) {
    return flow.integrate(
        [&](const FlowProblem<Real>& line) { return integrate_as_given(line, used, statistics); });
  };
  const auto lines = with(coarse);
  Trial trial{tolerance, flow.relative_difference(lines, with(fine)), 0};
  trial.limit = allowed_excess * *settings.tolerance * std::max(1.0, statistics.periods);
  return trial;
}

/// With errors proportional to the tolerance, the one at which truncation has fallen to what
/// `last`, which fell less, shows to be rounding.
double where_rounding_begins(const Trial& first, const Trial& last) {
  double ratio = 1;
  for (std::size_t d = 0; d < first.error_by_degree.size(); ++d) {
    if (first.excess(d) > 1) {
      ratio = std::min(ratio, last.error_by_degree[d] / first.error_by_degree[d]);
    }
  }
  return std::max(last.tolerance, ratio * first.tolerance);
}

}  // namespace

template <class Real>
GaussSettings finer_gauss(const GaussSettings& settings, double tolerance) {
  GaussSettings fine;
  fine.stages = settings.stages < 8 ? 8 : (settings.stages == 12 ? 10 : 12);
  fine.tolerance = std::max(1e-3 * tolerance, smallest_step_tolerance<Real>());
  fine.compensated_summation = true;
  return fine;
}

template <class Real>
StepTolerance choose_step_tolerance(const FlowProblem<Real>& problem,
                                    const GaussSettings& settings) {
  const double asked = settings.tolerance.value_or(0);
  const bool is_chosen_in_steps = !settings.tolerance || settings.controls_all_degrees;
  // Of the nominal alone the step control knows enough, unless the field has waves that are much
  // shorter than the rest of it.
  const bool is_known =
      problem.space->order() == 0 && problem.system->waves_on_a_circle < least_short_waves;
  if (is_chosen_in_steps || is_known || problem.duration == 0) {
    return {asked, {}};
  }
  const double smallest = smallest_step_tolerance<Real>();
  const DirectionalFlow<Real> flow(problem, 2);
  Trial first = try_tolerance(flow, settings, asked);
  if (!(first.largest_excess() > 1)) return {asked, {}};
  for (int i = 1; i < most_trials; ++i) {
    const double wanted = std::isfinite(first.largest_excess())
                              ? std::max(aim / first.largest_excess(), least_reduction)
                              : least_reduction;
    const double next = std::max(wanted * first.tolerance, smallest);
    if (!(next < first.tolerance)) break;
    Trial trial = try_tolerance(flow, settings, next);
    if (!(trial.largest_excess() > 1)) return {next, {}};
    // Ten times as far from the law of proportion as truncation would be: rounding.
    const double expected = first.largest_excess() * next / first.tolerance;
    if (trial.largest_excess() > 10 * expected || next == smallest) {
      return {where_rounding_begins(first, trial), trial.error_by_degree};
    }
    first = std::move(trial);
  }
  return {first.tolerance, first.error_by_degree};
}

template StepTolerance choose_step_tolerance(const FlowProblem<double>&, const GaussSettings&);
template StepTolerance choose_step_tolerance(const FlowProblem<Extended>&, const GaussSettings&);
template GaussSettings finer_gauss<double>(const GaussSettings&, double);
template GaussSettings finer_gauss<Extended>(const GaussSettings&, double);

}  // namespace hamjet
