#include "taylor_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hamjet {

/// The share of the whole that the last two powers may have, which need not go on falling evenly.
static constexpr double least_share = 0.25 * std::numeric_limits<double>::epsilon();

TaylorFlow::TaylorFlow(SharedSystem system)
    : system_(std::move(system)), field_(system_->vector_field, order) {}

void TaylorFlow::set_state(std::size_t lane, std::span<const double> state) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    field_.input(i)->set_lane(static_cast<int>(lane), state[i]);
  }
}

TaylorFlow::Lanes TaylorFlow::squares(int power, bool is_of_momenta) const {
  const std::size_t n = system_->degrees_of_freedom;
  Lanes sum;
  for (std::size_t i = 0; i < n; ++i) {
    const Lanes& z = field_.input(is_of_momenta ? n + i : i)[power];
    sum += z * z;
  }
  return sum;
}

TaylorFlow::Lanes TaylorFlow::last_shares(int k, const Lanes& times) const {
  const Lanes square = times * times;
  Lanes before(1);
  for (int i = 1; i < k; ++i) before *= square;
  // Positions and momenta have units of their own. Both of the last powers are looked at, for one
  // may vanish by symmetry.
  Lanes largest;
  for (const bool is_of_momenta : {false, true}) {
    const Lanes unit = before / squares(0, is_of_momenta);
    const Lanes last = squares(k, is_of_momenta) * square;
    // A sum, so that what is no number stays.
    largest += (squares(k - 1, is_of_momenta) + last) * unit;
  }
  return largest;
}

void TaylorFlow::expand(std::span<const double> times) {
  constexpr int fewest = 4;
  const std::size_t size = system_->dimension();
  const Lanes spans = Lanes::of_lanes(
      [&](std::size_t lane) { return lane < times.size() ? std::abs(times[lane]) : 0.0; });
  const std::size_t timed = std::min(times.size(), lanes);
  powers_.fill(order);
  proved_ = Lanes();
  std::size_t proved = 0;
  for (int k = 0; k < order; ++k) {
    field_.expand(k);
    const double factor = 1.0 / (k + 1);
    for (std::size_t i = 0; i < size; ++i) field_.input(i)[k + 1] = field_.output(i)[k] * factor;
    if (timed == 0 || k + 1 < fewest) continue;
    const Lanes shares = last_shares(k + 1, spans);
    for (std::size_t lane = 0; lane < timed; ++lane) {
      const auto i = static_cast<int>(lane);
      if (powers_[lane] < order || !(shares.lane(i) <= least_share * least_share)) continue;
      powers_[lane] = k + 1;
      proved_.set_lane(i, spans.lane(i));
      ++proved;
    }
    if (proved == timed) return;
  }
}

double TaylorFlow::reach(std::size_t lane) const {
  const auto of_lane = [&](int power, bool is_of_momenta) {
    return std::sqrt(squares(power, is_of_momenta).lane(static_cast<int>(lane)));
  };
  double reach = std::numeric_limits<double>::infinity();
  for (const bool is_of_momenta : {false, true}) {
    for (const int k : {powers_[lane] - 1, powers_[lane]}) {
      const double last = of_lane(k, is_of_momenta);
      if (!std::isfinite(last)) return 0;
      if (last > 0) {
        reach = std::min(reach, std::pow(least_share * of_lane(0, is_of_momenta) / last, 1.0 / k));
      }
    }
  }
  return reach;
}

double TaylorFlow::within_reach(std::size_t lane, double time) const {
  if (std::abs(time) <= proved_.lane(static_cast<int>(lane))) return time;
  const double longest = reach(lane);
  return std::clamp(time, -longest, longest);
}

void TaylorFlow::evaluate(std::size_t lane, double time, std::span<double> state) const {
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto* const z = field_.input(i);
    double sum = 0;
    for (int k = powers_[lane]; k >= 1; --k) sum = (sum + z[k].lane(static_cast<int>(lane))) * time;
    state[i] = z[0].lane(static_cast<int>(lane)) + sum;
  }
}

void TaylorFlow::advance(std::span<double> states, std::span<const double> times) {
  const std::size_t size = system_->dimension();
  for (std::size_t first = 0; first < times.size(); first += lanes) {
    const std::size_t count = std::min(lanes, times.size() - first);
    advance_lanes(states.subspan(first * size, count * size), times.subspan(first, count));
  }
}

void TaylorFlow::advance_lanes(std::span<double> states, std::span<const double> times) {
  constexpr int most_expansions = 1000000;
  // A step that is this much shorter than the whole time runs into a collision.
  constexpr double least_part = 1e-9;
  const std::size_t size = system_->dimension();
  std::array<double, lanes> left{};
  std::copy(times.begin(), times.end(), left.begin());
  const auto state = [&](std::size_t lane) { return states.subspan(lane * size, size); };
  // Lanes without a state of their own repeat the first, so that they are finite.
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    set_state(lane, state(lane < times.size() ? lane : 0));
  }
  const auto is_moving = [](double time) { return time != 0; };
  for (int count = 0; std::any_of(left.begin(), left.end(), is_moving); ++count) {
    expand(left);
    for (std::size_t lane = 0; lane < times.size(); ++lane) {
      if (left[lane] == 0) continue;
      const double step = within_reach(lane, left[lane]);
      if (!(std::abs(step) > least_part * std::abs(left[lane])) || count == most_expansions) {
        std::fill_n(state(lane).begin(), size, std::numeric_limits<double>::quiet_NaN());
        left[lane] = 0;
        continue;
      }
      evaluate(lane, step, state(lane));
      left[lane] -= step;
      set_state(lane, state(lane));
    }
  }
}

}  // namespace hamjet
