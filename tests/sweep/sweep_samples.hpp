#pragma once

#include <filesystem>
#include <string>

#include "support/scenes.hpp"
#include "support/temporary_directory.hpp"

// A study of 12 items on a scene that takes milliseconds.

namespace hamjet::test {

inline const std::string sweep_scene =
    short_kepler_scene("base") + "[generating_function]\nkinds = [\"F1\"]\n";

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
  put(file, text);
  return file;
}

}  // namespace hamjet::test
