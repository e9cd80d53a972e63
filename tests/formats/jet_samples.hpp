#pragma once

#include <string>

#include "support/scenes.hpp"

namespace hamjet::io {

/// Kepler's problem in the plane, order 2, by two integrators.
inline const std::string planar_kepler = R"(schema = 1
title = "kepler"
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
position_km = [7000, 0, 0]
velocity_km_s = [0.5, 7.5, 0]
[jet]
order = 2
duration_canonical = 0.7
)" + test::gauss8("tolerance = 1e-14") + R"([[integrator]]
label = "midpoint"
method = "gauss"
stages = 1
step_canonical = 0.1
)";

}  // namespace hamjet::io
