#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// Numbers of stages of two runs that are independent of a jet; different stages lead to different
/// steps.
inline constexpr std::array<int, 2> stages_of_runs = {16, 15};
/// The same where forces have seams, such as densities from a table at its heights. There a step is
/// wrong by about its last mode, not by the square of it, and what counts is how close the stages
/// are. For a last mode m that is about s m^(-1/s) of the time scale: fewer stages are closer.
inline constexpr std::array<int, 2> stages_across_seams = {9, 7};

/// The settings of one of the two runs. With them the last mode is at most 1e-12 across seams,
/// whose estimate squares it: two digits above its rounding in double precision.
template <class Real>
GaussSettings gauss_of_independent_run(std::size_t number, bool has_smooth_forces) {
  const auto tolerance = 4 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  constexpr double across_seams = 1e-22;
  GaussSettings settings;
  settings.stages = has_smooth_forces ? stages_of_runs[number] : stages_across_seams[number];
  settings.tolerance = has_smooth_forces ? tolerance : std::min(tolerance, across_seams);
  settings.controls_all_degrees = true;
  return settings;
}

}  // namespace hamjet
