#pragma once

namespace hamjet {

/// An ellipsoid of revolution about the z axis from which heights are counted; WGS 84 by default
/// (NIMA TR8350.2). The polar radius is equatorial_radius_km (1 - flattening).
struct ReferenceEllipsoid {
  double equatorial_radius_km = 6378.137;
  double flattening = 1 / 298.257223563;
};

}  // namespace hamjet
