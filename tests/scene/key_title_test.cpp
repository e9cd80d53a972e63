#include "../../src/scene/key_title.hpp"

#include <gtest/gtest.h>

// Keys as labels of axes.

namespace hamjet::io {
namespace {

TEST(KeyTitle, SaysWhatAKeyIsWithItsUnit) {
  for (const auto& [key, title] :
       {std::pair("deputy.position_m.0", "deputy position, component 1 (m)"),
        {"deputy.i_deg", "deputy inclination (degrees)"},
        {"nominal.e", "eccentricity"},
        {"nominal.a_km", "semi-major axis (km)"},
        {"nominal.u_deg", "true argument of latitude (degrees)"},
        {"nominal.perigee_height_km", "perigee height (km)"},
        {"jet.duration_orbits", "duration (orbits)"},
        {"jet.order", "order"},
        {"system.J2", "J2"},
        {"system.mu_km3_s2", "mu (km^3/s^2)"},
        {"transfer.start.velocity_m_s.2", "transfer start velocity, component 3 (m/s)"},
        {"integrator.gauss8.tolerance", "integrator gauss8 tolerance"},
        {"title", "title"}}) {
    EXPECT_EQ(key_title(key), title);
  }
}

}  // namespace
}  // namespace hamjet::io
