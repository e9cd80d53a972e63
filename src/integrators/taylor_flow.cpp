#include "taylor_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "step_ends.hpp"

namespace hamjet {

/// The largest fraction that the last two powers may have; the decay of the powers need not be
/// regular.
constexpr double least_share = 0.25 * std::numeric_limits<double>::epsilon();

TaylorFlow::TaylorFlow(SharedSystem system)
    : system_(std::move(system)),
      highest_power_(system_->vector_field.has_fields() ? highest_power_of_fields : order),
      field_(system_->vector_field, highest_power_) {}

void TaylorFlow::set_state(std::size_t lane, const ClockTime& time, std::span<const double> state,
                           double direction) {
  set_state(lane, time.in<double>(), state, direction);
}

void TaylorFlow::set_state(std::size_t lane, double time, std::span<const double> state,
                           double direction) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double smooth_for = infinity;
  double clock = time;
  for (const double edge : system_->break_times) {
    const double ahead = (edge - time) * direction;
    if (std::abs(ahead) <= StepEnds<double>::nearness * std::abs(time)) {
      // Functions of the time are those of the side to which the flight goes on.
      clock = std::nextafter(edge, direction * infinity);
    } else if (ahead > 0) {
      smooth_for = std::min(smooth_for, ahead);
    }
  }
  clock_.set_lane(static_cast<int>(lane), clock);
  smooth_for_[lane] = smooth_for;
  for (std::size_t i = 0; i < state.size(); ++i) {
    field_.input(i)->set_lane(static_cast<int>(lane), state[i]);
  }
}

TaylorFlow::Lanes TaylorFlow::squares(int power, bool is_of_momenta) const {
  const std::size_t n = system_->degrees_of_freedom;
  const Lanes& unit = inverse_sizes_[is_of_momenta ? 1 : 0];
  Lanes sum;
  for (std::size_t i = 0; i < n; ++i) {
    const Lanes z = field_.input(is_of_momenta ? n + i : i)[power] * unit;
    sum += z * z;
  }
  return sum;
}

void TaylorFlow::choose_units() {
  const std::size_t n = system_->degrees_of_freedom;
  // Numbers are divided by the largest of them before they are squared, so that the squares neither
  // vanish nor overflow.
  const auto norm = [&](const auto& number) {
    Lanes largest(std::numeric_limits<double>::min());
    for (std::size_t i = 0; i < n; ++i) largest = larger_magnitude(largest, number(i));
    const Lanes inverse = Lanes(1) / largest;
    Lanes sum;
    for (std::size_t i = 0; i < n; ++i) {
      const Lanes part = number(i) * inverse;
      sum += part * part;
    }
    return largest * sqrt(sum);
  };
  std::array<Lanes, 2> times;
  std::array<Lanes, 2> rates;
  for (std::size_t g = 0; g < times.size(); ++g) {
    const Lanes size = norm([&](std::size_t i) { return field_.input(g * n + i)[0]; });
    inverse_sizes_[g] = Lanes(1) / size;
    rates[g] = norm([&](std::size_t i) { return field_.output(g * n + i)[0]; });
    times[g] = size / rates[g];
  }
  // The time in which positions and momenta change by their own size: on a circle 1/(2 pi) of a
  // revolution. It is rounded to a power of two, which changes no digit.
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double of_positions = times[0].lane(static_cast<int>(lane));
    const double of_momenta = times[1].lane(static_cast<int>(lane));
    const auto is_usable = [](double time) { return std::isnormal(time) && time > 0; };
    int exponent = 0;
    if (is_usable(of_positions)) {
      const int longest = std::ilogb(of_positions);
      const int other = is_usable(of_momenta) ? std::ilogb(of_momenta) : longest;
      exponent = (longest + std::min(longest, other)) / 2;
    } else if (is_usable(of_momenta)) {
      exponent = std::ilogb(of_momenta);
    }
    const auto i = static_cast<int>(lane);
    exponent = std::min(exponent, longest_exponents_[lane]);
    units_.set_lane(i, std::ldexp(1.0, exponent));
    // What is 0, as momenta at rest are, is measured by its change in that time, and an equilibrium
    // at the origin by nothing.
    for (std::size_t g = 0; g < rates.size(); ++g) {
      if (std::isfinite(inverse_sizes_[g].lane(i))) continue;
      const double change = rates[g].lane(i) * units_.lane(i);
      inverse_sizes_[g].set_lane(i, is_usable(change) ? 1 / change : 1);
    }
  }
}

void TaylorFlow::expand(std::span<const double> times) {
  constexpr int most_tries = 4;
  longest_exponents_.fill(std::numeric_limits<int>::max());
  for (int k = 0; k < most_tries; ++k) {
    expand_in_units(times);
    if (!shorten_overflowing_units()) return;
  }
}

// At an equilibrium whose rates are not 0 but rounding a state takes 1e16 times as long to change
// by its own size as the motion beside it does, and powers of such a unit overflow.
bool TaylorFlow::shorten_overflowing_units() {
  constexpr int less = 24;  // of 53 binary digits of a rate, in two or three tries
  bool are_any = false;
  const Lanes highest = squares(highest_power_, false) + squares(highest_power_, true);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto i = static_cast<int>(lane);
    // A lane that needed fewer powers is proved to be finite.
    if (powers_[lane] < highest_power_ || std::isfinite(highest.lane(i))) continue;
    longest_exponents_[lane] = std::ilogb(units_.lane(i)) - less;
    are_any = true;
  }
  return are_any;
}

void TaylorFlow::expand_in_units(std::span<const double> times) {
  constexpr int fewest = 4;
  const std::size_t size = system_->dimension();
  const Lanes spans = Lanes::of_lanes(
      [&](std::size_t lane) { return lane < times.size() ? std::abs(times[lane]) : 0.0; });
  const std::size_t timed = std::min(times.size(), lanes);
  powers_.fill(highest_power_);
  field_.set_time(clock_);
  field_.expect_power(timed == 0 ? highest_power_ : fewest);
  proved_ = Lanes();
  std::size_t proved = 0;
  Lanes square;     // squares of the durations in the lanes' units of time
  Lanes before(1);  // their power k
  for (int k = 0; k < highest_power_; ++k) {
    field_.expand(k);
    if (k == 0) {
      choose_units();
      field_.set_unit(units_);
      square = spans / units_;
      square *= square;
    }
    const Lanes factor = units_ * Lanes(1.0 / (k + 1));
    for (std::size_t i = 0; i < size; ++i) field_.input(i)[k + 1] = field_.output(i)[k] * factor;
    if (k > 0) before *= square;
    if (timed == 0 || k + 1 < fewest) continue;
    // Positions and momenta have units of their own. Both of the last two powers are considered,
    // because one may vanish by symmetry. They are added, because a sum keeps a NaN.
    Lanes shares;
    for (const bool is_of_momenta : {false, true}) {
      shares += (squares(k, is_of_momenta) + squares(k + 1, is_of_momenta) * square) * before;
    }
    for (std::size_t lane = 0; lane < timed; ++lane) {
      const auto i = static_cast<int>(lane);
      if (powers_[lane] < highest_power_ || !(shares.lane(i) <= least_share * least_share))
        continue;
      powers_[lane] = k + 1;
      proved_.set_lane(i, spans.lane(i));
      ++proved;
    }
    if (proved == timed) return;
  }
}

double TaylorFlow::reach(std::size_t lane, double share) const {
  return std::min(share * reach_of_series(lane), smooth_for_[lane]);
}

double TaylorFlow::reach_of_series(std::size_t lane) const {
  double reach = std::numeric_limits<double>::infinity();
  for (const bool is_of_momenta : {false, true}) {
    for (const int k : {powers_[lane] - 1, powers_[lane]}) {
      const double last = std::sqrt(squares(k, is_of_momenta).lane(static_cast<int>(lane)));
      if (!std::isfinite(last)) return 0;
      if (last > 0) reach = std::min(reach, std::pow(least_share / last, 1.0 / k));
    }
  }
  return reach * units_.lane(static_cast<int>(lane));
}

double TaylorFlow::within_reach(std::size_t lane, double time) const {
  const double proved = std::min(proved_.lane(static_cast<int>(lane)), smooth_for_[lane]);
  if (std::abs(time) <= proved) return time;
  const double longest = reach(lane);
  return std::clamp(time, -longest, longest);
}

void TaylorFlow::evaluate(std::size_t lane, double time, std::span<double> state) const {
  const double in_units = time / units_.lane(static_cast<int>(lane));
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto* const z = field_.input(i);
    double sum = 0;
    for (int k = powers_[lane]; k >= 1; --k) {
      sum = (sum + z[k].lane(static_cast<int>(lane))) * in_units;
    }
    state[i] = z[0].lane(static_cast<int>(lane)) + sum;
  }
}

void TaylorFlow::advance(std::span<double> states, const ClockTime& start_time,
                         std::span<const double> times) {
  std::array<double, lanes> starts;
  starts.fill(start_time.in<double>());
  const std::size_t size = system_->dimension();
  for (std::size_t first = 0; first < times.size(); first += lanes) {
    const std::size_t count = std::min(lanes, times.size() - first);
    advance_lanes(states.subspan(first * size, count * size), std::span(starts).first(count),
                  times.subspan(first, count));
  }
}

void TaylorFlow::advance(std::span<double> states, std::span<const double> start_times,
                         std::span<const double> times) {
  const std::size_t size = system_->dimension();
  for (std::size_t first = 0; first < times.size(); first += lanes) {
    const std::size_t count = std::min(lanes, times.size() - first);
    advance_lanes(states.subspan(first * size, count * size), start_times.subspan(first, count),
                  times.subspan(first, count));
  }
}

void TaylorFlow::advance_lanes(std::span<double> states, std::span<const double> start_times,
                               std::span<const double> times) {
  constexpr int most_expansions = 1000000;
  // A step shorter than this fraction of the whole time runs into a collision.
  constexpr double least_part = 1e-9;
  const std::size_t size = system_->dimension();
  std::array<double, lanes> left{};
  std::copy(times.begin(), times.end(), left.begin());
  const auto state = [&](std::size_t lane) { return states.subspan(lane * size, size); };
  // Lanes without a state of their own repeat the first one, so that they are finite.
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t own = lane < times.size() ? lane : 0;
    set_state(lane, start_times[own], state(own), std::copysign(1.0, times[own]));
  }
  const auto is_moving = [](double time) { return time != 0; };
  for (int count = 0; std::any_of(left.begin(), left.end(), is_moving); ++count) {
    expand(left);
    for (std::size_t lane = 0; lane < times.size(); ++lane) {
      if (left[lane] == 0) continue;
      const double step = within_reach(lane, left[lane]);
      const bool is_long = std::abs(step) > least_part * std::abs(left[lane]);
      if (!(is_long || ends_at_break(lane, step)) || count == most_expansions) {
        std::fill_n(state(lane).begin(), size, std::numeric_limits<double>::quiet_NaN());
        left[lane] = 0;
        continue;
      }
      evaluate(lane, step, state(lane));
      left[lane] -= step;
      set_state(lane, start_times[lane] + (times[lane] - left[lane]), state(lane),
                std::copysign(1.0, times[lane]));
    }
  }
}

}  // namespace hamjet
