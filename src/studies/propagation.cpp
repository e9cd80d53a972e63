#include "hamjet/studies/propagation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../dynamics/frozen_system.hpp"
#include "along_time_recorder.hpp"
#include "arcs.hpp"
#include "formation/charts/charted_jet.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "integration.hpp"
#include "map_analysis.hpp"
#include "nominal/followed_nominal.hpp"
#include "nominal/nominal_recorder.hpp"
#include "reference.hpp"

namespace hamjet {
namespace {

template <class Real>
void run_integrator(const Scene& scene, const ComputedProblem& problem, std::size_t threads,
                    const TimesWithoutKind& singular, RunResult& run,
                    const std::function<void(double)>& progress) {
  const bool finds_lowest_point =
      scene.checks[SelfCheckName::surface].is_on && scene.system.radius_km > 0;
  NominalRecorder recorder(problem, scene.nominal.size(), finds_lowest_point);
  std::optional<AlongTimeRecorder> along_time;
  if (scene.figure) {
    along_time.emplace(run.settings.label, scene.duration, figure_kind(scene, problem), problem);
  }
  FlowProblem<Real> flow = flow_problem<Real>(problem, scene.duration);
  flow.observes_constant_terms = !along_time;
  const auto record = [&](const Real& time, const FlowJet<Real>& state) {
    std::vector<Extended> point;
    for (const auto& component : state) point.push_back(convert<Extended>(component[0]));
    recorder.record(static_cast<double>(time), point);
    if (along_time) {
      along_time->record(static_cast<double>(time), state, recorder.last_energy_error());
    }
  };
  const bool records_step_error = scene.checks[SelfCheckName::step_error].is_on;
  const auto unsplit = reason_not_to_split(scene, run.settings);
  if (scene.arcs != std::optional<std::size_t>(1)) run.arcs.emplace();
  if (run.arcs && unsplit) run.arcs->plan.reason = *unsplit;
  const auto on_step = [&](const Real& time, const FlowJet<Real>& state) {
    record(time, state);
    progress(static_cast<double>(time) / scene.duration);
  };
  const FlowJet<Real> jet =
      !scene.jet_times.empty() ? integrate_with_times<Real>(scene, problem, flow, run, on_step,
                                                            records_step_error, progress)
      : run.arcs && !unsplit
          ? integrate_split<Real>(flow, run.settings, {scene.arcs, threads}, run.statistics,
                                  *run.arcs, record, progress, records_step_error)
          : integrate<Real>(flow, run.settings, run.statistics, on_step, records_step_error);
  run.jet = convert_map<Extended>(jet);
  if (has_time_shift(run.statistics.left_out)) {
    run.time_shift_difference = time_shift_difference<Real>(flow, jet, run);
  }
  if (scene.checks[SelfCheckName::error_estimate].is_on) {
    run.error_estimate = estimate_jet_error<Real>(scene, flow, jet, run.statistics, progress);
    sample_rounding_in_doubt<Real>(scene, flow, jet, run, progress);
  }
  run.nominal_final = full_state(run.jet, problem, scene.nominal.size());
  run.energy_error = recorder.largest_energy_error();
  run.energy = recorder.energy();
  run.lowest_point = recorder.lowest_point();
  run.nominal = recorder.take();
  if (along_time) run.along_time = along_time->take(singular);
}

/// Judges one check of the scene; a value that was not computed fails the check.
void check(RunResult& run, const char* key, std::optional<double> limit,
           std::optional<double> value) {
  if (!limit) return;
  if (!value) {
    run.failed_checks.push_back(
        fmt::format("{}: not computed, see the scene's [reference] table and "
                    "jet.variables",
                    key));
  } else if (!(*value <= *limit)) {
    run.failed_checks.push_back(fmt::format("{}: {:.3g} exceeds {:.3g}", key, *value, *limit));
  }
}

void check(RunResult& run, const std::optional<ReferenceResult>& reference) {
  std::optional<double> error;
  if (run.error_by_degree) {
    error = *std::max_element(run.error_by_degree->begin(), run.error_by_degree->end());
    // A measured error is not smaller than the smallest one that the reference can confirm.
    error = std::max(*error, reference->smallest_claimed_error());
  }
  std::optional<double> symplecticity;
  for (const auto& entry : run.symplecticity) {
    symplecticity = std::max(symplecticity.value_or(0), entry.scaled);
  }
  check(run, "require_relative_error", run.settings.require_relative_error, error);
  check(run, "require_symplecticity", run.settings.require_symplecticity, symplecticity);
}

void add_relative_hamiltonians(PropagationResult& result,
                               const std::function<void(double)>& progress) {
  const Scene& scene = result.scene;
  const ComputedProblem& problem = result.problem;
  const std::vector<double>& times = scene.relative_hamiltonian_times;
  follow_nominal(
      problem, times, scene.precision == Precision::extended ? 1e-28 : 1e-20,
      [&](std::size_t k, const std::vector<Extended>& state) {
        const SharedSystem then = frozen_at(problem.system, problem.start_time + times[k]);
        result.relative_hamiltonians.push_back(
            {times[k], relative_hamiltonian<Extended>(*then, state, scene.order)});
      },
      [&](double time) { progress(time / scene.duration); });
}

/// Does one part of the work for a scene; a numerical failure of this part does not stop the
/// others.
template <class Work>
void record_failure(std::string& failure, const char* part, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    failure = fmt::format("{}: {}", part, error.what());
  }
}

}  // namespace

std::optional<GeneratingFunctionKind> figure_kind(const Scene& scene,
                                                  const ComputedProblem& problem) {
  if (!scene.figure || scene.figure->kind.empty()) return std::nullopt;
  return parse_kind(scene.figure->kind, problem.degrees_of_freedom.size());
}

PropagationResult propagate(const Scene& scene, const ProgressCallback& progress,
                            std::size_t threads) {
  PropagationResult result;
  result.scene = scene;
  result.problem = make_problem(scene, threads);
  const auto report = [&](const std::string& task, double fraction) {
    if (progress) progress(task, fraction);
  };
  record_failure(result.relative_hamiltonian_failure, "relative Hamiltonian", [&] {
    add_relative_hamiltonians(result, [&](double done) { report("relative Hamiltonian", done); });
  });
  if (scene.reference) {
    record_failure(result.reference_failure, "reference", [&] {
      result.reference =
          compute_reference(result.problem, scene.duration, *scene.reference, scene.precision,
                            [&](double done) { report("reference", done); });
    });
  }
  TimesWithoutKind singular;
  if (const auto kind = figure_kind(scene, result.problem)) {
    singular = times_without_kind(result.problem, scene.duration, *kind,
                                  [&](double done) { report("singular times", done); });
  }
  MapAnalysis analysis(scene, result.problem, result.reference);
  for (const IntegratorSettings& settings : scene.integrators) {
    RunResult run;
    run.settings = settings;
    const auto on_step = [&](double done) { report(settings.label, done); };
    try {
      if (scene.precision == Precision::extended) {
        run_integrator<Extended>(scene, result.problem, threads, singular, run, on_step);
      } else {
        run_integrator<double>(scene, result.problem, threads, singular, run, on_step);
      }
      if (scene.coordinates != JetCoordinates::cartesian && !reason_without_charted_jet(scene)) {
        report(settings.label + ": coordinates", 1);
        run.charted = charted_jet(scene, run);
      }
      report(settings.label + ": inversion", 1);
      analysis.analyse(run);
      check(run, result.reference);
      run.checks = self_checks(scene, run);
      for (const SelfCheck& entry : run.checks) {
        if (entry.state != SelfCheckState::failed) continue;
        run.failed_checks.push_back(fmt::format("{}: {}", name_of(entry.name), entry.text));
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      run.failure = error.what();
    }
    result.runs.push_back(std::move(run));
  }
  result.floor_inversions = analysis.floor_inversions();
  return result;
}

std::vector<double> relative_error_by_degree(const FlowJet<Extended>& jet,
                                             const FlowJet<Extended>& reference) {
  const SeriesSpace& space = reference[0].space();
  std::vector<double> errors;
  for (int d = 0; d <= std::min(space.order(), jet[0].order()); ++d) {
    Extended difference = 0;
    Extended largest = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
        difference = std::max(difference, Extended(abs(jet[i][k] - reference[i][k])));
        largest = std::max(largest, Extended(abs(reference[i][k])));
      }
    }
    errors.push_back(
        static_cast<double>(largest > 0 ? Extended(difference / largest) : difference));
  }
  return errors;
}

int exit_code(const PropagationResult& result) {
  if (!result.reference_failure.empty() || !result.relative_hamiltonian_failure.empty()) {
    return static_cast<int>(ErrorKind::numerical);
  }
  int code = 0;
  for (const RunResult& run : result.runs) {
    if (!run.failure.empty()) return static_cast<int>(ErrorKind::numerical);
    if (run.charted && !run.charted->failure.empty()) {
      return static_cast<int>(ErrorKind::numerical);
    }
    for (const KindResult& kind : run.kinds) {
      if (!kind.failure.empty()) return static_cast<int>(ErrorKind::numerical);
    }
    if (!run.failed_checks.empty()) code = static_cast<int>(ErrorKind::check_failed);
  }
  return code;
}

}  // namespace hamjet
