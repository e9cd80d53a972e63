#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/flow.hpp"

// The order of convergence by a least-squares fit over fixed steps, on the paper's orbit.

namespace hamjet {
namespace {

struct Point {
  double step;
  double error;
};

/// Slope of log(error) over log(step).
double fitted_slope(const std::vector<Point>& points) {
  double mean_x = 0;
  double mean_y = 0;
  const auto count = static_cast<double>(points.size());
  for (const Point& p : points) {
    mean_x += std::log(p.step) / count;
    mean_y += std::log(p.error) / count;
  }
  double covariance = 0;
  double variance = 0;
  for (const Point& p : points) {
    covariance += (std::log(p.step) - mean_x) * (std::log(p.error) - mean_y);
    variance += std::pow(std::log(p.step) - mean_x, 2);
  }
  return covariance / variance;
}

/// Where the leading term of the error rules, above the rounding floor.
struct Window {
  double lowest;
  double highest;
  int first_count;  ///< of steps
};

template <class Real>
void expect_order(int stages, double duration, const Window& window) {
  auto flow = test::flow_of<Extended>(test::paper_orbit(), 2);
  flow.duration = duration;
  const auto reference = test::run_gauss(flow, test::adaptive(16, 1e-26));
  auto tested = test::flow_of<Real>(test::paper_orbit(), 2);
  tested.duration = Real(duration);
  std::vector<Point> points[3];
  for (int count = window.first_count; count <= 4096; count += std::max(1, count / 4)) {
    const double step = duration / count;
    const auto jet = test::run_gauss(tested, test::fixed_step(stages, step));
    bool is_below = true;
    for (int degree = 0; degree <= 2; ++degree) {
      const double error = test::relative_error(jet, reference, degree);
      is_below = is_below && error < window.lowest;
      if (error > window.lowest && error < window.highest) points[degree].push_back({step, error});
    }
    if (is_below || points[0].size() > 12) break;
  }
  for (int degree = 0; degree <= 2; ++degree) {
    ASSERT_GE(points[degree].size(), 3u) << "degree " << degree;
    EXPECT_NEAR(fitted_slope(points[degree]), 2 * stages, 0.3)
        << stages << " stages, degree " << degree << ", " << points[degree].size() << " points";
  }
}

TEST(GaussOrder, IsTwiceTheNumberOfStagesOnEveryDegree) {
  // Low orders show theirs from perigee in one unit of time, higher ones need a span of many steps.
  expect_order<double>(1, 1, {1e-12, 1e-2, 4});
  expect_order<double>(2, 1, {1e-12, 1e-2, 4});
  expect_order<double>(3, 10, {1e-12, 1e-2, 20});
  expect_order<double>(4, 10, {1e-12, 1e-2, 20});
  // In double precision the range of order 12 is too short to fit.
  expect_order<Extended>(6, 10, {1e-22, 1e-10, 25});
}

}  // namespace
}  // namespace hamjet
