#pragma once

#include <cstddef>
#include <optional>

#include "arc_integrator.hpp"

namespace hamjet {

/// The largest number of arcs that a plan chooses by itself: with more, the serial part, the
/// nominal, would take most of the time.
inline constexpr std::size_t most_chosen_arcs = 32;

/// The costs on which a plan is based, in multiply-adds.
struct ArcCosts {
  double nominal = 0;      ///< cost of a step of the nominal
  double step = 0;         ///< cost of a step of the unsplit jet, including its nominal
  double first_arc = 0;    ///< cost of a step of the first arc
  double later_arcs = 0;   ///< cost of a step of the other arcs, in which all components vary
  double composition = 0;  ///< cost of one composition
};

/// The plan for `asked` arcs or, without a number, for the number that pays.
ArcPlan make_arc_plan(const std::optional<std::size_t>& asked, long steps, const ArcCosts& costs);

}  // namespace hamjet
