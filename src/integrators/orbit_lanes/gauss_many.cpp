#include "hamjet/integrators/gauss_many.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "../concurrent_tasks.hpp"
#include "../directional_flow.hpp"
#include "../gauss/gauss_lanes.hpp"
#include "../gauss/gauss_tolerance.hpp"
#include "../integration_clock.hpp"
#include "lane_integrator.hpp"

namespace hamjet {
namespace {

/// The number of orbits of one task. It is large, so that lanes without an orbit at the end of a
/// task cost little.
constexpr std::size_t most_in_a_task = 256;

bool has_unit_mass(const DynamicalSystem& system) {
  if (!system.second_order) return true;
  const std::size_t n = system.degrees_of_freedom;
  for (std::size_t i = 0; i < n * n; ++i) {
    if (system.second_order->inverse_mass[i] != Extended(i % (n + 1) == 0 ? 1 : 0)) return false;
  }
  return true;
}

bool fits_lanes(const FlowProblem<double>& problem, const GaussSettings& settings) {
  return problem.space->order() <= highest_order_in_lanes && problem.duration != 0 &&
         has_unit_mass(*problem.system) && !settings.controls_all_degrees &&
         settings.profile == nullptr && settings.stages >= 2;
}

using Next = std::function<std::optional<LaneStart>()>;
using Done = std::function<void(LaneEnd)>;

/// Runs orbits in lanes. Loops over the three dimensions of space, or the two of a plane, are
/// unrolled.
void run_in_lanes(const FlowProblem<double>& problem, const GaussSettings& settings,
                  int controlled_order, const Next& next, const Done& done) {
  const auto run = [&]<int Components>(std::integral_constant<int, Components>) {
    LaneIntegrator<Components>(problem, settings, controlled_order).run(next, done);
  };
  switch (problem.system->evaluated_list().variables()) {
    case 2:
      return run(std::integral_constant<int, 2>{});
    case 3:
      return run(std::integral_constant<int, 3>{});
    default:
      return run(std::integral_constant<int, 0>{});
  }
}

/// The orbits of one task.
class Task {
 public:
  Task(const FlowProblem<double>& problem, const std::vector<std::vector<double>>& states,
       const GaussSettings& settings, std::size_t first, std::size_t last,
       std::vector<ManyFlowsOutcome>& outcomes)
      : problem_(problem),
        states_(states),
        settings_(settings),
        first_(first),
        last_(last),
        outcomes_(outcomes) {
    problem_.initial_jet.reset();
  }

  void run(const std::function<void()>& advance) {
    if (fits_lanes(problem_, settings_)) {
      run_jets(advance);
      if (needs_choice(problem_, settings_)) check(advance);
    }
    for (std::size_t i = first_; i < last_; ++i) {
      if (outcomes_[i].jet.empty() && !outcomes_[i].failure) run_alone(i);
      advance();
    }
  }

 private:
  FlowProblem<double> problem_of(std::size_t i) const {
    FlowProblem<double> problem = problem_;
    problem.initial_state = states_[i];
    return problem;
  }

  /// The jets, with the settings' own tolerance, of all orbits for which lanes suffice.
  void run_jets(const std::function<void()>& advance) {
    const IntegrationClock clock;
    std::size_t i = first_;
    const auto next = [&]() -> std::optional<LaneStart> {
      advance();
      while (i < last_ && !is_finite_state(states_[i])) ++i;
      if (i == last_) return std::nullopt;
      LaneStart start{i, starting_jet(problem_of(i)), settings_.tolerance.value_or(0)};
      ++i;
      return start;
    };
    run_in_lanes(problem_, settings_, working_order(problem_), next, [&](LaneEnd end) {
      if (!end.is_solved) return;
      outcomes_[end.orbit].jet = std::move(end.jet);
      outcomes_[end.orbit].statistics = std::move(end.statistics);
    });
    share(clock.seconds(), [](IntegrationStatistics& s, double x) { s.wall_seconds += x; });
  }

  /// The same check as in the first trial of choose_step_tolerance. Jets that do not pass are left
  /// to a run of their own, which tries other tolerances.
  void check(const std::function<void()>& advance) {
    const IntegrationClock clock;
    const double asked = *settings_.tolerance;
    GaussSettings finer = finer_gauss<double>(settings_, asked);
    const auto field = std::make_shared<FieldAtStates<double>>(*problem_.system);
    std::vector<std::unique_ptr<DirectionalFlow<double>>> flows(last_ - first_);
    std::size_t i = first_;
    std::optional<FlowProblem<double>> pattern;
    const auto start_of = [&](std::size_t orbit) {
      auto& flow = flows[orbit - first_];
      flow = std::make_unique<DirectionalFlow<double>>(problem_of(orbit), lines, field);
      return flow->problem();
    };
    const auto skip = [&] {
      while (i < last_ && outcomes_[i].jet.empty()) ++i;
    };
    skip();
    if (i == last_) return;
    pattern = start_of(i);
    const auto next = [&]() -> std::optional<LaneStart> {
      advance();
      skip();
      if (i == last_) return std::nullopt;
      LaneStart start{i, *start_of(i).initial_jet, *finer.tolerance};
      ++i;
      return start;
    };
    run_in_lanes(*pattern, finer, working_order(*pattern), next,
                 [&](LaneEnd end) { judge(std::move(end), *flows[end.orbit - first_]); });
    share(clock.seconds(), [](IntegrationStatistics& s, double x) {
      s.wall_seconds += x;
      s.choice_seconds += x;
    });
  }

  void judge(LaneEnd end, const DirectionalFlow<double>& flow) {
    ManyFlowsOutcome& outcome = outcomes_[end.orbit];
    std::optional<StepTolerance<double>> choice;
    if (end.is_solved) {
      choice = accept_first_trial(settings_, flow, flow.restrict(outcome.jet), flow.lines(end.jet),
                                  end.statistics.periods);
    }
    if (choice) {
      record_choice(std::move(*choice), outcome.statistics);
    } else {
      outcome = {};
    }
  }

  void run_alone(std::size_t i) {
    ManyFlowsOutcome& outcome = outcomes_[i];
    outcome.was_alone = true;
    try {
      outcome.jet = integrate_gauss<double>(problem_of(i), settings_, outcome.statistics);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::usage) throw;
      outcome.failure = error;
    }
  }

  static bool is_finite_state(const std::vector<double>& state) {
    return std::all_of(state.begin(), state.end(), [](double x) { return std::isfinite(x); });
  }

  /// Adds an equal share of the seconds to each orbit that has a jet.
  template <class Add>
  void share(double seconds, const Add& add) {
    const auto has_jet = [](const ManyFlowsOutcome& outcome) { return !outcome.jet.empty(); };
    const auto begin = outcomes_.begin() + static_cast<std::ptrdiff_t>(first_);
    const auto end = outcomes_.begin() + static_cast<std::ptrdiff_t>(last_);
    const auto count = static_cast<double>(std::count_if(begin, end, has_jet));
    for (auto o = begin; o != end; ++o) {
      if (has_jet(*o)) add(o->statistics, seconds / count);
    }
  }

  static constexpr std::size_t lines = 2;

  FlowProblem<double> problem_;
  const std::vector<std::vector<double>>& states_;
  const GaussSettings& settings_;
  std::size_t first_;
  std::size_t last_;
  std::vector<ManyFlowsOutcome>& outcomes_;
};

}  // namespace

std::vector<ManyFlowsOutcome> integrate_gauss_many(
    const FlowProblem<double>& problem, const std::vector<std::vector<double>>& initial_states,
    const GaussSettings& settings, const ManyFlowsSettings& many) {
  validate_gauss(settings);
  FlowProblem<double> pattern = problem;
  pattern.initial_jet.reset();
  pattern.initial_state.assign(problem.system->dimension(), 0);
  validate(pattern);
  for (std::size_t i = 0; i < initial_states.size(); ++i) {
    if (initial_states[i].size() == pattern.initial_state.size()) continue;
    throw Error(ErrorKind::usage,
                fmt::format("Gauss: initial state {} has {} numbers, must have {}", i,
                            initial_states[i].size(), pattern.initial_state.size()));
  }
  std::vector<ManyFlowsOutcome> outcomes(initial_states.size());
  const std::size_t threads = std::max<std::size_t>(many.threads, 1);
  const std::size_t each = std::clamp((outcomes.size() + threads - 1) / threads, orbit_lanes,
                                      std::max(orbit_lanes, most_in_a_task));
  const std::size_t tasks = (outcomes.size() + each - 1) / each;
  std::atomic<std::size_t> done = 0;
  run_concurrently(
      tasks, threads,
      [&](std::size_t t, TaskControl& control) {
        const std::size_t last = std::min(outcomes.size(), (t + 1) * each);
        Task(pattern, initial_states, settings, t * each, last, outcomes).run([&] {
          control.advance();
        });
        done += last - t * each;
      },
      [&](long) {
        if (many.progress) many.progress(done);
      });
  return outcomes;
}

}  // namespace hamjet
