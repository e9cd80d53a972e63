#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

#include "../compensated_addition.hpp"
#include "../integration_clock.hpp"
#include "../series_step_control.hpp"
#include "../step_ends.hpp"
#include "../step_sequence.hpp"
#include "../summed_jet.hpp"
#include "end_map.hpp"
#include "gauss_checkpoint.hpp"
#include "gauss_step_control.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "nominal_stages.hpp"
#include "stage_slopes.hpp"

namespace hamjet {

/// One Gauss integration; Lanes >= stages.
template <class Real, int Lanes>
class GaussIntegrator {
 public:
  using P = Pack<Real, Lanes>;
  using Clock = IntegrationClock::Clock;

  GaussIntegrator(const FlowProblem<Real>& problem, const GaussSettings& settings,
                  IntegrationStatistics& statistics)
      : GaussIntegrator(problem, settings, statistics, working_order(problem)) {}

  /// Steps are chosen as for a jet of order `controlled_order`, which may be above the problem's
  /// order.
  GaussIntegrator(const FlowProblem<Real>& problem, const GaussSettings& settings,
                  IntegrationStatistics& statistics, int controlled_order)
      : problem_(problem),
        settings_(settings),
        statistics_(statistics),
        order_(working_order(problem)),
        start_time_(problem.start_time.template in<Real>()),
        ends_(problem),
        stages_(*problem.system, gauss_tableau(static_cast<std::size_t>(settings.stages)),
                problem.space, order_),
        point_(problem.system->evaluated_list(), problem.space, 0),
        end_map_(make_end_map()),
        jet_(problem, settings.compensated_summation, end_map_.has_value()),
        control_(settings, stages_, jet_, controlled_order),
        nominal_(
            *problem.system, settings, stages_, jet_, control_, end_slope_,
            [this] { evaluate_end_slope(); }, statistics) {}

  /// Runs to the end of the duration and calls the observer after every step.
  FlowJet<Real> run(const StepObserver<Real>& observer) {
    return run_nominal(
        observer, [](long) { return false; }, [](const auto&) {});
  }

  /// Runs like `run`. At the start and after every step for which `is_kept(taken)` holds, it calls
  /// `keep` with the checkpoint of the nominal.
  template <class IsKept, class Keep>
  FlowJet<Real> run_nominal(const StepObserver<Real>& observer, const IsKept& is_kept,
                            const Keep& keep) {
    begin();
    while (at_.time != problem_.duration) {
      if (is_kept(at_.taken)) keep(checkpoint());
      step();
      if (observer) clock_.exclude([&] { observer(at_.time, jet_.value()); });
    }
    if (is_kept(at_.taken)) keep(checkpoint());
    return finish();
  }

  /// Repeats the steps of an earlier run of the same nominal, from a checkpoint to step number
  /// `last`. `after(taken)` is the checkpoint of the earlier run after that many steps, whose
  /// results are taken over; if it is null, they are computed again, with the same result.
  template <class After>
  FlowJet<Real> run_from(const GaussCheckpoint<Real, Lanes>& start, long last, const After& after,
                         const StepObserver<Real>& observer) {
    jet_.resume(start.state, start.lost);
    at_ = start.at;
    stages_.restore(start.slopes, start.is_by_newton, start.contraction);
    end_slope_ = start.end_slope;
    if (at_.taken > 0) guess_ = {Real(1), at_.previous_step};
    while (at_.taken < last) {
      const GaussCheckpoint<Real, Lanes>* const end = after(at_.taken + 1);
      if (end != nullptr) {
        repeat_step(*end);
      } else {
        step();
      }
      if (observer) clock_.exclude([&] { observer(at_.time, jet_.value()); });
    }
    return finish();
  }

 private:
  FlowJet<Real> finish() {
    if (problem_.duration != 0 && !end_slope_.is_evaluated) evaluate_end_slope();
    statistics_.series_work = settings_.stages * stages_.evaluator().work();
    statistics_.wall_seconds = clock_.seconds();
    require_finite(jet_.value(), at_.time, "Gauss");
    return jet_.take();
  }

  GaussCheckpoint<Real, Lanes> checkpoint() {
    return {jet_.constants(),       jet_.lost_constants(), at_,       stages_.slopes(),
            stages_.is_by_newton(), stages_.contraction(), end_slope_};
  }

  /// After so many rejections of a step its error estimate may be rounding.
  static constexpr int trials_of_noise = 4;

  /// A step is repeated if its error estimate exceeds the tolerance by more than this factor. The
  /// estimate is proportional to h^(2s), so that repeating a step that is slightly too long does
  /// not pay. If every degree is controlled, the tolerance is far below the needed accuracy.
  double largest_excess() const { return settings_.controls_all_degrees ? 1000 : 10; }

  Clock::time_point profile_mark() const {
    return settings_.profile == nullptr ? Clock::time_point() : Clock::now();
  }
  /// Adds the time since `mark` to one entry of the profile and sets the mark to now.
  void account(double GaussProfile::*entry, Clock::time_point& mark) {
    if (settings_.profile == nullptr) return;
    const auto now = Clock::now();
    settings_.profile->*entry += std::chrono::duration<double>(now - mark).count();
    mark = now;
  }

  void begin() {
    if (problem_.duration == 0) return;
    evaluate_end_slope();
    if (settings_.step) {
      at_.remaining_steps = equal_step_count(problem_.duration, *settings_.step, "Gauss");
      at_.proposed = problem_.duration / Real(at_.remaining_steps);
    } else {
      point_.evaluate_constant_terms();
      at_.proposed = control_.first_step(point_, problem_.duration);
    }
  }

  /// The present time of the system's clock.
  Real now() const { return start_time_ + (at_.time - at_.lost_time); }

  /// Measures by how much the slopes at the start of the step change with a rounding of the time.
  /// This takes evaluations, and only steps that have been rejected several times may need it.
  void measure_time_noise() {
    if (!problem_.system->vector_field.depends_on_time()) return;
    std::vector<Real> beside;
    evaluate_slope(beside, now() * (1 + 2 * std::numeric_limits<Real>::epsilon()));
    at_.time_noise = std::max(at_.time_noise,
                              static_cast<double>(stages_.template largest_component<Real>(
                                  [&](std::size_t c) { return beside[c] - end_slope_.value[c]; })));
  }

  void evaluate_end_slope() {
    evaluate_slope(end_slope_.value, now());
    end_slope_.is_evaluated = true;
  }

  /// The control of steps needs the slopes at the end of each. Fixed steps take those of the
  /// collocation polynomial, until a doubt about the next step's solution asks for more: at one
  /// point an evaluation of a field takes nearly as long as at all stages.
  void find_end_slope() {
    if (!settings_.step || settings_.estimates_step_error) return evaluate_end_slope();
    for (std::size_t c = 0; c < end_slope_.value.size(); ++c) {
      end_slope_.value[c] = stages_.slope_at_end(c);
    }
    end_slope_.is_evaluated = false;
  }

  /// Evaluates the slopes g at the constant terms of the state, at a time.
  void evaluate_slope(std::vector<Real>& slope, const Real& time) {
    const std::size_t m = stages_.system().components();
    point_.set_time(time);
    for (std::size_t c = 0; c < m; ++c) *point_.input(c) = jet_.constant(c);
    point_.evaluate_constant_values();
    slope.assign(m, Real(0));
    for (std::size_t c = 0; c < m; ++c) {
      if (stages_.system().unit_mass()) {
        slope[c] = *point_.output(c);
      } else {
        for (std::size_t k = 0; k < m; ++k) {
          slope[c] += stages_.system().inverse_mass(c, k) * *point_.output(k);
        }
      }
      if (!is_finite(slope[c])) {
        throw Error(
            ErrorKind::numerical,
            fmt::format("Gauss: the vector field is not finite at t = {:.10g}: a collision, "
                        "or a point outside its domain",
                        static_cast<double>(at_.time)));
      }
    }
  }

  void step() {
    auto mark = profile_mark();
    const Real& end = settings_.step ? problem_.duration : ends_.after(at_.time);
    const Real remaining = (end - at_.time) + at_.lost_time;
    Real h = at_.proposed;
    Real wanted = h;
    double growth = 1;
    for (int trial = 1;; ++trial) {
      if (trial == trials_of_noise) measure_time_noise();
      if (!settings_.step) {
        wanted = control_.sampling_step(h, *problem_.system, jet_.start());
        h = fit_to_span(wanted, remaining);
      }
      if (!is_finite(h) || at_.time + h == at_.time) {
        throw Error(
            ErrorKind::numerical,
            fmt::format("Gauss: the step size fell to {:.3g} at t = {:.15g}: a collision or "
                        "another singularity lies ahead",
                        static_cast<double>(h), static_cast<double>(at_.time)));
      }
      step_ = h;
      const bool is_solved = nominal_.solve(now(), h, guess_);
      account(&GaussProfile::nominal, mark);
      if (settings_.step) {
        if (!is_solved) fail_fixed_step(h);
        if (settings_.estimates_step_error) {
          clock_.exclude(
              [&] {
                statistics_.record_step_error(
                    control_.error_estimate(step_, end_slope_.value, at_.time_noise));
              },
              statistics_.step_error_seconds);
        }
        if (!solve_degrees(mark)) fail_fixed_step(h);
        break;
      }
      double error = is_solved ? control_.error_estimate(step_, end_slope_.value, at_.time_noise)
                               : std::numeric_limits<double>::infinity();
      if (error <= largest_excess() * *settings_.tolerance) {
        if (!solve_degrees(mark)) fail_fixed_step(h);
        if (settings_.controls_all_degrees) {
          error = std::max(error, SeriesStepControl<Real, Lanes>::error_estimate(
                                      stages_, control_.last_mode_weights(), jet_.value(), order_));
        }
      }
      if (error <= largest_excess() * *settings_.tolerance) {
        growth = control_.growth(error);
        statistics_.record_step_error(error);
        break;
      }
      ++statistics_.rejected_steps;
      if (is_solved) {
        guess_ = {Real(0), h};
      } else {
        guess_.reset();
      }
      h *= Real(control_.reduction(error));
    }
    at_.previous_step = h;
    guess_ = {Real(1), h};
    ++at_.taken;
    ++statistics_.steps;
    statistics_.periods += control_.periods(h);
    statistics_.vector_field_evaluations += settings_.stages;
    if (settings_.step) {
      --at_.remaining_steps;
      at_.time = at_.remaining_steps == 0
                     ? problem_.duration
                     : problem_.duration - at_.proposed * Real(at_.remaining_steps);
    } else {
      // Without compensation the rounding of thousands of steps would miss the end of the duration.
      add_compensated(at_.time, at_.lost_time, h);
      if (h == remaining) {
        at_.time = end;
        at_.lost_time = 0;
      }
      at_.proposed = h * Real(growth);
      if (end != problem_.duration && h != wanted) {
        at_.proposed = proposal_after_cut(at_.proposed, wanted);
      }
      limit_step_count("Gauss", at_.taken, static_cast<double>(at_.time),
                       static_cast<double>(problem_.duration));
    }
    advance_jet(h);
    find_end_slope();
    account(&GaussProfile::update, mark);
  }

  /// Repeats a step that an earlier run of the same nominal took.
  void repeat_step(const GaussCheckpoint<Real, Lanes>& end) {
    auto mark = profile_mark();
    step_ = end.at.previous_step;
    stages_.begin_step(now(), step_);
    stages_.restore(end.slopes, end.is_by_newton, end.contraction);
    stages_.evaluate_at_slopes(jet_.start(), statistics_);
    if (!solve_degrees(mark)) fail_fixed_step(step_);
    at_ = end.at;
    advance_jet(step_);
    end_slope_ = end.end_slope;
    account(&GaussProfile::update, mark);
    guess_ = {Real(1), step_};
    ++statistics_.steps;
    statistics_.vector_field_evaluations += settings_.stages;
  }

  [[noreturn]] void fail_fixed_step(const Real& h) const {
    throw Error(
        ErrorKind::numerical,
        fmt::format("Gauss with {} stages: the implicit equations of the step of {:.6g} from "
                    "t = {:.10g} have no solution connected to its start; a smaller step is "
                    "needed",
                    settings_.stages, static_cast<double>(h), static_cast<double>(at_.time)));
  }

  /// Solves the degrees 1..N of the stages; returns false if their equations cannot be solved.
  bool solve_degrees(Clock::time_point& mark) {
    // Series along one or two lines, and the first degrees of bivariate ones, have too few
    // monomials for a factorisation. The choice depends on the degree, so that all degrees but the
    // highest are independent of the order.
    const SeriesSpace& space = *problem_.space;
    const int last_iterated = space.variables() > 2 ? 0 : (space.is_uncoupled() ? order_ : 3);
    bool iterates = true;
    bool is_factorised = false;
    auto& evaluator = stages_.evaluator();
    const auto state = [this](std::size_t component, std::size_t monomial) {
      return jet_.coefficient(component, monomial);
    };
    for (int d = 1; d <= order_; ++d) {
      evaluator.evaluate_remainder(d);
      account(&GaussProfile::series, mark);
      iterates = iterates && d <= last_iterated && stages_.iterate_degree(d, state);
      if (!iterates && !is_factorised) {
        if (!stages_.factorise(needed_response())) return false;
        is_factorised = true;
        account(&GaussProfile::factorisation, mark);
      }
      if (d == order_ && end_map_) break;
      if (!iterates) stages_.solve_degree(d, state);
      account(&GaussProfile::linear_solves, mark);
      if (end_map_) {
        evaluator.complete_intermediates(d);
      } else {
        evaluator.complete(d);
      }
      account(&GaussProfile::update, mark);
    }
    if (end_map_) end_map_->form(stages_, order_ >= 2);
    account(&GaussProfile::linear_solves, mark);
    return true;
  }

  /// The stages of degree 1 have no remainders, and the end map does not need the stages of the
  /// highest degree.
  Response needed_response() const {
    if (order_ == 1) return Response::left_out;
    return order_ == 2 && end_map_ ? Response::for_end_map : Response::formed;
  }

  /// The end map, if it can be used; the control of all degrees needs the slopes instead.
  std::optional<EndMap<Real, Lanes>> make_end_map() const {
    if (settings_.controls_all_degrees ||
        !EndMap<Real, Lanes>::serves(stages_.system(), *problem_.space, order_)) {
      return std::nullopt;
    }
    return EndMap<Real, Lanes>();
  }

  /// Advances the jet to the new state, at the present time, using the stages.
  void advance_jet(const Real& h) {
    jet_.advance(stages_, h, end_map_ ? 0 : order_);
    if (end_map_) jet_.advance_by(*end_map_, stages_.evaluator(), order_);
  }

  const FlowProblem<Real>& problem_;
  const GaussSettings& settings_;
  IntegrationStatistics& statistics_;
  IntegrationClock clock_;
  int order_;
  Real start_time_;
  StepEnds<Real> ends_;
  StageSlopes<Real, Lanes> stages_;
  SliceEvaluator<Real, Real> point_;  ///< the vector field at one point
  std::optional<EndMap<Real, Lanes>> end_map_;
  SummedJet<Real, Lanes> jet_;
  GaussStepControl<Real, Lanes> control_;
  NominalStages<Real, Lanes> nominal_;
  GaussStepping<Real> at_;
  Real step_ = 0;                           ///< the step that is being tried
  std::optional<KnownSlopes<Real>> guess_;  ///< the slopes from which the next trial is guessed
  EndSlope<Real> end_slope_;  ///< at the end of the last step, where the next one starts
};

}  // namespace hamjet
