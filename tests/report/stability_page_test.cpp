#include "../../src/report/stability/stability_page.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "plot_program.hpp"

// stability.html.

namespace hamjet::io {
namespace {

TEST(StabilityPage, SaysWhichErrorsAreFarBelowTheirFloor) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  StabilityCase subject{"case", "a case", "group", "why", {}, Scene()};
  StabilityResult result;
  result.subject = &subject;
  result.measured = {{"state", 0, 1e-16}, {"matrix", 1e-20, 1e-16}, {"state", 1e-16, 2e-16}};
  ChartDrawer drawer("gnuplot");
  const std::string page = stability_page({result}, {}, drawer);
  EXPECT_NE(page.find("Errors below 0.001 of their floor, zeros too, are drawn at it: 2."),
            std::string::npos);
}

TEST(StabilityPage, GrowthIsDrawnAlongDaysAndRevolutions) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  Scene scene;
  scene.system.model = SystemModel::kepler;
  scene.system.mu_km3_s2 = 398600.4415;
  scene.units = {7000, 1000};
  scene.nominal = {1, 0, 0, 0, 1, 0};
  StabilityCase subject{"case", "a case", "group", "why", {}, scene};
  StabilityResult result;
  result.subject = &subject;
  // 2 to 200 revolutions of 2 pi thousand seconds.
  const double turn = 2 * std::numbers::pi;
  result.growth = {{"state error", {{2 * turn, 1e-15}, {200 * turn, 1e-12}}, 1.5, 1.5}};
  ChartDrawer drawer("gnuplot");
  const std::string page = stability_page({result}, {}, drawer);
  EXPECT_NE(page.find("time (days)"), std::string::npos);
  EXPECT_NE(page.find("revolutions"), std::string::npos);
  EXPECT_EQ(page.find("time (canonical)"), std::string::npos);
  // Decades of revolutions, as the days beside them.
  EXPECT_NE(page.find(">100<"), std::string::npos);
}

}  // namespace
}  // namespace hamjet::io
