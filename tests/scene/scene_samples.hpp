#pragma once

#include <gtest/gtest.h>

#include <hamjet/error.hpp>
#include <hamjet/scene/scene_reader.hpp>
#include <stdexcept>
#include <string>
#include <vector>

// Good scenes to break, and what a test says about the error that follows.

namespace hamjet::io {

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

inline constexpr const char* oscillator = R"(schema = 1
title = "oscillator"
[system]
model = "harmonic-oscillator"
[nominal]
position_m = [1]
momentum_kg_m_s = [0]
[jet]
order = 1
duration_canonical = 1
[[integrator]]
label = "a"
method = "gauss"
tolerance = 1e-14
)";

/// A text in place of another one, which must be there.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t position = text.find(from);
  if (position == std::string::npos) throw std::logic_error("not in the scene: " + from);
  return text.replace(position, from.size(), to);
}

/// Reads the scene, which must fail with `kind` and a message of one printable line that holds
/// every one of `words`.
template <class Read>
void expect_error(const Read& read, ErrorKind kind, const std::vector<std::string>& words,
                  const std::string& about) {
  SCOPED_TRACE(about.substr(0, 200));
  try {
    read();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.kind(), kind) << message;
    for (const std::string& word : words) {
      EXPECT_NE(message.find(word), std::string::npos) << message << "\nlacks " << word;
    }
    EXPECT_EQ(message.find_first_of(std::string("\n\r\t\x1b\0", 5)), std::string::npos) << message;
    EXPECT_LT(message.size(), 700U);
  }
}

inline void expect_scene_error(const std::string& text, const std::vector<std::string>& words,
                               ErrorKind kind = ErrorKind::scene) {
  expect_error([&] { parse_scene(text, "file.toml"); }, kind, words, text);
}

}  // namespace hamjet::io
