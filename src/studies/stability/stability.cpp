#include "stability.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../stopwatch.hpp"
#include "flow_box_cases.hpp"
#include "growth_curves.hpp"
#include "hamjet/studies/propagation.hpp"
#include "stability_errors.hpp"

namespace hamjet {
namespace {

/// Carries the exception of the caller's progress function past the error handling of the case.
struct Stopped {
  std::exception_ptr cause;
};

/// The finding about a case, before it is compared with the expectation.
struct Finding {
  CaseOutcome outcome = CaseOutcome::wrong;
  int exit_code = 0;
  std::string text;
  std::vector<std::string> failed_checks = {};  ///< each as "name: what failed"
};

Finding refusal(const Error& error) {
  return {CaseOutcome::refused, error.exit_code(), error.what()};
}

/// The first error that a run recorded.
std::optional<Error> recorded_error(const RunResult& run) {
  if (!run.failure.empty()) return Error(ErrorKind::numerical, run.failure);
  for (const KindResult& kind : run.kinds) {
    if (!kind.failure.empty()) return Error(ErrorKind::numerical, kind.failure);
  }
  return std::nullopt;
}

void describe_run(const RunResult& run, StabilityResult& result) {
  if (!run.failure.empty()) return;
  result.steps = run.statistics.steps;
  result.energy_error = run.energy_error;
  for (const SymplecticityDefect& defect : run.symplecticity) {
    result.symplecticity = std::max(result.symplecticity.value_or(0), defect.scaled);
  }
  for (const KindResult& kind : run.kinds) {
    for (const ExactnessEntry& entry : kind.by_degree) {
      result.exactness = std::max(result.exactness.value_or(0), entry.residual.scaled);
    }
  }
  if (!run.kinds.empty()) result.condition = run.kinds.front().condition;
}

/// The first measured error or curve that exceeds its limit, in words.
std::string first_excess(const StabilityResult& result) {
  if (result.error && !(result.error->ratio() <= 1)) {
    return fmt::format("{}: error {:.3g} exceeds {:.3g} (tolerance {:.3g} + {:g} x floor {:.3g})",
                       result.error->quantity, result.error->error, result.error->allowed(),
                       result.error->tolerance, rounding_factor, result.error->floor);
  }
  for (const GrowthCurve& curve : result.growth) {
    if (curve.is_as_expected) continue;
    return fmt::format("{} grows as time to the power {}, expected {}{:g}", curve.quantity,
                       curve.exponent ? fmt::format("{:.2f}", *curve.exponent) : "(not fitted)",
                       curve.is_upper_bound ? "at most " : "", curve.expected);
  }
  return "";
}

/// Runs all parts that can be run and fills in the measurements.
Finding investigate(const StabilityCase& subject, const ProgressCallback& progress,
                    StabilityResult& result) {
  if (const Error* error = std::get_if<Error>(&subject.scene)) return refusal(*error);
  if (const FlowBoxCase* box = std::get_if<FlowBoxCase>(&subject.scene)) {
    result.error = flow_box_error(*box);
    result.measured = {*result.error};
    const std::string excess = first_excess(result);
    return {excess.empty() ? CaseOutcome::right : CaseOutcome::wrong, 0, excess};
  }
  const Scene& scene = std::get<Scene>(subject.scene);
  if (scene.integrators.size() != 1) {
    return {CaseOutcome::wrong, 0, "a case has one [[integrator]]"};
  }
  const PropagationResult propagation = propagate(scene, progress);
  const RunResult& run = propagation.runs.front();
  describe_run(run, result);
  if (const auto error = recorded_error(run)) return refusal(*error);
  result.measured = measure_errors(subject.expected, propagation, progress);
  const auto worst =
      std::max_element(result.measured.begin(), result.measured.end(),
                       [](const auto& a, const auto& b) { return a.ratio() < b.ratio(); });
  if (worst != result.measured.end()) result.error = *worst;
  if (subject.expected.growth) {
    result.growth = growth_curves(scene, propagation.problem, *subject.expected.growth,
                                  [&](double done) { progress("growth", done); });
  }
  // A mark does not excuse an error in a number for which the case has a reference.
  const std::string excess = first_excess(result);
  if (!excess.empty()) return {CaseOutcome::wrong, 0, excess};
  if (!run.failed_checks.empty()) {
    return {CaseOutcome::marked, 1, fmt::format("{}", fmt::join(run.failed_checks, "; ")),
            run.failed_checks};
  }
  if (result.measured.empty() && result.growth.empty()) {
    return {CaseOutcome::wrong, 0, "nothing was compared: a result without a warning"};
  }
  return {CaseOutcome::right, 0, ""};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// What is wrong with a finding; empty if nothing is.
std::string objection(const StabilityExpectation& expected, const Finding& finding) {
  if (finding.outcome == CaseOutcome::wrong) return finding.text;
  if (finding.outcome != expected.outcome) {
    return fmt::format("{} where {} is expected{}{}", outcome_name(finding.outcome),
                       outcome_name(expected.outcome), finding.text.empty() ? "" : ": ",
                       finding.text);
  }
  if (finding.outcome == CaseOutcome::refused && finding.exit_code != expected.exit_code) {
    return fmt::format("exit code {}, must be {}: {}", finding.exit_code, expected.exit_code,
                       finding.text);
  }
  if (finding.outcome == CaseOutcome::refused && !contains(finding.text, expected.message)) {
    return fmt::format("the error does not say \"{}\": {}", expected.message, finding.text);
  }
  const auto is_mark = [&](const std::string& check) {
    return check.starts_with(expected.mark + ":");
  };
  if (finding.outcome == CaseOutcome::marked &&
      std::none_of(finding.failed_checks.begin(), finding.failed_checks.end(), is_mark)) {
    return fmt::format("not marked by the check {}: {}", expected.mark, finding.text);
  }
  return "";
}

}  // namespace

const char* outcome_name(CaseOutcome outcome) {
  constexpr const char* names[] = {"right", "refused", "marked", "wrong"};
  return names[static_cast<std::size_t>(outcome)];
}

StabilityResult run_stability_case(const StabilityCase& subject, const ProgressCallback& progress) {
  StabilityResult result;
  result.subject = &subject;
  const ProgressCallback report = [&](const std::string& task, double fraction) {
    if (!progress) return;
    try {
      progress(task, fraction);
    } catch (...) {
      throw Stopped{std::current_exception()};
    }
  };
  Finding finding;
  {
    const Stopwatch watch(result.seconds);
    try {
      finding = investigate(subject, report, result);
    } catch (const Stopped& stopped) {
      std::rethrow_exception(stopped.cause);
    } catch (const Error& error) {
      finding = refusal(error);
    }
  }
  const std::string problem = objection(subject.expected, finding);
  result.outcome = problem.empty() ? finding.outcome : CaseOutcome::wrong;
  result.text = problem.empty() ? finding.text : problem;
  return result;
}

}  // namespace hamjet
