#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/convergence.hpp"
#include "support/flow.hpp"

// The order of convergence by a least-squares fit over fixed steps, on the paper's orbit.

namespace hamjet {
namespace {

struct Points {
  std::vector<double> steps;
  std::vector<double> errors;
};

/// The range in which the leading term of the error dominates, above the rounding floor.
struct Window {
  double lowest;
  double highest;
  int first_count;  ///< numbers of steps
};

template <class Real>
void expect_order(int stages, double duration, const Window& window) {
  auto flow = test::flow_of<Extended>(test::paper_orbit(), 2);
  flow.duration = duration;
  const auto reference = test::run_gauss(flow, test::adaptive(16, 1e-26));
  auto tested = test::flow_of<Real>(test::paper_orbit(), 2);
  tested.duration = Real(duration);
  Points points[3];
  for (int count = window.first_count; count <= 4096; count += std::max(1, count / 4)) {
    const double step = duration / count;
    const auto jet = test::run_gauss(tested, test::fixed_step(stages, step));
    bool is_below = true;
    for (int degree = 0; degree <= 2; ++degree) {
      const double error = test::relative_error(jet, reference, degree);
      is_below = is_below && error < window.lowest;
      if (error <= window.lowest || error >= window.highest) continue;
      points[degree].steps.push_back(step);
      points[degree].errors.push_back(error);
    }
    if (is_below || points[0].steps.size() > 12) break;
  }
  for (int degree = 0; degree <= 2; ++degree) {
    ASSERT_GE(points[degree].steps.size(), 3U) << "degree " << degree;
    EXPECT_NEAR(test::fitted_order(points[degree].steps, points[degree].errors), 2 * stages, 0.3)
        << stages << " stages, degree " << degree << ", " << points[degree].steps.size()
        << " points";
  }
}

TEST(GaussOrder, IsTwiceTheNumberOfStagesOnEveryDegree) {
  // Low orders show their slope from perigee in one unit of time; higher orders need a span of many
  // steps.
  expect_order<double>(1, 1, {1e-12, 1e-2, 4});
  expect_order<double>(2, 1, {1e-12, 1e-2, 4});
  expect_order<double>(3, 10, {1e-12, 1e-2, 20});
  expect_order<double>(4, 10, {1e-12, 1e-2, 20});
  // In double precision the range of order 12 is too short to fit.
  expect_order<Extended>(6, 10, {1e-22, 1e-10, 25});
}

}  // namespace
}  // namespace hamjet
