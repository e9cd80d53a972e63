#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
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

/// The deputy's coefficients in a scene with air and light; each that is not its own is NaN.
std::array<double, 2> of_deputy(const std::string& chief, const std::string& deputy) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Scene scene = scene_with(
      air + "\nradiation = true",
      fmt::format("[spacecraft]\n{}\n[deputy]\nposition_m = [0, 1, 0]\nspacecraft = {{ {} }}\n",
                  chief, deputy));
  return {scene.deputy->drag_m2_kg.value_or(none), scene.deputy->radiation_m2_kg.value_or(none)};
}

// C_D A / m and C_R A / m by hand, from what the deputy gives and otherwise the chief.
TEST(SpacecraftSlips, WhatADeputyLeavesOutIsItsChiefs) {
  const std::string chief =
      "mass_kg = 4\narea_m2 = 0.04\nsunlit_area_m2 = 0.08\ndrag_coefficient = 3\n"
      "reflection_coefficient = 1.9";
  const auto expect = [&](const std::string& deputy, double drag, double radiation) {
    const auto told = of_deputy(chief, deputy);
    EXPECT_DOUBLE_EQ(told[0], drag) << deputy;
    EXPECT_DOUBLE_EQ(told[1], radiation) << deputy;
  };
  expect("mass_kg = 4, area_m2 = 0.04", 3 * 0.04 / 4, 1.9 * 0.08 / 4);
  expect("area_m2 = 0.05", 3 * 0.05 / 4, 1.9 * 0.08 / 4);
  expect("mass_kg = 2", 3 * 0.04 / 2, 1.9 * 0.08 / 2);
  EXPECT_DOUBLE_EQ(of_deputy(chief, "drag_coefficient = 2")[0], 2 * 0.04 / 4);
  EXPECT_DOUBLE_EQ(of_deputy(chief, "sunlit_area_m2 = 0.02")[1], 1.9 * 0.02 / 4);
  // One area for both.
  const auto one = of_deputy("mass_kg = 4\narea_m2 = 0.04", "area_m2 = 0.06");
  EXPECT_DOUBLE_EQ(one[0], 2.2 * 0.06 / 4);
  EXPECT_DOUBLE_EQ(one[1], 1.3 * 0.06 / 4);
}

TEST(SpacecraftSlips, OfTablesOfDensitiesAreWarnedOf) {
  const auto table = [](const std::string& heights, const std::string& densities) {
    return fmt::format("atmosphere = \"table\"\nheights_km = [{}]\ndensities_kg_m3 = [{}]", heights,
                       densities);
  };
  const std::string craft = "[spacecraft]\ndrag_m2_kg = 0.02\n";
  expect_warned(table("100, 200, 900, 1000", "5e-7, 2.5e-10, 1e-15, 8e-16"), craft,
                "heights too far apart");
  expect_warned(table("100, 150, 180, 200", "5e-7, 2e-9, 5e-10, 2.5e-10"), craft,
                "got heights from 100 to 200 km beside a perigee");
  EXPECT_TRUE(scene_with(table("200, 300, 400, 500, 600, 700",
                               "2.5e-10, 2e-11, 3e-12, 5e-13, 1e-13, 3e-14"),
                         craft)
                  .warnings.empty());
}

}  // namespace
}  // namespace hamjet
