#pragma once

#include <cmath>
#include <memory>

#include "dynamics/fields/atmosphere_field.hpp"

namespace hamjet::test {

/// The radius of the air's body, a sphere, which is the unit of length.
inline constexpr double air_radius_km = 6378.137;

/// Air whose density falls exponentially from the lowest height on: a table that falls by one ratio
/// from node to node is an exponential between them too.
inline std::shared_ptr<const AtmosphereField> exponential_air(double lowest_km, double density,
                                                              double scale_height_km) {
  DensityTable table;
  for (int k = 0; k <= 8; ++k) {
    table.heights_km.push_back(lowest_km + 50.0 * k);
    table.densities.push_back(density * std::exp(-50.0 * k / scale_height_km));
  }
  return std::make_shared<const AtmosphereField>(table, air_radius_km, 1,
                                                 ReferenceEllipsoid{air_radius_km, 0});
}

}  // namespace hamjet::test
