#pragma once

#include "../formation_scale.hpp"
#include "../map_analysis.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/studies/comparison.hpp"

namespace hamjet {

/// Integrates and judges candidates at one order of the jet.
class ComparedOrder {
 public:
  /// `reference` may have a higher order: its first coefficients are those of this order. `kind` is
  /// the kind whose exactness is reported.
  ComparedOrder(Scene scene, int order, const ReferenceResult& reference,
                const std::optional<GeneratingFunctionKind>& kind);
  ComparedOrder(const ComparedOrder&) = delete;
  ComparedOrder& operator=(const ComparedOrder&) = delete;

  const ComputedProblem& problem() const noexcept { return problem_; }
  const FormationPoints& points() const noexcept { return points_; }

  /// Integrates once and judges the jet. A numerical failure is recorded in the run. `keep_going`
  /// is called with the seconds of integration so far; it may throw.
  ComparedRun judge(const Candidate& candidate, const std::string& series,
                    const std::function<void(double)>& keep_going);

  /// Integrates once more and adds the timing to a finished run.
  void time(const Candidate& candidate, ComparedRun& run,
            const std::function<void()>& keep_going) const;

  /// Observes one of the scene's integrators along time.
  RunAlongTime watch(const IntegratorSettings& settings, const TimesWithoutKind& singular,
                     const std::function<void(double)>& keep_going) const;

 private:
  FlowJet<double> integrate(const Candidate& candidate, IntegrationStatistics& statistics,
                            const StepObserver<double>& observer) const;
  void judge_jet(ComparedRun& run, RunResult& result);

  Scene scene_;
  ComputedProblem problem_;
  std::optional<ReferenceResult> reference_;
  FormationPoints points_;
  MapAnalysis analysis_;
  std::optional<GeneratingFunctionKind> kind_;
};

}  // namespace hamjet
