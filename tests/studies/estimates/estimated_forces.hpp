#pragma once

#include <fmt/format.h>

#include <cmath>

#include "estimated_scenes.hpp"
#include "hamjet/scene/scene_reader.hpp"

// Random orbits of the real Earth in air and light, where steps are hardest: perigees about 150 km
// up, and arcs over the edges of the shadow, to compare their estimated errors with the true ones.

namespace hamjet::test {

/// Half of the scenes dive to a perigee of 140 to 170 km, of which half are lit too; the others are
/// lit alone, low or geostationary about an equinox. Of some the jet is also in a parameter.
inline Scene estimated_in_forces(std::uint64_t seed) {
  Draw draw(seed);
  const bool dives = draw.one_in(2);
  const bool is_lit = !dives || draw.one_in(2);
  const bool is_high = !dives && draw.one_in(3);
  std::string system = fmt::format(
      "[system]\nmodel = \"earth\"\ngravity_degree = {}\n"
      "moon = {}\nsun = true\n",
      draw.whole(2, 4), draw.one_in(2));
  std::string spacecraft = "[spacecraft]\n";
  if (dives) {
    system +=
        fmt::format("atmosphere = \"{}\"\n", draw.one_in(4) ? "exponential" : "harris-priester");
    spacecraft += fmt::format("drag_m2_kg = {}\n", draw.decades(1e-3, 0.1));
  }
  if (is_lit) {
    system += "radiation = true\n";
    spacecraft += fmt::format("radiation_m2_kg = {}\n", draw.decades(1e-3, 0.5));
  }
  std::string nominal;
  if (dives) {
    const double perigee = draw.between(140, 170);
    nominal = fmt::format("perigee_height_km = {}\napogee_height_km = {}\nargp_deg = {}\n", perigee,
                          perigee + draw.decades(10, 2e4), draw.between(-180, 180));
  } else if (is_high) {
    nominal = fmt::format("a_km = {}\ne = {}\nargp_deg = {}\n", draw.between(42100, 42200),
                          draw.decades(1e-5, 1e-2), draw.between(-180, 180));
  } else {
    nominal = fmt::format("a_km = {}\ne = {}\nargp_deg = {}\n", draw.between(6900, 9000),
                          draw.decades(1e-5, 1e-2), draw.between(-180, 180));
  }
  nominal += fmt::format("i_deg = {}\nraan_deg = {}\nta_deg = {}\n",
                         is_high ? draw.between(0, 2) : draw.between(1, 179),
                         draw.between(-180, 180), draw.between(-180, 180));
  const int day = is_high ? draw.whole(70, 90) : draw.whole(1, 365);
  const double orbits = draw.one_in(3) ? draw.between(0.05, 0.5) : draw.between(0.5, 1.5);
  std::string variables;
  if (draw.one_in(3)) {
    variables =
        fmt::format("variables = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\", \"{}\"]\n",
                    dives ? (draw.one_in(2) ? "drag_m2_kg" : "density_factor") : "radiation_m2_kg");
  }
  const int order = draw.one_in(6) ? 3 : draw.whole(1, 2);
  Scene scene = io::parse_scene(
      system + spacecraft +
          fmt::format("[nominal]\nepoch_utc = \"{}-{:03d}T{:02d}:00:00\"\n{}[jet]\norder = {}\n"
                      "duration_orbits = {}\n{}",
                      draw.whole(1990, 2030), day, draw.whole(0, 23), nominal, order,
                      draw.one_in(8) ? -orbits : orbits, variables),
      "forces.toml");
  scene.name = "seed-" + std::to_string(seed);
  scene.reference = ReferenceSettings{1e-20};
  return scene;
}

}  // namespace hamjet::test
