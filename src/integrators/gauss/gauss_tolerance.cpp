#include "gauss_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

#include "../../algebra/instantiated_real.hpp"
#include "../concurrent_tasks.hpp"
#include "gauss_lanes.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/algebra/extended.hpp"

namespace hamjet {
namespace {

/// The largest allowed error of a degree, in units of the tolerance times the number of periods.
constexpr double allowed_excess = 3;
/// A trial aims at this fraction of the allowed error, because the error falls only approximately
/// as expected.
constexpr double aim = 0.1;
/// The least ratio between the tolerances of two successive trials.
constexpr double least_reduction = 1e-5;
/// The largest ratio after a trial whose steps were no shorter than those of the trial before. Then
/// the waves of the field still limit the steps, not the tolerance.
constexpr double next_reduction = 1e-3;
constexpr int most_trials = 6;
/// In a single trial errors of truncation may cancel, so that the next trial has no smaller ones;
/// in two trials this does not happen.
constexpr int stalls_of_rounding = 2;
/// Finer steps also serve the next trial if their tolerance is smaller than that of the trial by
/// this factor: their own error is then a thirtieth of the measured one.
constexpr double fine_enough = 30;
/// Lines with more steps than this are tried only twice, because each trial is then a large part of
/// the whole work.
constexpr long most_steps_of_more_trials = 10000;
/// If a degree has fewer than two digits, the steps are too coarse for convergence, so that an
/// error that is not halved by shorter steps need not be rounding.
constexpr double largest_converging_error = 1e-2;
/// From this degree on, zonal harmonics are so weak and short that the step control may miss them.
constexpr int least_short_waves = 5;

/// Below this tolerance the step control, which squares a defect of slopes, measures rounding
/// alone.
template <class Real>
double smallest_step_tolerance() {
  const double noise = 64 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  return 100 * noise * noise;
}

/// One trial and its errors.
template <class Real>
struct Trial {
  double tolerance = 0;
  std::vector<FlowJet<Real>> lines;
  std::vector<FlowJet<Real>> finer_lines;
  std::vector<double> error_by_degree;
  double limit = 0;
  long steps = 0;
  double finer_tolerance = 0;
  double periods = 0;  ///< number of periods, from the finer lines

  double excess(std::size_t degree) const { return error_by_degree[degree] / limit; }
  double largest_error() const {
    return *std::max_element(error_by_degree.begin(), error_by_degree.end());
  }
  double largest_excess() const { return largest_error() / limit; }
};

template <class Real>
void judge(Trial<Real>& trial, const DirectionalFlow<Real>& flow, const GaussSettings& settings) {
  trial.error_by_degree = flow.relative_difference(trial.lines, trial.finer_lines);
  trial.limit = allowed_excess * *settings.tolerance * std::max(1.0, trial.periods);
}

/// Tries a tolerance. The jet of a first trial, or the finer lines of the previous trial, may be
/// available already.
template <class Real>
Trial<Real> try_tolerance(const DirectionalFlow<Real>& flow, const GaussSettings& settings,
                          double tolerance, std::size_t threads, const FirstTrial<Real>* known,
                          const Trial<Real>* before = nullptr) {
  const FlowProblem<Real> problem = flow.problem();
  const bool has_finer = before != nullptr && fine_enough * before->finer_tolerance <= tolerance;
  GaussSettings own = settings;
  own.tolerance = tolerance;
  own.profile = nullptr;
  const GaussSettings finest = finer_gauss<Real>(settings, tolerance);
  struct Run {
    const GaussSettings& settings;
    FlowJet<Real> jet;
    IntegrationStatistics statistics;
  };
  Run coarse{own, {}, {}};
  Run finer{finest, {}, {}};
  // The steps that were asked for come first: if both runs fail, the failure of these steps is
  // reported.
  std::vector<Run*> runs;
  if (known == nullptr) runs.push_back(&coarse);
  if (!has_finer) runs.push_back(&finer);
  run_concurrently(
      runs.size(), threads,
      [&](std::size_t i, TaskControl&) {
        runs[i]->jet = run_gauss<Real>(problem, runs[i]->settings, runs[i]->statistics);
      },
      [](long) {});
  Trial<Real> trial;
  trial.tolerance = tolerance;
  trial.lines = known != nullptr ? flow.restrict(known->jet) : flow.lines(coarse.jet);
  trial.steps = known != nullptr ? known->statistics.steps : coarse.statistics.steps;
  trial.finer_lines = has_finer ? before->finer_lines : flow.lines(finer.jet);
  trial.finer_tolerance = has_finer ? before->finer_tolerance : *finest.tolerance;
  trial.periods = has_finer ? before->periods : finer.statistics.periods;
  judge(trial, flow, settings);
  return trial;
}

/// The power of the tolerance with which the largest error fell from one trial to the next. It is 1
/// where the step control measures the error that it limits, and less for high degrees, which it
/// does not measure.
template <class Real>
double convergence(const Trial<Real>& before, const Trial<Real>& after) {
  const double fall = std::log(before.largest_excess() / after.largest_excess());
  const double power = fall / std::log(before.tolerance / after.tolerance);
  return std::isfinite(power) ? std::clamp(power, 0.4, 1.0) : 1;
}

/// The tolerance at which the truncation error has fallen to the errors of `last`, which are
/// rounding and do not fall with shorter steps.
template <class Real>
double where_rounding_begins(const Trial<Real>& before, const Trial<Real>& last) {
  double ratio = 1;
  for (std::size_t d = 0; d < before.error_by_degree.size(); ++d) {
    if (before.excess(d) > 1) {
      ratio = std::min(ratio, last.error_by_degree[d] / before.error_by_degree[d]);
    }
  }
  return std::max(last.tolerance, ratio * before.tolerance);
}

/// The choice of a tolerance, after the last trial.
template <class Real>
StepTolerance<Real> chosen(double tolerance, const DirectionalFlow<Real>& flow, Trial<Real> last) {
  StepTolerance<Real> choice;
  choice.tolerance = tolerance;
  for (std::size_t j = 0; j < last.finer_lines.size(); ++j) {
    choice.finer_lines.push_back({flow.direction(j), std::move(last.finer_lines[j])});
  }
  if (tolerance == last.tolerance) choice.lines = std::move(last.lines);
  return choice;
}

}  // namespace

template <class Real>
GaussSettings finer_gauss(const GaussSettings& settings, double tolerance) {
  GaussSettings fine;
  fine.stages = settings.stages < 8 ? 8 : (settings.stages == 14 ? 12 : 14);
  fine.tolerance = std::max(1e-3 * tolerance, smallest_step_tolerance<Real>());
  fine.compensated_summation = true;
  return fine;
}

template <class Real>
bool needs_choice(const FlowProblem<Real>& problem, const GaussSettings& settings) {
  const bool is_chosen_in_steps = !settings.tolerance || settings.controls_all_degrees;
  // For the nominal alone the step control suffices, unless the field has waves that are much
  // shorter than its main scale.
  const bool is_known =
      problem.space->order() == 0 && problem.system->waves_on_a_circle < least_short_waves;
  return !is_chosen_in_steps && !is_known && problem.duration != 0;
}

template <class Real>
StepTolerance<Real> choose_step_tolerance(const FlowProblem<Real>& problem,
                                          const GaussSettings& settings, std::size_t threads,
                                          const FirstTrial<Real>* first) {
  const double asked = settings.tolerance.value_or(0);
  if (!needs_choice(problem, settings)) return {asked, {}, {}, {}, {}};
  const double smallest = smallest_step_tolerance<Real>();
  const DirectionalFlow<Real> flow(problem, 2);
  Trial<Real> before = try_tolerance(flow, settings, asked, threads, first);
  if (!(before.largest_excess() > 1)) return chosen(asked, flow, std::move(before));
  double power = 1;
  double largest_reduction = 0.1;
  std::optional<Trial<Real>> before_stalls;
  int stalls = 0;
  for (int i = 1; i < most_trials; ++i) {
    const double excess = before.largest_excess();
    const double wanted = std::isfinite(excess) ? std::pow(aim / excess, 1 / power) : 0;
    const double next = std::max(
        std::clamp(wanted, stalls > 0 ? largest_reduction : least_reduction, largest_reduction) *
            before.tolerance,
        smallest);
    Trial<Real> trial = try_tolerance<Real>(flow, settings, next, threads, nullptr, &before);
    if (!(trial.largest_excess() > 1)) return chosen(next, flow, std::move(trial));
    const bool is_shorter = trial.steps > before.steps;
    // Steps that are this much shorter would reduce a truncation error by far more.
    const bool stalls_now = is_shorter && trial.largest_excess() > 0.5 * excess &&
                            trial.largest_error() <= largest_converging_error;
    stalls = stalls_now ? stalls + 1 : 0;
    if (stalls == 1) before_stalls = before;
    const bool is_last = i + 1 == most_trials || before.steps > most_steps_of_more_trials;
    if (stalls == stalls_of_rounding || next == smallest || (stalls > 0 && is_last)) {
      const double tolerance = where_rounding_begins(stalls > 0 ? *before_stalls : before, trial);
      std::vector<double> rounding = trial.error_by_degree;
      StepTolerance<Real> choice = chosen(tolerance, flow, std::move(trial));
      choice.rounding_by_degree = std::move(rounding);
      return choice;
    }
    power = is_shorter && !stalls_now ? convergence(before, trial) : 1;
    largest_reduction = is_shorter ? 0.1 : next_reduction;
    before = std::move(trial);
    if (is_last) break;
  }
  std::vector<double> unmet = before.error_by_degree;
  StepTolerance<Real> choice = chosen(before.tolerance, flow, std::move(before));
  choice.unmet_by_degree = std::move(unmet);
  return choice;
}

template <class Real>
std::optional<StepTolerance<Real>> accept_first_trial(const GaussSettings& settings,
                                                      const DirectionalFlow<Real>& flow,
                                                      std::vector<FlowJet<Real>> lines,
                                                      std::vector<FlowJet<Real>> finer_lines,
                                                      double periods) {
  Trial<Real> trial;
  trial.tolerance = *settings.tolerance;
  trial.lines = std::move(lines);
  trial.finer_lines = std::move(finer_lines);
  trial.periods = periods;
  judge(trial, flow, settings);
  if (trial.largest_excess() > 1) return std::nullopt;
  return chosen(trial.tolerance, flow, std::move(trial));
}

template <class Real>
void record_choice(StepTolerance<Real> choice, IntegrationStatistics& statistics) {
  if (choice.tolerance > 0) statistics.step_tolerance = choice.tolerance;
  statistics.rounding_by_degree = std::move(choice.rounding_by_degree);
  statistics.unmet_by_degree = std::move(choice.unmet_by_degree);
  if constexpr (std::is_same_v<Real, DoubleDouble>) {
    std::vector<JetAlongLine<Extended>> lines;
    for (const JetAlongLine<Real>& line : choice.finer_lines) {
      std::vector<Extended> direction;
      for (const Real& x : line.direction) direction.push_back(convert<Extended>(x));
      lines.push_back({std::move(direction), convert_map<Extended>(line.jet)});
    }
    statistics.finer_lines = std::move(lines);
  } else {
    statistics.finer_lines = std::move(choice.finer_lines);
  }
}

template <class Real>
FlowJet<Real> integrate_with_step_tolerance(const FlowProblem<Real>& problem,
                                            GaussSettings settings, double step_tolerance,
                                            IntegrationStatistics& statistics) {
  settings.tolerance = step_tolerance;
  settings.profile = nullptr;
  statistics = {};
  return run_gauss<Real>(problem, settings, statistics);
}

template bool needs_choice(const FlowProblem<InstantiatedReal>&, const GaussSettings&);
template StepTolerance<InstantiatedReal> choose_step_tolerance(const FlowProblem<InstantiatedReal>&,
                                                               const GaussSettings&, std::size_t,
                                                               const FirstTrial<InstantiatedReal>*);
template std::optional<StepTolerance<InstantiatedReal>> accept_first_trial(
    const GaussSettings&, const DirectionalFlow<InstantiatedReal>&,
    std::vector<FlowJet<InstantiatedReal>>, std::vector<FlowJet<InstantiatedReal>>, double);
template void record_choice(StepTolerance<InstantiatedReal>, IntegrationStatistics&);
template FlowJet<InstantiatedReal> integrate_with_step_tolerance(
    const FlowProblem<InstantiatedReal>&, GaussSettings, double, IntegrationStatistics&);
template GaussSettings finer_gauss<InstantiatedReal>(const GaussSettings&, double);

}  // namespace hamjet
