#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hamjet/scene/scene_reader.hpp"
#include "support/errors.hpp"

// Slips in what a scene says of the air and of its spacecraft.

namespace hamjet {
namespace {

std::string text_of(const std::string& forces, const std::string& spacecraft) {
  return fmt::format(R"(schema = 1
[system]
model = "earth"
gravity_degree = 2
{}
[nominal]
epoch_utc = "2023-05-16T06:00:00"
height_km = 514
i_deg = 97.5
raan_deg = 30
u_deg = 0
[jet]
order = 1
duration_s = 600
{})",
                     forces, spacecraft);
}

const std::string air = "atmosphere = \"harris-priester\"";

Scene scene_with(const std::string& forces, const std::string& spacecraft) {
  return io::parse_scene(text_of(forces, spacecraft), "file.toml");
}

void expect_warned(const std::string& forces, const std::string& spacecraft,
                   const std::string& words) {
  std::string told;
  for (const std::string& warning : scene_with(forces, spacecraft).warnings) told += warning + "\n";
  EXPECT_NE(told.find(words), std::string::npos) << spacecraft << "\n" << told;
}

TEST(SpacecraftSlips, AreWarnedOf) {
  const auto of = [](const std::string& keys) { return "[spacecraft]\n" + keys + "\n"; };
  EXPECT_TRUE(scene_with(air, of("mass_kg = 4\narea_m2 = 0.03")).warnings.empty());
  expect_warned(air, of("mass_kg = 4\narea_m2 = 0.03\ndrag_coefficient = 220"),
                "of no spacecraft, got C_D = 220");
  expect_warned(air, of("mass_kg = 4000\narea_m2 = 0.03"), "is the mass in g");
  expect_warned(air, of("mass_kg = 4\narea_m2 = 300"), "is the area in cm^2");
  expect_warned(air + "\ndensity_factor = 1000", of("mass_kg = 4\narea_m2 = 0.03"),
                "density_factor: of no air of the Earth, got 1000");
}

TEST(SpacecraftSlips, OfBallisticCoefficientsAreToldTheKey) {
  for (const char* key : {"B", "ballistic_coefficient"}) {
    test::expect_error([&] { scene_with(air, fmt::format("[spacecraft]\n{} = 60\n", key)); },
                       ErrorKind::scene, {key, "must be drag_m2_kg, C_D A / m in m^2/kg"}, key);
    test::expect_error(
        [&] {
          scene_with(air,
                     fmt::format("[spacecraft]\ndrag_m2_kg = 0.02\n[deputy]\nposition_m = [0, 1, "
                                 "0]\nspacecraft = {{ {} = 60 }}\n",
                                 key));
        },
        ErrorKind::scene, {key, "must be drag_m2_kg"}, key);
  }
}

TEST(SpacecraftSlips, ASunlitAreaMayStandBesideAnother) {
  const Scene scene = scene_with("radiation = true",
                                 "[spacecraft]\nmass_kg = 2\narea_m2 = 1\nsunlit_area_m2 = 3\n"
                                 "reflection_coefficient = 1\n");
  EXPECT_DOUBLE_EQ(scene.system.earth->radiation_m2_kg, 1.5);
}

}  // namespace
}  // namespace hamjet
