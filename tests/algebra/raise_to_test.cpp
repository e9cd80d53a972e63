#include "algebra/raise_to.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hamjet {
namespace {

// The expected value follows from the definition: it is the maximum, in whatever order, and NaN if
// one of the values is NaN.
TEST(RaiseTo, KeepsTheLargestAndNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<int> order = {0, 1, 2};
  do {
    double largest = 0;
    double with_nan = 0;
    for (const int i : order) {
      raise_to(largest, i);
      raise_to(with_nan, i == 1 ? nan : i);
    }
    EXPECT_EQ(largest, 2);
    EXPECT_TRUE(std::isnan(with_nan));
  } while (std::next_permutation(order.begin(), order.end()));
}

}  // namespace
}  // namespace hamjet
