#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hamjet/detail/algebra/double_double.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"

// References are computed with double-double numbers. They are compared with extended precision,
// 113 bits from another library: their rounding is that of double precision with 50 bits more.

namespace hamjet {
namespace {

using test::jet_in;

double worst_error(const FlowJet<Extended>& jet, const FlowJet<Extended>& exact) {
  double worst = 0;
  for (int d = 0; d <= exact[0].order(); ++d) {
    worst = test::larger(worst, test::relative_error(jet, exact, d));
  }
  return worst;
}

/// What double precision rounds on the same steps is a sample of how the flow amplifies rounding,
/// and one sample may be ten times smaller than another. A product of double-double numbers may err
/// by 5 units of 2^-106 where one of doubles errs by one of 2^-53.
double allowed(const FlowJet<Extended>& in_double, const FlowJet<Extended>& exact) {
  return 50 * worst_error(in_double, exact) * 0x1p-53;
}

TEST(DoubleDoubleGauss, RoundsAsDoublePrecisionWithFiftyBitsMore) {
  const test::Flow<Extended> flow = test::flow_of<Extended>(test::paper_orbit(), 3);
  // Steps so short that truncation is far below the rounding of extended precision.
  const GaussSettings settings = test::fixed_step(16, 0.5);
  const auto exact = jet_in<Extended>(flow, settings);
  const auto found = jet_in<DoubleDouble>(flow, settings);
  const double limit = allowed(jet_in<double>(flow, settings), exact);
  EXPECT_LE(worst_error(found, exact), limit);
  EXPECT_LE(limit, 1e-26);
  // The rotation is left out as in other arithmetic.
  EXPECT_LE(worst_error(jet_in<DoubleDouble>(flow, settings, FlowSymmetry::rotation), exact),
            limit);
}

/// The vector field has a sine, whose series are formed by recurrences.
struct Pendulum {
  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    return p[0] * p[0] / T(2) - cos(q[0]);
  }
};

TEST(DoubleDoubleGauss, HasTheElementaryFunctions) {
  const test::Flow<Extended> flow{make_system("pendulum", 1, Pendulum{}), {0.4, 1}, 5, 4, {}};
  const GaussSettings settings = test::fixed_step(16, 0.5);
  const auto exact = jet_in<Extended>(flow, settings);
  EXPECT_LE(worst_error(jet_in<DoubleDouble>(flow, settings), exact),
            allowed(jet_in<double>(flow, settings), exact));
}

TEST(DoubleDoubleGauss, ChoosesStepsForTolerancesBeyondDoublePrecision) {
  const test::Flow<Extended> flow = test::flow_of<Extended>(test::paper_orbit(), 2);
  const auto exact = jet_in<Extended>(flow, test::fixed_step(16, 0.5));
  double before = 1;
  for (const double tolerance : {1e-16, 1e-20, 1e-24}) {
    const double error =
        worst_error(jet_in<DoubleDouble>(flow, test::adaptive(16, tolerance)), exact);
    // Three times the tolerance for each of at most 1.4 times the five revolutions' periods.
    EXPECT_LE(error, 3 * 7 * tolerance);
    EXPECT_LT(error, 0.1 * before);
    before = error;
  }
}

TEST(DoubleDoubleGauss, SeesACollision) {
  const test::Flow<Extended> flow{kepler(), {1, 0, 0, 0, 0, 0}, 3, 1, {}};
  test::expect_error(ErrorKind::numerical, "collision",
                     [&] { jet_in<DoubleDouble>(flow, test::adaptive(16, 1e-20)); });
}

}  // namespace
}  // namespace hamjet
