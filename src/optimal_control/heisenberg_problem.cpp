#include "heisenberg_problem.hpp"

#include <cmath>
#include <numbers>

namespace hamjet {

HeisenbergChange heisenberg_change(std::span<const double> start,
                                   std::span<const std::optional<double>> end) {
  const double dx = end[0].value_or(start[0]) - start[0];
  const double dy = end[1].value_or(start[1]) - start[1];
  return {dx, dy, end[2] ? *end[2] - start[2] - start[1] * dx + start[0] * dy : 0};
}

std::optional<ClosedFormCost> heisenberg_cost(std::span<const double> start,
                                              const std::array<std::optional<double>, 3>& end,
                                              double duration, std::size_t steps) {
  if (!end[0] || !end[1]) return std::nullopt;
  const auto [dx, dy, a] = heisenberg_change(start, end);
  if (a == 0) {
    const double cost = (dx * dx + dy * dy) / (2 * duration);
    return ClosedFormCost{cost, cost};
  }
  if (dx != 0 || dy != 0 || steps < 3) return std::nullopt;
  const auto sides = static_cast<double>(steps);
  return ClosedFormCost{std::numbers::pi * std::abs(a) / duration,
                        sides * std::tan(std::numbers::pi / sides) * std::abs(a) / duration};
}

}  // namespace hamjet
