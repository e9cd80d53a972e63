#include "integrators/time_expansion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"

namespace hamjet {
namespace {

/// Uses every operation, some of them on values that are themselves series.
struct Everything {
  template <class T>
  std::vector<T> operator()(std::span<const T> x) const {
    using std::atan2;
    using std::cos;
    using std::cosh;
    using std::exp;
    using std::log;
    using std::pow;
    using std::sin;
    using std::sinh;
    const T& u = x[0];
    const T product = u * x[1];
    return {product,        product * product, x[1] / (u + T(2)), exp(product),
            log(u + T(1)),  sin(product),      cos(product),      pow(u, T(-1.5)),
            pow(u, T(0.3)), T(3) * u - x[1],   T(1) / product,    pow(product, T(0.5)),
            sinh(product),  cosh(product),     atan2(u, x[1])};
  }
};

// The series of what is done to u = 1/2 + t + t^2/4 and 2 - t, summed at a small time, is what is
// done to their values then.
TEST(TimeExpansion, IsThatOfEveryOperation) {
  constexpr int order = 14;
  const double t = 0.02;  // t^15 is below rounding
  const OperationList list =
      record(2, [](std::span<const Expression> x) { return Everything{}(x); });
  TimeExpansion<Pack<double, 8>, double> expansion(list, order);
  const std::vector<std::vector<double>> inputs = {{0.5, 1, 0.25}, {2, -1}};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (std::size_t k = 0; k < inputs[i].size(); ++k) {
      expansion.input(i)[k] = Pack<double, 8>(inputs[i][k]);
    }
  }
  for (int k = 0; k <= order; ++k) expansion.expand(k);
  const std::vector<double> there = {0.5 + t + 0.25 * t * t, 2 - t};
  const std::vector<double> expected = Everything{}(std::span<const double>(there));
  for (std::size_t o = 0; o < expected.size(); ++o) {
    for (const int lane : {0, 7}) {
      double sum = 0;
      for (int k = order; k >= 0; --k) sum = sum * t + expansion.output(o)[k].lane(lane);
      EXPECT_NEAR(sum, expected[o], 8e-16 * (1 + std::abs(expected[o]))) << "output " << o;
    }
  }
}

}  // namespace
}  // namespace hamjet
