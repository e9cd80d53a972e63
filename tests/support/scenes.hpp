#pragma once

#include <string>

// Tables of which scenes of several tests consist.

namespace hamjet::test {

/// The harmonic oscillator, which starts at q = 1 with p = 0.
inline const std::string oscillator_tables = R"([system]
model = "harmonic-oscillator"
[nominal]
position_m = [1]
momentum_kg_m_s = [0]
)";

/// The double well of the paper.
inline const std::string double_well_tables = R"([system]
model = "double-well"
[nominal]
position_m = [1]
momentum_kg_m_s = [0.05]
)";

/// The start of an orbit about the Earth.
inline const std::string orbit_elements = R"([nominal]
a_km = 10000
e = 0.1
i_deg = 30
raan_deg = 10
argp_deg = 20
ta_deg = 30
)";

/// Kepler's problem with mu = 1 from the perigee of an ellipse with a = 1 and e = 0.9.
inline const std::string perigee_tables = R"([system]
model = "kepler"
mu_km3_s2 = 1
[units]
length_km = 1
[nominal]
position_km = [0.1, 0, 0]
velocity_km_s = [0, 4.358898943540674, 0]
)";

/// The integrator with eight stages; the limit is the tolerance or the step.
inline std::string gauss8(const std::string& limit) {
  return "[[integrator]]\nlabel = \"gauss8\"\nmethod = \"gauss\"\nstages = 8\n" + limit + "\n";
}

/// A scene that takes milliseconds: Kepler's problem, order 2, a seventh of a revolution.
inline std::string short_kepler_scene(const std::string& title) {
  return "schema = 1\ntitle = \"" + title + "\"\n" + R"([system]
model = "kepler"
mu_km3_s2 = 398600.4415
)" + orbit_elements +
         R"([jet]
order = 2
duration_canonical = 1
)" + gauss8("tolerance = 1e-13");
}

}  // namespace hamjet::test
