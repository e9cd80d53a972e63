#include "switched_flight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../../exact_flow.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "phase_flight.hpp"
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
    if (flight.burns_mass()) lower = 0;  // see switching_function
    if (upper) *upper *= span.threshold;
    std::optional<ThresholdCrossing> crossing;
    bool is_above = false;
    while (!crossing && flight.now() < duration_) {
      const double step = flight.expand(duration_);
      const std::vector<double> square = flight.switching_function();
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
    span = std::move(next);
    if (!crossing) break;
    span.phase = phase_beyond(phase, is_above, law.smoothing);
    span.primer_rate = crossing->slope / (2 * flight.unit() * primer_length(span.state));
    entered_from_below = is_above;
  }
  spans.push_back(span);
  return spans;
}

// Where the thrust is continuous, a switch that is later changes nothing behind it.
SwitchedFlight::Commanded SwitchedFlight::commanded(const std::vector<ThrustSpan>& flown,
                                                    const SwitchedThrust& law,
                                                    const SwitchedThrust& change) const {
  if (law.smoothing == 0) return commanded_across_switches(flown, law, change);
  constexpr Eigen::Index all = 2 * flown_states;
  Eigen::Matrix<double, all, 7> carried = Eigen::Matrix<double, all, 7>::Zero();
  carried.bottomLeftCorner<6, 6>().setIdentity();
  for (std::size_t k = 0; k + 1 < flown.size(); ++k) {
    const ThrustSpan& span = flown[k];
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

// Derivatives are carried at fixed times, of states, costates, the full acceleration and the
// threshold; the last two rest in coasts. A switch that is later by dt changes the velocity behind
// it by dt times what the acceleration before it is larger, and so the change that is spent, of
// which the acceleration grows. The threshold's rate is zero at a switch, on both sides of it. With
// e = 0 the thresholds move with a change of e both ways, which is not asked for.
SwitchedFlight::Commanded SwitchedFlight::commanded_across_switches(
    const std::vector<ThrustSpan>& flown, const SwitchedThrust& law,
    const SwitchedThrust& change) const {
  constexpr Eigen::Index n = flown_states;
  constexpr Eigen::Index acceleration = n, costates = n + 1, threshold = 2 * n + 1, all = 2 * n + 2;
  const double tolerance = tolerance_of_switched_commands(0);
  Eigen::Matrix<double, all, 7> carried = Eigen::Matrix<double, all, 7>::Zero();
  carried.block<n, n>(costates, 0).setIdentity();
  carried(acceleration, 6) = change.most;
  for (std::size_t k = 0; k + 1 < flown.size(); ++k) {
    const ThrustSpan& span = flown[k];
    const bool burns = span.phase == ThrustPhase::full;
    if (k > 0) {
      const Eigen::Vector3d direction = -primer_costate(span.state).normalized();
      const Eigen::Matrix<double, 1, 7> later =
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
      Eigen::Matrix<double, 2 * n, 7> both;
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
    flow.col(acceleration) = flow.col(all);
    Eigen::Matrix<double, all, 7> next = flow.topLeftCorner<all, all>() * carried;
    next.col(6) += flow.block<all, 1>(0, all + 1) * change.inverse_exhaust;
    const double last = flown[k + 1].acceleration;
    const double spent = law.mass_falls() ? std::log(last / span.acceleration) / law.inverse_exhaust
                                          : span.acceleration * span.length();
    next.row(acceleration) = last * (carried.row(acceleration) / span.acceleration +
                                     law.inverse_exhaust * next.row(acceleration));
    next(acceleration, 6) += last * spent * change.inverse_exhaust;
    carried = next;
  }
  Commanded result;
  result << carried.topRows<n>();
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
