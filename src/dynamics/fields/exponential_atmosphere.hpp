#pragma once

#include <vector>

#include "density_profile.hpp"

namespace hamjet {

/// The atmosphere of textbooks, rho = density exp(-(h - base) / scale height) from each base height
/// to the next: U.S. Standard Atmosphere 1976 at the ground, CIRA-72 from 25 km on.
///
/// Source: D. A. Vallado, Fundamentals of Astrodynamics and Applications, 4th ed., 2013, table 8-4.
struct ExponentialAtmosphere {
  std::vector<double> base_heights_km;
  std::vector<double> densities;  // In kg/m^3.
  std::vector<double> scale_heights_km;
};

ExponentialAtmosphere exponential_atmosphere();

/// Its densities at the base heights, and at 1100 km, which gives a table the slope above 1000 km.
DensityTable exponential_table();

}  // namespace hamjet
