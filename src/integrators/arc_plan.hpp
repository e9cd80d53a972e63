#pragma once

#include <cstddef>
#include <optional>

#include "arc_integrator.hpp"

namespace hamjet {

/// The most arcs that a plan chooses by itself: with more, the serial part, the nominal, would be
/// most of the time.
inline constexpr std::size_t most_chosen_arcs = 32;

/// The costs that a plan weighs, in multiply-adds.
struct ArcCosts {
  double nominal = 0;      ///< a step of the nominal
  double step = 0;         ///< a step of the unsplit jet, its nominal included
  double first_arc = 0;    ///< a step of the first arc
  double later_arcs = 0;   ///< a step of the others, which vary in all components
  double composition = 0;  ///< one composition
};

/// The plan for `asked` arcs, or without that for as many as pay.
ArcPlan make_arc_plan(const std::optional<std::size_t>& asked, long steps, const ArcCosts& costs);

}  // namespace hamjet
