#pragma once

#include <numbers>

#include "density_profile.hpp"

namespace hamjet {

/// The least and the greatest density of the upper atmosphere in the course of a day, for mean
/// solar flux, from 100 to 1000 km.
///
/// Source: O. Montenbruck and E. Gill, Satellite Orbits, Springer 2000, section 3.5, after A. C.
/// Long et al., Goddard Trajectory Determination System Mathematical Theory, 1989, and I. Harris
/// and W. Priester, J. Atmos. Sci. 19 (1962) 286.
struct HarrisPriesterTable {
  DensityTable minimum;
  DensityTable maximum;
};

HarrisPriesterTable harris_priester_table();

/// The angle by which the greatest density follows the Sun: two hours (the same section).
inline constexpr double harris_priester_lag = std::numbers::pi / 6;

}  // namespace hamjet
