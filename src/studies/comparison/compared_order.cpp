#include "compared_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../../dynamics/operation_count.hpp"
#include "../along_time_recorder.hpp"
#include "../integration.hpp"
#include "../nominal/nominal_recorder.hpp"
#include "../reference.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Shorter integrations are repeated until a timing lasts this long.
constexpr double shortest_timing_s = 2e-3;
constexpr int most_repeats_in_timing = 20;

Scene at_order(Scene scene, int order, const std::optional<GeneratingFunctionKind>& kind) {
  scene.order = order;
  scene.integrators.clear();
  scene.kinds.reset();
  if (kind) scene.kinds = {kind->name()};
  return scene;
}

std::vector<Extended> state_of(const FlowJet<double>& jet) {
  std::vector<Extended> state;
  for (const auto& component : jet) state.emplace_back(component[0]);
  return state;
}

}  // namespace

ComparedOrder::ComparedOrder(Scene scene, int order, const ReferenceResult& reference,
                             const std::optional<GeneratingFunctionKind>& kind)
    : scene_(at_order(std::move(scene), order, kind)),
      problem_(make_problem(scene_)),
      reference_(truncated_reference(reference, problem_.space)),
      points_(scene_, problem_),
      analysis_(scene_, problem_, reference_),
      kind_(kind) {}

FlowJet<double> ComparedOrder::integrate(const Candidate& candidate,
                                         IntegrationStatistics& statistics,
                                         const StepObserver<double>& observer) const {
  const auto flow = flow_problem<double>(problem_, scene_.duration);
  if (candidate.integrate) return candidate.integrate(flow, statistics, observer);
  return hamjet::integrate<double>(flow, candidate.settings, statistics, observer);
}

ComparedRun ComparedOrder::judge(const Candidate& candidate, const std::string& series,
                                 const std::function<void(double)>& keep_going) {
  ComparedRun run;
  run.settings = candidate.settings;
  run.series = series;
  run.order = scene_.order;
  NominalRecorder recorder(problem_, scene_.nominal.size());
  const auto start = std::chrono::steady_clock::now();
  try {
    const auto jet =
        integrate(candidate, run.statistics, [&](const double& time, const FlowJet<double>& state) {
          recorder.record(time, state_of(state));
          const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
          keep_going(passed.count());
        });
    const auto estimate =
        estimate_jet_error<double>(scene_, flow_problem<double>(problem_, scene_.duration), jet,
                                   run.statistics, [&](double) { keep_going(0); });
    run.error_estimate_by_degree = estimate.by_degree.value_or(std::vector<double>());
    RunResult result;
    result.jet = convert_map<Extended>(jet);
    judge_jet(run, result);
    run.energy_error = recorder.largest_energy_error();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    run.failure = error.what();
  }
  return run;
}

void ComparedOrder::judge_jet(ComparedRun& run, RunResult& result) {
  analysis_.analyse(result);
  run.error_by_degree = *result.error_by_degree;
  run.error_at_formation_m = points_.position_error_m(result.jet, reference_->jet);
  run.symplecticity = result.symplecticity;
  if (!result.kinds.empty()) {
    run.exactness = result.kinds[0].by_degree;
    run.exactness_failure = result.kinds[0].failure;
  }
  const OperationList& list = problem_.system->evaluated_list();
  const int working = working_order(*problem_.system, scene_.order);
  run.multiply_adds = series_multiply_adds(list, *problem_.space, working) *
                      static_cast<double>(run.statistics.vector_field_evaluations);
  run.memory_bytes = integration_memory(
      run.settings, *problem_.system,
      SeriesSpace::monomial_count(problem_.variables.size(), working), sizeof(double));
  if (run.symplecticity.empty()) return;
  const bool is_exact = run.largest_symplecticity() <= largest_exact_defect;
  const bool is_accurate = run.error_at_formation_m <= scene_.comparison.wanted_error_m;
  run.corner = is_exact ? (is_accurate ? Corner::exact_and_accurate : Corner::exact_but_wrong)
                        : (is_accurate ? Corner::accurate_not_symplectic : Corner::neither);
}

void ComparedOrder::time(const Candidate& candidate, ComparedRun& run,
                         const std::function<void()>& keep_going) const {
  const double before = run.seconds.empty() ? run.statistics.wall_seconds : run.seconds.back();
  const int count = std::clamp(static_cast<int>(std::ceil(shortest_timing_s / before)), 1,
                               most_repeats_in_timing);
  double seconds = 0;
  for (int k = 0; k < count; ++k) {
    IntegrationStatistics statistics;
    integrate(candidate, statistics, [&](const double&, const FlowJet<double>&) { keep_going(); });
    seconds += statistics.wall_seconds;
  }
  run.seconds.push_back(seconds / count);
}

RunAlongTime ComparedOrder::watch(const IntegratorSettings& settings,
                                  const TimesWithoutKind& singular,
                                  const std::function<void(double)>& keep_going) const {
  NominalRecorder nominal(problem_, scene_.nominal.size());
  AlongTimeRecorder recorder(settings.label, scene_.duration, kind_, problem_);
  std::string failure;
  try {
    IntegrationStatistics statistics;
    integrate({settings}, statistics, [&](const double& time, const FlowJet<double>& jet) {
      keep_going(time / scene_.duration);
      nominal.record(time, state_of(jet));
      recorder.record(time, jet, nominal.last_energy_error());
    });
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    failure = error.what();
  }
  RunAlongTime result = recorder.take(singular);
  result.failure = std::move(failure);
  return result;
}

}  // namespace hamjet
