#include "hamjet/integrators/arc_splitting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "../algebra/instantiated_real.hpp"
#include "arc_costs.hpp"
#include "arc_integrator.hpp"
#include "concurrent_tasks.hpp"
#include "cut_coordinates.hpp"
#include "directional_flow.hpp"
#include "gauss/gauss_lanes.hpp"
#include "gauss/gauss_tolerance.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "integration_clock.hpp"
#include "splitting_integration.hpp"
#include "symmetry/symmetry_reduction.hpp"

namespace hamjet {
namespace {

template <class Real>
std::unique_ptr<ArcIntegrator<Real>> make_arcs(const FlowProblem<Real>& problem,
                                               const SplittableMethod& method) {
  if (const auto* gauss = std::get_if<GaussSettings>(&method)) {
    validate_gauss(*gauss);
    return make_gauss_arcs<Real>(problem, *gauss);
  }
  if (const auto* stormer = std::get_if<StormerSettings>(&method)) {
    return make_splitting_arcs(problem, splitting_of<Real>(*stormer));
  }
  if (const auto* verlet = std::get_if<VelocityVerletSettings>(&method)) {
    return make_splitting_arcs(problem, splitting_of<Real>(*verlet));
  }
  return make_splitting_arcs(problem,
                             splitting_of<Real>(std::get<SymmetricCompositionSettings>(method)));
}

/// Integrates a problem unsplit, with the steps that the method's settings give.
template <class Real>
FlowJet<Real> integrate_unsplit(const FlowProblem<Real>& problem, const SplittableMethod& method) {
  IntegrationStatistics statistics;
  if (const auto* gauss = std::get_if<GaussSettings>(&method)) {
    return run_gauss<Real>(problem, *gauss, statistics);
  }
  if (const auto* stormer = std::get_if<StormerSettings>(&method)) {
    return integrate_stormer<Real>(problem, *stormer, statistics);
  }
  if (const auto* verlet = std::get_if<VelocityVerletSettings>(&method)) {
    return integrate_velocity_verlet<Real>(problem, *verlet, statistics);
  }
  return integrate_symmetric_composition<Real>(
      problem, std::get<SymmetricCompositionSettings>(method), statistics);
}

/// A method with its local tolerance chosen, if it has one.
template <class Real>
SplittableMethod with_step_tolerance(const FlowProblem<Real>& problem, SplittableMethod method,
                                     std::size_t threads, StepTolerance<Real>& choice) {
  if (auto* gauss = std::get_if<GaussSettings>(&method)) {
    validate_gauss(*gauss);
    if (gauss->tolerance) {
      choice = choose_step_tolerance(problem, *gauss, threads);
      gauss->tolerance = choice.tolerance;
    }
  }
  return method;
}

/// One split integration.
template <class Real>
class ArcSplitting {
 public:
  ArcSplitting(const FlowProblem<Real>& problem, const SplittableMethod& method,
               const StepTolerance<Real>& choice, ArcIntegrator<Real>& arcs,
               const ArcSettings& settings, IntegrationStatistics& statistics,
               ArcStatistics& arc_statistics, const ArcProgress& progress)
      : problem_(problem),
        method_(method),
        choice_(choice),
        arcs_(arcs),
        settings_(settings),
        statistics_(statistics),
        arc_statistics_(arc_statistics),
        progress_(progress) {}

  FlowJet<Real> run(const StepObserver<Real>& observer) {
    const FlowJet<Real> nominal = run_nominal(observer);
    arc_statistics_.plan = plan_for(problem_, arcs_, settings_.arcs, statistics_.steps);
    choose_cuts();
    FlowJet<Real> jet = compose_all(run_arcs());
    for (std::size_t i = 0; i < jet.size(); ++i) jet[i][0] = nominal[i][0];
    if (arc_statistics_.plan.arcs > 1) {
      const std::string loss = lost_digits(jet);
      if (!loss.empty()) jet = stay_unsplit(loss, nominal);
    }
    require_finite(jet, problem_.duration, "composition of arcs");
    statistics_.wall_seconds += arc_statistics_.arcs_seconds + arc_statistics_.composition_seconds;
    return jet;
  }

 private:
  /// The nominal's share in the reported progress; it takes a few hundredths of the time.
  static constexpr double nominal_share = 0.05;

  void report(double fraction) const {
    if (progress_) progress_(std::min(fraction, 1.0));
  }

  /// The error of a composed jet may exceed that of the unsplit one by at most this factor.
  static constexpr double allowed_loss = 10;

  /// A message where the composed jet has lost digits, otherwise an empty text. Along two lines, on
  /// which the unsplit flow is cheap, both jets are compared with a finer integration at every
  /// degree.
  std::string lost_digits(const FlowJet<Real>& jet) const {
    const DirectionalFlow<Real> flow(problem_, 2);
    const GaussSettings* gauss = std::get_if<GaussSettings>(&method_);
    const double rounding = static_cast<double>(std::numeric_limits<Real>::epsilon());
    typename DirectionalFlow<Real>::Lines unsplit = choice_.lines;
    typename DirectionalFlow<Real>::Lines exact;
    if (!unsplit.empty()) {
      // The choice of the tolerance has already integrated the same lines with the same steps.
      for (const JetAlongLine<Real>& line : choice_.finer_lines) exact.push_back(line.jet);
    } else {
      const GaussSettings finer = finer_gauss<Real>(
          gauss != nullptr ? *gauss : GaussSettings{},
          gauss != nullptr && gauss->tolerance ? *gauss->tolerance : 100 * rounding);
      unsplit = flow.integrate(
          [&](const FlowProblem<Real>& line) { return integrate_unsplit(line, method_); });
      exact = flow.integrate(
          [&](const FlowProblem<Real>& line) { return integrate_unsplit<Real>(line, finer); });
    }
    const std::vector<double> own = flow.relative_difference(unsplit, exact);
    const std::vector<double> composed = flow.relative_difference(flow.restrict(jet), exact);
    // A full jet has more rounding than a line; up to the tolerance this is no loss.
    const double unit = gauss != nullptr && gauss->tolerance ? *gauss->tolerance : 8 * rounding;
    const double unseen = std::max(unit, 8 * rounding) * std::max(1.0, statistics_.periods);
    for (std::size_t d = 1; d < own.size(); ++d) {
      if (composed[d] <= allowed_loss * std::max(own[d], unseen)) continue;
      return fmt::format(
          "the composition of {} arcs would be wrong by {:.1g} at degree {}, where "
          "the unsplit run is wrong by {:.1g}",
          arc_statistics_.plan.arcs, composed[d], d, own[d]);
    }
    return {};
  }

  /// Refuses a requested number of arcs; if the number is free, integrates in one arc.
  FlowJet<Real> stay_unsplit(const std::string& loss, const FlowJet<Real>& nominal) {
    if (settings_.arcs) {
      throw Error(ErrorKind::numerical,
                  fmt::format("arcs: {}; one arc, or auto, keeps all digits", loss));
    }
    const IntegrationClock clock;
    IntegrationStatistics whole;
    FlowJet<Real> jet = run_whole(whole, [] {});
    for (std::size_t i = 0; i < jet.size(); ++i) jet[i][0] = nominal[i][0];
    statistics_.vector_field_evaluations += whole.vector_field_evaluations;
    statistics_.nominal_evaluations += whole.nominal_evaluations;
    statistics_.series_work += whole.series_work;
    arc_statistics_.plan.arcs = 1;
    arc_statistics_.plan.speed_ups = {1, 1, 1};
    arc_statistics_.plan.reason = loss;
    arc_statistics_.arcs_seconds += clock.seconds();
    return jet;
  }

  FlowJet<Real> run_nominal(const StepObserver<Real>& observer) {
    FlowJet<Real> end =
        arcs_.run_nominal(statistics_, [&](const Real& time, const FlowJet<Real>& state) {
          if (observer) observer(time, state);
          report(nominal_share * static_cast<double>(Real(time / problem_.duration)));
        });
    arc_statistics_.nominal_seconds = statistics_.wall_seconds;
    // An explicit method counts evaluations as if they were on series; here they were on plain
    // numbers.
    if (statistics_.nominal_evaluations == 0) {
      statistics_.nominal_evaluations = statistics_.vector_field_evaluations;
    }
    statistics_.vector_field_evaluations = 0;  // no evaluations on series so far
    statistics_.series_work = {};
    return end;
  }

  /// Chooses the checkpoints at which the arcs start, so that the arcs have nearly equal numbers of
  /// steps.
  void choose_cuts() {
    std::size_t place = 0;
    const std::size_t count = arc_statistics_.plan.arcs;
    for (std::size_t k = 0; k < count; ++k) {
      const long wanted =
          static_cast<long>(static_cast<double>(statistics_.steps) * static_cast<double>(k) /
                                static_cast<double>(count) +
                            0.5);
      while (place + 1 < arcs_.checkpoints() && arcs_.step(place + 1) <= wanted) ++place;
      cuts_.push_back(place);
    }
    cuts_.erase(std::unique(cuts_.begin(), cuts_.end()), cuts_.end());
    arc_statistics_.plan.arcs = cuts_.size();
  }

  /// A single arc, in which symmetries are left out where possible.
  FlowJet<Real> run_whole(IntegrationStatistics& whole, const std::function<void()>& after_step) {
    const auto reduction = SymmetryReduction<Real>::of(problem_);
    if (!reduction) {
      return arcs_.run_arc(0, statistics_.steps, problem_.space, problem_.variables,
                           starting_jet(problem_), whole, after_step);
    }
    const FlowProblem<Real>& reduced = reduction->problem();
    statistics_.left_out = reduction->left_out();
    return reduction->expand(arcs_.run_arc(0, statistics_.steps, reduced.space, reduced.variables,
                                           *reduced.initial_jet, whole, after_step));
  }

  std::vector<FlowJet<Real>> run_arcs() {
    const std::size_t count = cuts_.size();
    std::vector<FlowJet<Real>> jets(count);
    std::vector<IntegrationStatistics> each(count);
    coordinates_.resize(count);
    const SpacePointer space = arc_space(problem_);
    std::vector<std::size_t> all(problem_.system->dimension());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const IntegrationClock clock;
    arc_statistics_.threads = run_concurrently(
        count, settings_.threads,
        [&](std::size_t k, TaskControl& control) {
          const long last = k + 1 < count ? arcs_.step(cuts_[k + 1]) : statistics_.steps;
          const auto after_step = [&] { control.advance(); };
          if (count == 1) {
            jets[k] = run_whole(each[k], after_step);
            return;
          }
          if (k == 0) {
            jets[k] = arcs_.run_arc(cuts_[k], last, problem_.space, problem_.variables,
                                    starting_jet(problem_), each[k], after_step);
            return;
          }
          coordinates_[k] = std::make_unique<CutCoordinates<Real>>(
              *problem_.system, arcs_.state(cuts_[k]), problem_.start_time + arcs_.time(cuts_[k]),
              space);
          jets[k] = arcs_.run_arc(cuts_[k], last, space, all, coordinates_[k]->start(), each[k],
                                  after_step);
        },
        [&](long done) {
          report(nominal_share + (1 - nominal_share) * static_cast<double>(done) /
                                     static_cast<double>(statistics_.steps));
        });
    arc_statistics_.arcs_seconds = clock.seconds();
    for (const IntegrationStatistics& arc : each) {
      statistics_.vector_field_evaluations += arc.vector_field_evaluations;
      statistics_.nominal_evaluations += arc.nominal_evaluations;
      statistics_.series_work += arc.series_work;
    }
    return jets;
  }

  /// Composes neighbouring maps in pairs, then pairs of the results, and so on.
  FlowJet<Real> compose_all(std::vector<FlowJet<Real>> maps) {
    const IntegrationClock clock;
    std::vector<std::size_t> starts(maps.size());  // the first arc of each map
    std::iota(starts.begin(), starts.end(), std::size_t{0});
    while (maps.size() > 1) {
      std::vector<FlowJet<Real>> composed((maps.size() + 1) / 2);
      std::vector<std::size_t> composed_starts;
      for (std::size_t i = 0; i < maps.size(); i += 2) composed_starts.push_back(starts[i]);
      const std::size_t pairs = maps.size() / 2;
      run_concurrently(
          pairs, settings_.threads,
          [&](std::size_t i, TaskControl& control) {
            control.advance();
            const auto& coordinates = *coordinates_[starts[2 * i + 1]];
            const std::vector<Series<Real>> inner = coordinates.of(maps[2 * i]);
            composed[i] = compose(maps[2 * i + 1], inner);
          },
          [&](long) { report(1); });
      if (maps.size() % 2 != 0) composed.back() = std::move(maps.back());
      arc_statistics_.compositions += static_cast<long>(pairs);
      maps = std::move(composed);
      starts = std::move(composed_starts);
    }
    arc_statistics_.composition_multiply_adds =
        static_cast<double>(arc_statistics_.compositions) * composition_cost(problem_);
    arc_statistics_.composition_seconds = clock.seconds();
    return std::move(maps[0]);
  }

  const FlowProblem<Real>& problem_;
  const SplittableMethod& method_;
  const StepTolerance<Real>& choice_;  ///< tolerance of the method
  ArcIntegrator<Real>& arcs_;
  const ArcSettings& settings_;
  IntegrationStatistics& statistics_;
  ArcStatistics& arc_statistics_;
  const ArcProgress& progress_;
  std::vector<std::size_t> cuts_;  ///< checkpoints; the first one is at the start
  /// Coordinates of each arc except the first.
  std::vector<std::unique_ptr<CutCoordinates<Real>>> coordinates_;
};

void validate_arcs(const std::optional<std::size_t>& arcs, std::size_t threads) {
  if (arcs.value_or(1) < 1) throw Error(ErrorKind::usage, "arcs: at least one is needed");
  if (threads < 1) throw Error(ErrorKind::usage, "arcs: at least one thread is needed");
}

}  // namespace

template <class Real>
FlowJet<Real> integrate_in_arcs(const FlowProblem<Real>& problem, const SplittableMethod& method,
                                const ArcSettings& settings, IntegrationStatistics& statistics,
                                ArcStatistics& arc_statistics, const StepObserver<Real>& observer,
                                const ArcProgress& progress) {
  validate(problem);
  validate_arcs(settings.arcs, settings.threads);
  statistics = {};
  arc_statistics = {};
  if (problem.duration == 0) {
    make_arcs(problem, method);  // throws if settings are out of range
    arc_statistics.plan.reason = "the duration is zero";
    return starting_jet(problem);
  }
  StepTolerance<Real> choice;
  const IntegrationClock clock;
  const SplittableMethod used = with_step_tolerance(problem, method, settings.threads, choice);
  const double choice_seconds = clock.seconds();
  const auto arcs = make_arcs(problem, used);
  FlowJet<Real> jet = ArcSplitting<Real>(problem, used, choice, *arcs, settings, statistics,
                                         arc_statistics, progress)
                          .run(observer);
  statistics.choice_seconds = choice_seconds;
  statistics.wall_seconds += choice_seconds;
  record_choice(std::move(choice), statistics);
  return jet;
}

template <class Real>
ArcPlan plan_arcs(const FlowProblem<Real>& problem, const SplittableMethod& method,
                  const std::optional<std::size_t>& asked, const ArcProgress& progress) {
  validate(problem);
  validate_arcs(asked, 1);
  StepTolerance<Real> choice;
  const auto arcs = make_arcs(problem, with_step_tolerance(problem, method, 1, choice));
  IntegrationStatistics statistics;
  if (problem.duration != 0) {
    arcs->run_nominal(statistics, [&](const Real& time, const FlowJet<Real>&) {
      if (progress) progress(static_cast<double>(Real(time / problem.duration)));
    });
  }
  return plan_for(problem, *arcs, asked, statistics.steps);
}

template FlowJet<InstantiatedReal> integrate_in_arcs(const FlowProblem<InstantiatedReal>&,
                                                     const SplittableMethod&, const ArcSettings&,
                                                     IntegrationStatistics&, ArcStatistics&,
                                                     const StepObserver<InstantiatedReal>&,
                                                     const ArcProgress&);
template ArcPlan plan_arcs(const FlowProblem<InstantiatedReal>&, const SplittableMethod&,
                           const std::optional<std::size_t>&, const ArcProgress&);

}  // namespace hamjet
