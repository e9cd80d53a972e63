#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "../compensated_addition.hpp"
#include "../gauss/gauss_tableau.hpp"
#include "../step_ends.hpp"
#include "../step_sequence.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "lane_jets.hpp"
#include "lane_stages.hpp"
#include "lane_step_control.hpp"
#include "orbits.hpp"

namespace hamjet {

/// The start of an orbit: its number, its jet, and the tolerance of its steps.
struct LaneStart {
  std::size_t orbit = 0;
  FlowJet<double> jet;
  double tolerance = 0;
};

/// The outcome of an orbit in a lane.
struct LaneEnd {
  std::size_t orbit = 0;
  bool is_solved = false;  ///< if false, the orbit needs a method that lanes do not have
  FlowJet<double> jet;
  IntegrationStatistics statistics;
};

/// A Gauss integration of orbits side by side over one duration, each in a lane with steps of its
/// own, which are chosen as GaussIntegrator chooses them. A lane whose orbit has ended takes the
/// next orbit, so that orbits of few steps do not wait for those of many. To the last bit, the
/// result of an orbit does not depend on the others.
template <int Components>
class LaneIntegrator {
 public:
  using Next = std::function<std::optional<LaneStart>()>;
  using Done = std::function<void(LaneEnd)>;

  LaneIntegrator(const FlowProblem<double>& problem, const GaussSettings& settings,
                 int controlled_order)
      : start_time_(problem.start_time.in<double>()),
        duration_(problem.duration),
        ends_(problem),
        settings_(settings),
        order_(working_order(problem)),
        stages_(*problem.system, gauss_tableau(static_cast<std::size_t>(settings.stages)),
                std::max(order_, 1)),
        jets_(stages_, problem.system->dimension(), problem.space, order_,
              settings.compensated_summation),
        control_(*problem.system, stages_, controlled_order),
        start_slopes_(stages_.components()) {}

  /// Integrates orbits until `next` has no more.
  void run(const Next& next, const Done& done) {
    while (fill(next)) {
      step();
      for (std::size_t k = 0; k < orbit_lanes; ++k) {
        Lane& lane = lanes_[k];
        if (!lane.is_live) continue;
        if (lane.has_failed || lane.time == duration_) {
          done(end(k));
          lane.is_live = false;
        }
      }
    }
  }

 private:
  /// The origin of the guess for the slopes of the next step.
  enum class Guess { none, last_step, repeated_step };

  struct Lane {
    bool is_live = false;
    bool has_failed = false;
    std::size_t orbit = 0;
    double tolerance = 0;
    double time = 0;
    double lost_time = 0;  ///< see add_compensated
    double proposed = 0;
    double wanted = 0;  ///< the step that was to be tried, before an end cut it
    double step = 0;    ///< the step that is being tried
    double guessed_from = 0;
    Guess guess = Guess::none;
    long remaining_steps = 0;  ///< for fixed steps
    IntegrationStatistics statistics;
  };

  auto state() const {
    return [this](std::size_t c) -> const Orbits& { return jets_.state(c); };
  }

  /// The present times of the system's clock in the lanes.
  Orbits now() const {
    EachOrbit times{};
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      times[k] = start_time_ + (lanes_[k].time - lanes_[k].lost_time);
    }
    return together(times);
  }

  /// Gives orbits to the lanes that have none; returns false if no lane has an orbit.
  bool fill(const Next& next) {
    EachOrbit is_new{};
    bool is_any_new = false;
    bool is_any_live = false;
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      if (!lanes_[k].is_live && !is_exhausted_) {
        if (const auto start = next()) {
          lanes_[k] = {};
          lanes_[k].is_live = true;
          lanes_[k].orbit = start->orbit;
          lanes_[k].tolerance = start->tolerance;
          jets_.start(k, start->jet);
          is_new[k] = 1;
          is_any_new = true;
        } else {
          is_exhausted_ = true;
        }
      }
      is_any_live = is_any_live || lanes_[k].is_live;
    }
    if (is_any_new) {
      stages_.field().evaluate_at(now(), state(), start_slopes_);
      const EachOrbit norms = apart(stages_.field().gradient_norm(control_.units()));
      for (std::size_t k = 0; k < orbit_lanes; ++k) {
        if (is_new[k] != 0) propose_first_step(lanes_[k], norms[k]);
      }
    }
    return is_any_live;
  }

  void propose_first_step(Lane& lane, double norm) {
    if (settings_.step) {
      lane.remaining_steps = equal_step_count(duration_, *settings_.step, "Gauss");
      lane.proposed = duration_ / static_cast<double>(lane.remaining_steps);
    } else {
      lane.proposed = control_.rule().first_step(norm, lane.tolerance, duration_);
    }
  }

  /// One step of every lane. Refused steps are tried again together with the next steps of the
  /// others.
  void step() {
    choose_steps();
    guess_slopes();
    EachOrbit evaluations{};
    EachOrbit live{};
    for (std::size_t k = 0; k < orbit_lanes; ++k) live[k] = is_at_work(k) ? 1 : 0;
    const EachOrbit solved = apart(stages_.solve(state(), together(live), evaluations));
    control_.look(state(), start_slopes_);
    EachOrbit taken{};
    EachOrbit errors{};
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      if (live[k] == 0) continue;
      lanes_[k].statistics.nominal_evaluations += static_cast<long>(evaluations[k]);
      const bool is_sound = solved[k] != 0 && !control_.is_suspicious(k);
      errors[k] = is_sound ? control_.error_estimate(k, lanes_[k].step)
                           : std::numeric_limits<double>::infinity();
      taken[k] = is_sound && (settings_.step || errors[k] <= most_excess * lanes_[k].tolerance);
    }
    if (order_ >= 1 && std::any_of(taken.begin(), taken.end(), [](double x) { return x != 0; })) {
      const EachOrbit growth = apart(jets_.take_equations(stages_, control_.entry_weights()));
      for (std::size_t k = 0; k < orbit_lanes; ++k) {
        if (!(growth[k] <= LaneJets<Components>::most_growth)) {
          taken[k] = 0;
          errors[k] = std::numeric_limits<double>::infinity();
        }
      }
    }
    const EachOrbit unsolved = apart(jets_.advance(stages_, together(taken)));
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      if (live[k] == 0) continue;
      if (taken[k] == 0) {
        refuse(lanes_[k], solved[k] != 0, errors[k]);
      } else {
        accept(k, errors[k]);
      }
    }
    stages_.field().evaluate_at(now(), state(), start_slopes_);
    const EachOrbit finite = apart(check_finite());
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      const bool is_bad = finite[k] != 0 || unsolved[k] != 0;
      if (taken[k] != 0 && is_bad) lanes_[k].has_failed = true;
    }
  }

  /// A step is repeated if its error estimate exceeds the tolerance by more than this factor.
  static constexpr double most_excess = 10;
  bool is_at_work(std::size_t k) const { return lanes_[k].is_live && !lanes_[k].has_failed; }

  void choose_steps() {
    const EachOrbit longest = control_.longest_sampling_steps(state());
    EachOrbit steps{};
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      Lane& lane = lanes_[k];
      if (!is_at_work(k)) continue;
      double h = lane.proposed;
      if (!settings_.step) {
        if (std::abs(h) > longest[k]) h = std::copysign(longest[k], h);
        lane.wanted = h;
        h = fit_to_span(h, (ends_.after(lane.time) - lane.time) + lane.lost_time);
      }
      // A collision or another singularity lies ahead.
      if (lane.time + h == lane.time) lane.has_failed = true;
      lane.step = h;
      steps[k] = h;
    }
    stages_.begin_step(now(), together(steps));
  }

  void guess_slopes() {
    EachOrbit start{};
    EachOrbit length{};
    EachOrbit is_constant{};
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      const Lane& lane = lanes_[k];
      is_constant[k] = !is_at_work(k) || lane.guess == Guess::none ? 1 : 0;
      start[k] = lane.guess == Guess::last_step ? 1 : 0;
      if (is_constant[k] == 0) length[k] = lane.step / lane.guessed_from;
    }
    stages_.reposition(together(start), together(length));
    const Orbits constant = together(is_constant);
    const std::size_t s = stages_.stages();
    for (std::size_t c = 0; c < stages_.components(); ++c) {
      for (std::size_t i = 0; i < s; ++i) {
        Orbits& slope = stages_.slopes()[c * s + i];
        slope = choose(constant, start_slopes_[c], slope);
      }
    }
  }

  /// A number that is not zero for lanes in which a slope at the new state is not finite.
  Orbits check_finite() const {
    Orbits sum(0.0);
    for (const Orbits& slope : start_slopes_) sum += slope - slope;
    return choose(sum, Orbits(1.0), Orbits(0.0));
  }

  void refuse(Lane& lane, bool is_solved, double error) {
    ++lane.statistics.rejected_steps;
    if (settings_.step) {
      lane.has_failed = true;
      return;
    }
    const bool is_sound = std::isfinite(error);
    lane.guess = is_solved && is_sound ? Guess::repeated_step : Guess::none;
    lane.guessed_from = lane.step;
    lane.proposed = lane.step * control_.rule().reduction(error, lane.tolerance);
  }

  void accept(std::size_t k, double error) {
    Lane& lane = lanes_[k];
    IntegrationStatistics& statistics = lane.statistics;
    lane.guess = Guess::last_step;
    lane.guessed_from = lane.step;
    ++statistics.steps;
    statistics.periods += control_.rule().periods(control_.measures(k), lane.step);
    statistics.vector_field_evaluations += settings_.stages;
    if (settings_.step) {
      if (settings_.estimates_step_error) statistics.record_step_error(error);
      --lane.remaining_steps;
      lane.time = lane.remaining_steps == 0
                      ? duration_
                      : duration_ - lane.proposed * static_cast<double>(lane.remaining_steps);
      return;
    }
    statistics.record_step_error(error);
    const double growth = control_.rule().growth(
        error, lane.tolerance, control_.rule().time_scale_ratio(control_.measures(k)));
    const double stop = ends_.after(lane.time);
    const double remaining = (stop - lane.time) + lane.lost_time;
    add_compensated(lane.time, lane.lost_time, lane.step);
    if (lane.step == remaining) {
      lane.time = stop;
      lane.lost_time = 0;
    }
    lane.proposed = lane.step * growth;
    if (stop != duration_ && lane.step != lane.wanted) {
      lane.proposed = proposal_after_cut(lane.proposed, lane.wanted);
    }
    if (statistics.steps >= most_steps) lane.has_failed = true;
  }

  /// An orbit of more steps is integrated by itself, because such a run reports its progress.
  static constexpr long most_steps = 1000000;

  LaneEnd end(std::size_t k) {
    Lane& lane = lanes_[k];
    LaneEnd result{lane.orbit, !lane.has_failed, {}, std::move(lane.statistics)};
    if (!result.is_solved) return result;
    result.jet = jets_.jet(k);
    for (const Series<double>& component : result.jet) {
      for (const double x : component.coefficients()) {
        result.is_solved = result.is_solved && std::isfinite(x);
      }
    }
    return result;
  }

  double start_time_;
  double duration_;
  StepEnds<double> ends_;
  GaussSettings settings_;
  int order_;
  LaneStages stages_;
  LaneJets<Components> jets_;
  LaneStepControl control_;
  std::vector<Orbits> start_slopes_;  ///< slopes at the starts of the next steps
  std::array<Lane, orbit_lanes> lanes_;
  bool is_exhausted_ = false;
};

}  // namespace hamjet
