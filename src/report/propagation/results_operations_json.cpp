#include "results_operations_json.hpp"

#include <algorithm>

#include "../../dynamics/operation_count.hpp"
#include "../../studies/skipped_work.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

/// Self-checks that looked at something.
long checks_done(const RunResult& run) {
  return std::count_if(run.checks.begin(), run.checks.end(), [](const SelfCheck& check) {
    return check.state == SelfCheckState::passed || check.state == SelfCheckState::failed;
  });
}

}  // namespace

Json operations_json(const PropagationResult& result, const RunResult& run) {
  const OperationList& list = result.problem.system->evaluated_list();
  const int order = working_order(*result.problem.system, result.scene.order);
  const SpacePointer& whole = result.problem.space;
  const std::size_t less = variables_less(run.statistics.left_out);
  const SpacePointer integrated =
      less > 0 ? SeriesSpace::create(whole->variables() - less, whole->order()) : whole;
  return {{"operations_per_evaluation", list.operations().size() - list.inputs()},
          {"nonlinear_operations_per_evaluation", list.nonlinear_operations()},
          {"multiply_adds_per_evaluation", series_multiply_adds(list, *integrated, order)},
          {"evaluations", run.statistics.vector_field_evaluations},
          {"nominal_evaluations", run.statistics.nominal_evaluations},
          {"slice_products", run.statistics.series_work.slice_products},
          {"multiply_adds", run.statistics.series_work.multiply_adds},
          {"poisson_brackets", run.counts.poisson_brackets},
          {"inversions", run.counts.inversions},
          {"compositions", run.counts.compositions + (run.arcs ? run.arcs->compositions : 0)},
          {"exactness_residuals", run.counts.exactness_residuals},
          {"self_checks", checks_done(run)},
          {"points_watched_for_figure", run.along_time ? run.along_time->points.size() : 0}};
}

Json operations_json(const PropagationResult& result) {
  long evaluations = 0;
  long slice_products = 0;
  long self_checks = 0;
  bool has_figure = false;
  AnalysisCounts counts;
  for (const RunResult& run : result.runs) {
    evaluations += run.statistics.vector_field_evaluations;
    slice_products += run.statistics.series_work.slice_products;
    self_checks += checks_done(run);
    has_figure = has_figure || run.along_time;
    counts.poisson_brackets += run.counts.poisson_brackets;
    counts.inversions += run.counts.inversions;
    counts.compositions += run.counts.compositions + (run.arcs ? run.arcs->compositions : 0);
    counts.exactness_residuals += run.counts.exactness_residuals;
  }
  const bool has_reference = result.reference.has_value();
  return {{"runs", result.runs.size()},
          {"evaluations", evaluations},
          {"slice_products", slice_products},
          {"poisson_brackets", counts.poisson_brackets},
          {"inversions", counts.inversions},
          {"floor_inversions", result.floor_inversions},
          {"compositions", counts.compositions},
          {"exactness_residuals", counts.exactness_residuals},
          {"self_checks", self_checks},
          {"reference_runs", has_reference ? result.reference->runs : 0},
          {"reference_evaluations",
           has_reference ? result.reference->statistics.vector_field_evaluations : 0},
          {"relative_hamiltonians", result.relative_hamiltonians.size()},
          {"figures", has_figure ? 1 : 0}};
}

Json skipped_json(const PropagationResult& result) {
  Json json = Json::array();
  for (const SkippedWork& entry : skipped_work(result)) {
    json.push_back({{"what", entry.what}, {"why", entry.why}});
  }
  return json;
}

}  // namespace hamjet::io
