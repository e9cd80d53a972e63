#include "compared_order.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "hamjet/dynamics/operation_count.hpp"
#include "hamjet/error.hpp"
#include "integration.hpp"
#include "nominal_recorder.hpp"

namespace hamjet {
namespace {

/// Shorter integrations are repeated until a timing has lasted this long.
constexpr double shortest_timing_s = 2e-3;
constexpr int most_repeats_in_timing = 20;
/// Points along time of each integrator that is watched.
constexpr int watched_points = 400;

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

/// Constant and linear terms of a jet.
FlowJet<Extended> linear_jet(const FlowJet<double>& jet, const SpacePointer& linear_space) {
  FlowJet<Extended> result;
  for (const auto& component : jet) {
    result.emplace_back(linear_space);
    for (std::size_t k = 0; k < linear_space->size(); ++k) result.back()[k] = component[k];
  }
  return result;
}

const OperationList& evaluated_list(const DynamicalSystem& system) {
  return system.second_order ? system.second_order->force : system.vector_field;
}

}  // namespace

ReferenceResult truncated_reference(const ReferenceResult& reference, const SpacePointer& space) {
  ReferenceResult result = reference;
  result.jet.clear();
  for (const auto& component : reference.jet) {
    const auto first = component.coefficients().first(space->size());
    result.jet.emplace_back(space, std::vector<Extended>(first.begin(), first.end()));
  }
  result.uncertainty_by_degree.resize(static_cast<std::size_t>(space->order()) + 1);
  return result;
}

ComparedOrder::ComparedOrder(Scene scene, int order, const ReferenceResult& reference,
                             const std::optional<GeneratingFunctionKind>& kind)
    : scene_(at_order(std::move(scene), order, kind)),
      problem_(make_problem(scene_, available_memory())),
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
                                 const std::function<void(double, double)>& keep_going) {
  ComparedRun run;
  run.settings = candidate.settings;
  run.series = series;
  run.order = scene_.order;
  NominalRecorder recorder(problem_, scene_.nominal.size());
  recorder.record(0, problem_.nominal);
  const auto start = std::chrono::steady_clock::now();
  try {
    const auto jet =
        integrate(candidate, run.statistics, [&](const double& time, const FlowJet<double>& state) {
          recorder.record(time, state_of(state));
          const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
          keep_going(time / scene_.duration, passed.count());
        });
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
  const OperationList& list = evaluated_list(problem_.system);
  const int working = list.is_linear_system() ? std::min(scene_.order, 1) : scene_.order;
  run.multiply_adds = series_multiply_adds(list, *problem_.space, working) *
                      static_cast<double>(run.statistics.vector_field_evaluations);
  run.memory_bytes = integration_memory(
      run.settings, problem_.system,
      SeriesSpace::monomial_count(problem_.variables.size(), working), sizeof(double));
  if (run.symplecticity.empty()) return;
  const bool is_exact = run.largest_symplecticity() <= largest_exact_defect;
  const bool is_accurate = run.error_at_formation_m <= scene_.comparison.wanted_error_m;
  run.corner = is_exact ? (is_accurate ? Corner::exact_and_accurate : Corner::exact_but_wrong)
                        : (is_accurate ? Corner::accurate_not_symplectic : Corner::neither);
}

void ComparedOrder::time(const Candidate& candidate, ComparedRun& run,
                         const std::function<void(double)>& keep_going) const {
  const double before = run.seconds.empty() ? run.statistics.wall_seconds : run.seconds.back();
  const int count = std::clamp(static_cast<int>(std::ceil(shortest_timing_s / before)), 1,
                               most_repeats_in_timing);
  double seconds = 0;
  for (int k = 0; k < count; ++k) {
    IntegrationStatistics statistics;
    integrate(candidate, statistics, [&](const double& time, const FlowJet<double>&) {
      keep_going(time / scene_.duration);
    });
    seconds += statistics.wall_seconds;
  }
  run.seconds.push_back(seconds / count);
}

RunAlongTime ComparedOrder::watch(const IntegratorSettings& settings,
                                  const std::function<void(double)>& keep_going) const {
  RunAlongTime result;
  result.label = settings.label;
  NominalRecorder recorder(problem_, scene_.nominal.size());
  recorder.record(0, problem_.nominal);
  const auto linear_space = SeriesSpace::create(problem_.variables.size(), 1);
  double next = 0;
  double last_time = 0;
  double last_determinant = 0;
  const auto observe = [&](const double& time, const FlowJet<double>& jet) {
    keep_going(time / scene_.duration);
    recorder.record(time, state_of(jet));
    if (kind_) {
      const double now = inverted_block(std::span<const Series<double>>(jet), *kind_).determinant();
      if (now * last_determinant < 0) {
        const double fraction = last_determinant / (last_determinant - now);
        result.singular_times.push_back(last_time + fraction * (time - last_time));
      }
      last_determinant = now;
      last_time = time;
    }
    if (std::abs(time) < next && time != scene_.duration) return;
    next = std::abs(time) + std::abs(scene_.duration) / watched_points;
    RunAlongTime::Point point;
    point.time = time;
    point.energy_error = recorder.last_energy_error();
    if (kind_) {
      const auto linear = linear_jet(jet, linear_space);
      const std::span<const Series<Extended>> map(linear);
      point.condition = condition_number(inverted_block(map, *kind_));
      if (point.condition < largest_condition(std::numeric_limits<double>::epsilon())) {
        point.exactness =
            exactness_residual(one_form(invert_partially<Extended>(map, *kind_)))[0].scaled;
      }
    }
    result.points.push_back(point);
  };
  try {
    IntegrationStatistics statistics;
    integrate({settings}, statistics, observe);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    result.failure = error.what();
  }
  return result;
}

}  // namespace hamjet
