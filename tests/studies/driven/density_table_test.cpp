#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "dynamics/fields/exponential_atmosphere.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "low_orbit_text.hpp"
#include "studies/exact_flow.hpp"
#include "support/temporary_directory.hpp"

// Air of a table of the scene's. Expected: the shipped table given as one, and the closed form of a
// circle in air whose density is an exponential.

namespace hamjet {
namespace {

/// 514 km above the equator.
Scene scene_in(const std::string& air, const std::string& file = "table.toml") {
  return io::parse_scene(low_orbit_text(air, 0.02, 0.1) + "[jet]\norder = 1\nduration_s = 20000\n",
                         file);
}

std::vector<double> end_of(const Scene& scene) {
  return exact_flow(make_system(scene), scene.nominal, scene.start_time, scene.duration);
}

TEST(DensityTable, TheShippedTableGivenAsOne) {
  const DensityTable table = exponential_table();
  std::string rows = "density_kg_m3,height_km\n";
  for (std::size_t i = 0; i < table.heights_km.size(); ++i) {
    rows += fmt::format("{},{}\n", table.densities[i], table.heights_km[i]);
  }
  const test::TemporaryDirectory directory;
  test::put(directory.path() / "air.csv", rows);
  const Scene shipped = scene_in("atmosphere = \"exponential\"");
  const Scene of_file = scene_in("atmosphere = \"table\"\ndensity_file = \"air.csv\"",
                                 (directory.path() / "table.toml").string());
  const Scene of_arrays =
      scene_in(fmt::format("atmosphere = \"table\"\nheights_km = [{}]\ndensities_kg_m3 = [{}]",
                           fmt::join(table.heights_km, ", "), fmt::join(table.densities, ", ")));
  EXPECT_EQ(of_file.warnings, shipped.warnings);
  EXPECT_EQ(end_of(shipped), end_of(of_file));
  EXPECT_EQ(end_of(shipped), end_of(of_arrays));
  const Scene denser = scene_in(
      "atmosphere = \"table\"\nheights_km = [100, 400, 500, 700]\n"
      "densities_kg_m3 = [6e-7, 1e-11, 2e-12, 1e-13]");
  EXPECT_NE(end_of(shipped), end_of(denser));
}

// Logarithms on a line have that line as their spline, above the highest node too: rho = rho_0
// exp(-(h - h_0) / H). A circle then falls by 2 pi B rho a^2 (1 - w / n)^2 a revolution in air that
// turns at the rate w.
TEST(DensityTable, CirclesFallAsTheClosedFormSays) {
  constexpr double density = 4e-13, scale_km = 60;  // at 514 km
  const auto at = [](double height) { return density * std::exp((514 - height) / scale_km); };
  Scene scene =
      scene_in(fmt::format("atmosphere = \"table\"\nheights_km = [350, 400, 420, 450]\n"
                           "densities_kg_m3 = [{:.17g}, {:.17g}, {:.17g}, {:.17g}]",
                           at(350), at(400), at(420), at(450)));
  scene.system.earth->degree = scene.system.earth->order = 0;
  const double radius_m = std::hypot(scene.nominal[0], scene.nominal[1], scene.nominal[2]) *
                          scene.units.length_km * 1e3;
  const double rate = std::sqrt(scene.system.mu_km3_s2 * 1e9 / std::pow(radius_m, 3));
  scene.duration = 2 * std::numbers::pi / rate / scene.units.time_s;
  const std::vector<double> z = end_of(scene);
  const double energy =
      (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]) / 2 - 1 / std::hypot(z[0], z[1], z[2]);
  const std::vector<double>& y = scene.nominal;
  const double before =
      (y[3] * y[3] + y[4] * y[4] + y[5] * y[5]) / 2 - 1 / std::hypot(y[0], y[1], y[2]);
  const double fall_m = (1 / (2 * before) - 1 / (2 * energy)) * scene.units.length_km * 1e3;
  const double slip = 1 - 7.292115e-5 / rate;
  const double expected = 2 * std::numbers::pi * 0.02 * density * radius_m * radius_m * slip * slip;
  // The height changes by a part of the fall meanwhile, the inclination is a tenth of a degree.
  EXPECT_NEAR(fall_m, -expected, 1e-3 * expected);
}

}  // namespace
}  // namespace hamjet
