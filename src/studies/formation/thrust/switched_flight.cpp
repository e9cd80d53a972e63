#include "switched_flight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "../../../integrators/taylor_flow.hpp"
#include "../../exact_flow.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "threshold_crossing.hpp"

namespace hamjet {
namespace {

constexpr std::size_t flown_states = SwitchedFlight::states;
constexpr std::size_t most_phases = 400;

/// The tolerance of the derivatives for Newton's method, whose steps are judged by flights without
/// them. Between the thresholds rounding of the primer vector is a share 1e-16 / e of the thrust,
/// which no step makes smaller.
double tolerance_of_switched_commands(double smoothing) {
  return smoothing > 0 ? std::max(1e-10, 1e-13 / smoothing) : 1e-10;
}

std::optional<double> lower_threshold(ThrustPhase phase, double smoothing) {
  if (phase == ThrustPhase::off) return std::nullopt;
  if (phase == ThrustPhase::full) return 1 + smoothing;
  return smoothing < 1 ? std::optional(1 - smoothing) : std::nullopt;
}

std::optional<double> upper_threshold(ThrustPhase phase, double smoothing) {
  if (phase == ThrustPhase::full) return std::nullopt;
  return phase == ThrustPhase::off ? 1 - smoothing : 1 + smoothing;
}

ThrustPhase phase_beyond(ThrustPhase phase, bool is_above, double smoothing) {
  if (smoothing == 0) return is_above ? ThrustPhase::full : ThrustPhase::off;
  if (phase == ThrustPhase::between) return is_above ? ThrustPhase::full : ThrustPhase::off;
  return ThrustPhase::between;
}

ThrustPhase phase_at(double primer, double smoothing) {
  if (smoothing < 1 && primer < 1 - smoothing) return ThrustPhase::off;
  return primer > 1 + smoothing || smoothing == 0 ? ThrustPhase::full : ThrustPhase::between;
}

bool is_linear(ThrustPhase phase, double smoothing) {
  return phase == ThrustPhase::off || (phase == ThrustPhase::between && smoothing == 1);
}

/// The parameters of a phase's system (thrusting_system), if the mass stays the same.
std::vector<double> parameters_of(const ThrustSpan& span, const SwitchedThrust& law) {
  if (span.phase == ThrustPhase::off) return {0};
  if (span.phase == ThrustPhase::full) return {0, -span.acceleration};
  const double slope = law.most / (2 * law.smoothing);
  if (law.smoothing == 1) return {slope};
  return {slope, slope * (1 - law.smoothing)};
}

/// Their change with a change of the law.
std::vector<double> parameter_changes(ThrustPhase phase, const SwitchedThrust& law,
                                      const SwitchedThrust& change) {
  if (phase == ThrustPhase::off) return {0};
  if (phase == ThrustPhase::full) return {0, -change.most};
  const double slope =
      (change.most - law.most * change.smoothing / law.smoothing) / (2 * law.smoothing);
  if (law.smoothing == 1) return {slope};
  return {slope, slope - change.most / 2};
}

Eigen::Vector3d primer_costate(std::span<const double> z) {
  return {z[flown_states + 3], z[flown_states + 4], z[flown_states + 5]};
}

/// The steps of one phase.
class PhaseFlight {
 public:
  PhaseFlight(const SharedSystem& system, const ThrustSpan& span, const SwitchedThrust& law,
              const ClockTime& start_time)
      : flow_(system),
        start_time_(start_time),
        span_(span),
        law_(law),
        is_directed_(!is_linear(span.phase, law.smoothing)),
        falls_(law.mass_falls() && span.phase == ThrustPhase::full),
        first_costate_(falls_ ? flown_states + 1 : flown_states),
        now_(span.start),
        state_(span.state) {
    if (falls_) {
      // The change and its costate stand behind the states and behind the costates.
      state_.insert(state_.begin() + flown_states, 0.0);
      state_.insert(state_.end(), {span.threshold, span.acceleration, law.inverse_exhaust});
    } else {
      for (const double parameter : parameters_of(span, law)) state_.push_back(parameter);
    }
  }

  double now() const { return now_; }
  double unit() const { return flow_.unit(0); }
  /// As a phase that begins here.
  ThrustSpan place() const { return place_of(state_, now_); }
  bool mass_falls() const { return falls_; }

  /// Expands about the present state; the length of the step that may be taken, up to a time.
  double expand(double to) {
    for (std::size_t lane = 0; lane < TaylorFlow::lanes; ++lane) {
      flow_.set_state(lane, start_time_ + now_, state_);
    }
    const std::array<double, 1> span = {to - now_};
    flow_.expand(span);
    const double step = std::min(flow_.within_reach(0, to - now_), direction_reach());
    if (!(step > 1e-14 * std::abs(to - now_)) && !flow_.ends_at_break(0, step)) {
      throw Error(ErrorKind::numerical,
                  "thrust: the equations of motion cannot be followed at the deputy's place");
    }
    return step;
  }
  /// The squared length of the primer vector as a polynomial of the time in units; where the mass
  /// falls, less that of the threshold.
  std::vector<double> squared_primer() const {
    const int powers = flow_.powers(0);
    std::vector<double> square(static_cast<std::size_t>(2 * powers) + 1, 0.0);
    const auto add = [&](std::size_t i, double sign) {
      for (int j = 0; j <= powers; ++j) {
        for (int k = 0; k <= powers; ++k) {
          square[static_cast<std::size_t>(j + k)] +=
              sign * flow_.coefficient(0, i, j) * flow_.coefficient(0, i, k);
        }
      }
    };
    for (std::size_t i = 3; i < 6; ++i) add(first_costate_ + i, 1);
    if (falls_) add(first_costate_ + flown_states, -1);
    return square;
  }
  /// The place at a time after the present one, and the rates of its state.
  ThrustSpan evaluate(double after, std::vector<double>& rates) const {
    std::vector<double> state, all_rates;
    evaluate(after, state, &all_rates);
    rates = outer(all_rates);
    return place_of(state, now_ + after);
  }
  /// A step of a length, but no further than to a time, which rounding shall not miss.
  void step(double length, double to) {
    const bool is_last = length >= to - now_;
    step(is_last ? to - now_ : length);
    if (is_last) now_ = to;
  }
  void step(double length) {
    std::vector<double> next;
    evaluate(length, next, nullptr);
    state_ = std::move(next);
    now_ += length;
  }

 private:
  void evaluate(double after, std::vector<double>& state, std::vector<double>* rates) const {
    state.resize(state_.size());
    flow_.evaluate(0, after, state);
    if (rates == nullptr) return;
    rates->assign(state_.size(), 0.0);
    const double x = after / unit();
    for (std::size_t i = 0; i < rates->size(); ++i) {
      for (int k = flow_.powers(0); k >= 1; --k) {
        (*rates)[i] = (*rates)[i] * x + k * flow_.coefficient(0, i, k);
      }
      (*rates)[i] /= unit();
    }
  }
  /// States and costates of what is integrated.
  std::vector<double> outer(const std::vector<double>& all) const {
    std::vector<double> result(all.begin(), all.begin() + flown_states);
    const auto costates = all.begin() + static_cast<std::ptrdiff_t>(first_costate_);
    result.insert(result.end(), costates, costates + flown_states);
    return result;
  }
  ThrustSpan place_of(const std::vector<double>& all, double time) const {
    ThrustSpan place = span_;
    place.start = place.end = time;
    place.state = outer(all);
    if (falls_) {
      place.acceleration *= std::exp(all[flown_states] * law_.inverse_exhaust);
      place.threshold = all[first_costate_ + flown_states];
    }
    return place;
  }

  /// Half the time in which the primer vector could vanish, where its direction is singular. Along
  /// a line the direction stays the same, and its coefficients, which are rounding alone, would not
  /// tell.
  double direction_reach() const {
    if (!is_directed_) return std::numeric_limits<double>::infinity();
    double rate = 0;
    for (std::size_t i = 3; i < 6; ++i) {
      rate = std::hypot(rate, flow_.coefficient(0, first_costate_ + i, 1) / unit());
    }
    return primer_costate(outer(state_)).norm() / (2 * rate);
  }

  TaylorFlow flow_;
  ClockTime start_time_;
  const ThrustSpan& span_;
  const SwitchedThrust& law_;
  bool is_directed_;
  bool falls_;
  std::size_t first_costate_;
  double now_;
  std::vector<double> state_;
};

void require_numbers(const ThrustSpan& place) {
  for (const double x : place.state) {
    if (std::isfinite(x)) continue;
    throw Error(ErrorKind::numerical, "thrust: a flight left the range of numbers");
  }
}

}  // namespace

double primer_length(const std::vector<double>& state) { return primer_costate(state).norm(); }

SwitchedFlight::SwitchedFlight(const DynamicalSystem& system, const ClockTime& start_time,
                               double duration)
    : coasting_(thrusting_system(system, ThrustForm::linear)),
      directed_(thrusting_system(system, ThrustForm::directed)),
      falling_(thrusting_system(system, ThrustForm::falling)),
      start_time_(start_time),
      duration_(duration),
      is_autonomous_(coasting_->is_autonomous()) {}

const SharedSystem& SwitchedFlight::system_of(ThrustPhase phase, const SwitchedThrust& law) const {
  if (is_linear(phase, law.smoothing)) return coasting_;
  return law.mass_falls() ? falling_ : directed_;
}

std::vector<ThrustSpan> SwitchedFlight::fly(const std::vector<double>& start,
                                            const SwitchedThrust& law) const {
  std::vector<ThrustSpan> spans;
  ThrustSpan span{phase_at(primer_length(start), law.smoothing), 0, 0, start, 0, law.most, 1};
  std::optional<bool> entered_from_below;
  while (true) {
    if (spans.size() > most_phases) {
      throw Error(ErrorKind::numerical,
                  fmt::format("thrust: more than {} switches on the way", most_phases));
    }
    PhaseFlight flight(system_of(span.phase, law), span, law, start_time_);
    std::optional<double> lower = lower_threshold(span.phase, law.smoothing);
    std::optional<double> upper = upper_threshold(span.phase, law.smoothing);
    if (flight.mass_falls()) lower = 0;
    if (upper) *upper *= span.threshold;
    std::optional<ThresholdCrossing> crossing;
    bool is_above = false;
    while (!crossing && flight.now() < duration_) {
      const double step = flight.expand(duration_);
      const std::vector<double> square = flight.squared_primer();
      const double reach = step / flight.unit();
      if (lower) {
        crossing = first_fall_below(square, *lower * *lower, reach, entered_from_below == true);
      }
      if (upper) {
        const auto rise =
            first_rise_above(square, *upper * *upper, reach, entered_from_below == false);
        if (rise && (!crossing || rise->place < crossing->place)) {
          crossing = rise;
          is_above = true;
        }
      }
      entered_from_below.reset();
      if (crossing) {
        flight.step(crossing->place * flight.unit());
      } else {
        flight.step(step, duration_);
      }
    }
    span.end = flight.now();
    const ThrustPhase phase = span.phase;
    spans.push_back(span);
    ThrustSpan next = flight.place();
    require_numbers(next);
    next.primer_rate = 0;
    span = std::move(next);
    if (!crossing) break;
    span.phase = phase_beyond(phase, is_above, law.smoothing);
    span.primer_rate = crossing->slope / (2 * flight.unit() * primer_length(span.state));
    entered_from_below = is_above;
  }
  spans.push_back(span);
  return spans;
}

// Derivatives are carried at fixed times. A switch that is later by dt changes the velocity behind
// it by dt times what the acceleration before it is larger; where the thrust is continuous, by
// nothing.
SwitchedFlight::Commanded SwitchedFlight::commanded(const std::vector<ThrustSpan>& flown,
                                                    const SwitchedThrust& law,
                                                    const SwitchedThrust& change) const {
  if (law.mass_falls()) return commanded_by_falling_mass(flown, law);
  constexpr Eigen::Index all = 2 * flown_states;
  Eigen::Matrix<double, all, 7> carried = Eigen::Matrix<double, all, 7>::Zero();
  carried.bottomLeftCorner<6, 6>().setIdentity();
  for (std::size_t k = 0; k + 1 < flown.size(); ++k) {
    const ThrustSpan& span = flown[k];
    if (k > 0 && law.smoothing == 0) {
      const Eigen::Vector3d costate = primer_costate(span.state);
      const Eigen::Vector3d direction = -costate.normalized();
      // With e = 0 the thresholds move with a change of e both ways, which is not asked for.
      const Eigen::Matrix<double, 1, 7> later =
          direction.transpose() * carried.bottomRows<3>() / span.primer_rate;
      const double more = span.phase == ThrustPhase::full ? -span.acceleration : span.acceleration;
      carried.middleRows<3>(3) += more * direction * later;
    }
    if (!(span.length() > 1e-13 * duration_)) continue;
    std::vector<double> start = span.state;
    for (const double parameter : parameters_of(span, law)) start.push_back(parameter);
    const Matrix<double> flow =
        linear_part(linear_jet(system_of(span.phase, law), start, start_time_ + span.start,
                               span.length(), tolerance_of_switched_commands(law.smoothing)));
    Eigen::Matrix<double, all, 7> next = flow.topLeftCorner(all, all) * carried;
    const std::vector<double> changes = parameter_changes(span.phase, law, change);
    for (std::size_t j = 0; j < changes.size(); ++j) {
      next.col(6) += flow.block(0, all + static_cast<Eigen::Index>(j), all, 1) * changes[j];
    }
    carried = next;
  }
  return carried.topRows<6>();
}

// Beside states and costates the full acceleration and the threshold are carried. Neither the
// threshold nor, but for its size, the thrust has a rate of its own at a switch.
SwitchedFlight::Commanded SwitchedFlight::commanded_by_falling_mass(
    const std::vector<ThrustSpan>& flown, const SwitchedThrust& law) const {
  constexpr Eigen::Index n = flown_states;
  constexpr Eigen::Index acceleration = n, costates = n + 1, threshold = 2 * n + 1;
  const double tolerance = tolerance_of_switched_commands(0);
  Eigen::Matrix<double, 2 * n + 2, n> carried = Eigen::Matrix<double, 2 * n + 2, n>::Zero();
  carried.middleRows<n>(costates).setIdentity();
  for (std::size_t k = 0; k + 1 < flown.size(); ++k) {
    const ThrustSpan& span = flown[k];
    const bool burns = span.phase == ThrustPhase::full;
    if (k > 0) {
      const Eigen::Vector3d direction = -primer_costate(span.state).normalized();
      const Eigen::Matrix<double, 1, n> later =
          (direction.transpose() * carried.middleRows<3>(costates + 3) + carried.row(threshold)) /
          span.primer_rate;
      const double more = burns ? -span.acceleration : span.acceleration;
      carried.middleRows<3>(3) += more * direction * later;
      carried.row(acceleration) += law.inverse_exhaust * span.acceleration * more * later;
    }
    if (!(span.length() > 1e-13 * duration_)) continue;
    std::vector<double> start = span.state;
    if (!burns) {
      start.push_back(0);
      const Matrix<double> flow = linear_part(
          linear_jet(coasting_, start, start_time_ + span.start, span.length(), tolerance));
      Eigen::Matrix<double, 2 * n, n> both;
      both << carried.topRows<n>(), carried.middleRows<n>(costates);
      both = flow.topLeftCorner<2 * n, 2 * n>() * both.eval();
      carried.topRows<n>() = both.topRows<n>();
      carried.middleRows<n>(costates) = both.bottomRows<n>();
      continue;
    }
    start.insert(start.begin() + n, 0.0);
    start.insert(start.end(), {span.threshold, span.acceleration, law.inverse_exhaust});
    Matrix<double> flow = linear_part(
        linear_jet(falling_, start, start_time_ + span.start, span.length(), tolerance));
    // The first acceleration takes the place of the change, which begins at zero.
    flow.col(acceleration) = flow.col(2 * n + 2);
    Eigen::Matrix<double, 2 * n + 2, n> next = flow.topLeftCorner<2 * n + 2, 2 * n + 2>() * carried;
    next.row(acceleration) =
        flown[k + 1].acceleration * (carried.row(acceleration) / span.acceleration +
                                     law.inverse_exhaust * next.row(acceleration));
    carried = next;
  }
  Commanded result = Commanded::Zero();
  result.leftCols<n>() = carried.topRows<n>();
  return result;
}

void SwitchedFlight::visit(const std::vector<ThrustSpan>& flown, const SwitchedThrust& law,
                           int each_step,
                           const std::function<void(const Instant&)>& visitor) const {
  std::vector<double> rates;
  for (std::size_t k = 0; k + 1 < flown.size(); ++k) {
    const ThrustSpan& span = flown[k];
    PhaseFlight flight(system_of(span.phase, law), span, law, start_time_);
    while (flight.now() < span.end) {
      const double step = flight.expand(span.end);
      for (int part = 0; part <= each_step; ++part) {
        const double after = step * part / each_step;
        const ThrustSpan place = flight.evaluate(after, rates);
        visitor({place.start, span.phase, place.state, rates, place.acceleration, place.threshold});
      }
      flight.step(step, span.end);
    }
  }
}

std::vector<ThrustSpan> SwitchedFlight::at(const std::vector<ThrustSpan>& flown,
                                           const SwitchedThrust& law,
                                           const std::vector<double>& times) const {
  std::vector<ThrustSpan> reached;
  for (std::size_t k = 0; k + 1 < flown.size(); ++k) {
    const ThrustSpan& span = flown[k];
    PhaseFlight flight(system_of(span.phase, law), span, law, start_time_);
    while (reached.size() < times.size() && times[reached.size()] < span.end) {
      const double time = times[reached.size()];
      while (flight.now() < time) flight.step(flight.expand(time), time);
      reached.push_back(flight.place());
      require_numbers(reached.back());
    }
  }
  while (reached.size() < times.size()) reached.push_back(flown.back());
  return reached;
}

}  // namespace hamjet
