#include "phase_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {

Eigen::Vector3d primer_costate(const std::vector<double>& state) {
  return {state[PhaseFlight::states + 3], state[PhaseFlight::states + 4],
          state[PhaseFlight::states + 5]};
}

bool is_linear(ThrustPhase phase, double smoothing) {
  return phase == ThrustPhase::off || (phase == ThrustPhase::between && smoothing == 1);
}

std::vector<double> parameters_of(const ThrustSpan& span, const SwitchedThrust& law) {
  if (span.phase == ThrustPhase::off) return {0};
  if (span.phase == ThrustPhase::full) return {0, -span.acceleration};
  const double slope = law.most / (2 * law.smoothing);
  if (law.smoothing == 1) return {slope};
  return {slope, slope * (1 - law.smoothing)};
}

PhaseFlight::PhaseFlight(const SharedSystem& system, const ThrustSpan& span,
                         const SwitchedThrust& law, const ClockTime& start_time)
    : flow_(system),
      start_time_(start_time),
      span_(span),
      law_(law),
      is_directed_(!is_linear(span.phase, law.smoothing)),
      falls_(law.mass_falls() && span.phase == ThrustPhase::full),
      first_costate_(falls_ ? states + 1 : states),
      now_(span.start),
      state_(span.state) {
  if (falls_) {
    // The change and its costate stand behind the states and behind the costates.
    state_.insert(state_.begin() + states, 0.0);
    state_.insert(state_.end(), {span.threshold, span.acceleration, law.inverse_exhaust});
  } else {
    for (const double parameter : parameters_of(span, law)) state_.push_back(parameter);
  }
}

double PhaseFlight::expand(double to) {
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

std::vector<double> PhaseFlight::switching_function() const {
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
  if (falls_) add(first_costate_ + states, -1);
  return square;
}

ThrustSpan PhaseFlight::evaluate(double after, std::vector<double>& rates) const {
  std::vector<double> state, all_rates;
  evaluate(after, state, &all_rates);
  rates = outer(all_rates);
  return place_of(state, now_ + after);
}

void PhaseFlight::step(double length) {
  std::vector<double> next;
  evaluate(length, next, nullptr);
  state_ = std::move(next);
  now_ += length;
}

void PhaseFlight::step(double length, double to) {
  const bool is_last = length >= to - now_;
  step(is_last ? to - now_ : length);
  if (is_last) now_ = to;
}

void PhaseFlight::evaluate(double after, std::vector<double>& all,
                           std::vector<double>* rates) const {
  all.resize(state_.size());
  flow_.evaluate(0, after, all);
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

// States and costates of what is integrated.
std::vector<double> PhaseFlight::outer(const std::vector<double>& all) const {
  std::vector<double> result(all.begin(), all.begin() + states);
  const auto costates = all.begin() + static_cast<std::ptrdiff_t>(first_costate_);
  result.insert(result.end(), costates, costates + states);
  return result;
}

ThrustSpan PhaseFlight::place_of(const std::vector<double>& all, double time) const {
  ThrustSpan place = span_;
  place.start = place.end = time;
  place.primer_rate = 0;
  place.state = outer(all);
  if (falls_) {
    place.acceleration *= std::exp(all[states] * law_.inverse_exhaust);
    place.threshold = all[first_costate_ + states];
  }
  return place;
}

// Half the time in which the primer vector could vanish, where its direction is singular. Along
// a line the direction stays the same, and its coefficients, which are rounding alone, would not
// tell.
double PhaseFlight::direction_reach() const {
  if (!is_directed_) return std::numeric_limits<double>::infinity();
  double rate = 0;
  for (std::size_t i = 3; i < 6; ++i) {
    rate = std::hypot(rate, flow_.coefficient(0, first_costate_ + i, 1) / unit());
  }
  return primer_costate(outer(state_)).norm() / (2 * rate);
}

}  // namespace hamjet
