#include "../../src/report/stability/stability_page.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace hamjet::io
