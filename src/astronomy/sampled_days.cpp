#include "sampled_days.hpp"

#include <erfa.h>
#include <erfam.h>
#include <fmt/format.h>

#include <cmath>

#include "hamjet/error.hpp"

namespace hamjet {

PiecewiseHermite sampled_days(const Instant& epoch, const Extended& unit_s, double first,
                              double last, std::size_t components, const FunctionOfDate& function) {
  constexpr double step = 0.25;
  constexpr std::size_t reach = 5;
  constexpr double beyond = days_beyond_span / step + static_cast<double>(reach);
  // Times may run backwards.
  const double unit_days = convert<double>(unit_s) / ERFA_DAYSEC;
  const double from = std::floor(std::min(first, last) * unit_days / step) - beyond;
  const double to = std::ceil(std::max(first, last) * unit_days / step) + beyond;
  if (!(to - from < 1e7)) {
    throw Error(
        ErrorKind::too_large,
        fmt::format("positions of Sun, Moon and pole for {:.3g} days, must be for less than "
                    "2.5 million",
                    (to - from) * step));
  }
  const JulianDate date = julian_date(epoch.tt, TimeSystem::tt);
  std::vector<double> nodes;
  std::vector<std::vector<double>> values(components);
  std::vector<double> at_node(components);
  for (double i = from; i <= to; ++i) {
    nodes.push_back(i * step);
    function(date.day, date.fraction + nodes.back(), at_node.data());
    for (std::size_t c = 0; c < components; ++c) values[c].push_back(at_node[c]);
  }
  return PiecewiseHermite(std::move(nodes), values, reach, unit_s / Extended(ERFA_DAYSEC));
}

void require_within_span(double t, double first, double last, double unit_s) {
  const double beyond = days_beyond_span * ERFA_DAYSEC / unit_s;
  const auto [low, high] = std::minmax(first, last);
  if (t >= low - beyond && t <= high + beyond) return;
  throw Error(
      ErrorKind::numerical,
      fmt::format("axes and bodies of the Earth are known from {:.9g} s to {:.9g} s after the "
                  "epoch, got {:.9g} s",
                  low * unit_s, high * unit_s, t * unit_s));
}

}  // namespace hamjet
