#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "support/errors.hpp"
#include "support/scenes.hpp"
#include "support/text.hpp"

// Good scenes for tests to break, and checks of the error that follows.

namespace hamjet::io {

/// A circle with exact conversions: the units are 4 km, 8 s and 500 m/s, and a revolution
/// takes 2 pi canonical.
inline constexpr const char* circle_scene = R"(schema = 1
title = "circle"
[system]
model = "kepler"
mu_km3_s2 = 1
[nominal]
position_km = [4, 0, 0]
velocity_km_s = [0, 0.5, 0]
[jet]
order = 3
duration_s = 64
[[integrator]]
label = "a"
method = "gauss"
tolerance = 1e-12
)";

inline constexpr const char* orbit = R"(schema = 1
title = "orbit"
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378
J2 = 1e-3
[nominal]
position_km = [7000, 0, 0]
velocity_km_s = [0, 7.5, 1]
[jet]
order = 4
duration_canonical = 31.4
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
tolerance = 1e-14
[[integrator]]
label = "other"
method = "fehlberg78"
step_canonical = 0.01
[formation]
separation_km = 10
[generating_function]
kinds = ["F1"]
[reference]
)";

inline const std::string oscillator = R"(schema = 1
title = "oscillator"
)" + test::oscillator_tables + R"([jet]
order = 1
duration_canonical = 1
[[integrator]]
label = "a"
method = "gauss"
tolerance = 1e-14
)";

using test::changed;
using test::expect_error;

/// The scene must be refused, see expect_error.
inline void expect_scene_error(const std::string& text, const std::vector<std::string>& words,
                               ErrorKind kind = ErrorKind::scene) {
  expect_error([&] { parse_scene(text, "file.toml"); }, kind, words, text);
}

}  // namespace hamjet::io
