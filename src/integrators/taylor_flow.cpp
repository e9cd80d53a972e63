#include "taylor_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hamjet {

TaylorFlow::TaylorFlow(SharedSystem system)
    : system_(std::move(system)),
      field_(system_->vector_field, SeriesSpace::create(1, order), order) {}

void TaylorFlow::set_state(std::size_t lane, std::span<const double> state) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    field_.input(i)->set_lane(static_cast<int>(lane), state[i]);
  }
}

void TaylorFlow::expand() {
  const std::size_t size = system_->dimension();
  field_.evaluate_constant_terms();
  for (int k = 0; k < order; ++k) {
    if (k > 0) {
      field_.evaluate_remainder(k);
      field_.complete(k);
    }
    const double factor = 1.0 / (k + 1);
    for (std::size_t i = 0; i < size; ++i) field_.input(i)[k + 1] = field_.output(i)[k] * factor;
  }
}

double TaylorFlow::reach(std::size_t lane) const {
  const std::size_t n = system_->degrees_of_freedom;
  double reach = std::numeric_limits<double>::infinity();
  // Positions and momenta have units of their own. Both of the last powers are looked at, for one
  // may vanish by symmetry.
  for (const std::size_t first : {std::size_t{0}, n}) {
    for (const int k : {order - 1, order}) {
      double whole = 0;
      double last = 0;
      for (std::size_t i = first; i < first + n; ++i) {
        const auto* const z = field_.input(i);
        whole = std::max(whole, std::abs(z[0].lane(static_cast<int>(lane))));
        const double size = std::abs(z[k].lane(static_cast<int>(lane)));
        if (!std::isfinite(size)) return 0;
        last = std::max(last, size);
      }
      if (last > 0) {
        const double ratio = 0.25 * std::numeric_limits<double>::epsilon() * whole / last;
        reach = std::min(reach, std::pow(ratio, 1.0 / k));
      }
    }
  }
  return reach;
}

void TaylorFlow::evaluate(std::size_t lane, double time, std::span<double> state) const {
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto* const z = field_.input(i);
    double sum = 0;
    for (int k = order; k >= 1; --k) sum = (sum + z[k].lane(static_cast<int>(lane))) * time;
    state[i] = z[0].lane(static_cast<int>(lane)) + sum;
  }
}

void TaylorFlow::advance(std::span<double> states, std::span<const double> times) {
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
    expand();
    for (std::size_t lane = 0; lane < times.size(); ++lane) {
      if (left[lane] == 0) continue;
      const double longest = reach(lane);
      const double step = std::clamp(left[lane], -longest, longest);
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
