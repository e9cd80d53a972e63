#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "support/temporary_directory.hpp"

// A study of 12 items on a scene that takes milliseconds.

namespace hamjet::test {

inline constexpr const char* sweep_scene = R"(schema = 1
title = "base"
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
a_km = 10000
e = 0.1
i_deg = 30
raan_deg = 10
argp_deg = 20
ta_deg = 30
[jet]
order = 2
duration_canonical = 1
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
tolerance = 1e-13
[generating_function]
kinds = ["F1"]
)";

inline constexpr const char* sweep_study = R"(schema = 1
title = "twelve orbits"
[sweep]
scene = "base.toml"
command = "run"
[sweep.set]
jet.order = 1
[[axis]]
key = "nominal.e"
from = 0.0
to = 0.9
count = 4
[[axis]]
key = "nominal.i_deg"
values = [0, 30, 90.5]
[[column]]
name = "condition"
value = "/runs/gauss8/exactness/0/condition"
[[column]]
name = "x_final"
unit = "length"
value = "/runs/0/nominal_final/0"
[map]
x = "nominal.e"
y = "nominal.i_deg"
value = "condition"
scale = "logarithmic"
)";

/// Writes a text file and returns its path.
inline std::filesystem::path write_text(const std::filesystem::path& file,
                                        const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

inline std::string text_in(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace hamjet::test
