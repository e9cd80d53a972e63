#include <gtest/gtest.h>

#include <limits>

#include "dynamics/newton_in_bracket.hpp"
#include "hamjet/dynamics/mean_elements.hpp"
#include "support/errors.hpp"

// What has no solution is an error, never the last number of the search.

namespace hamjet::test {
namespace {

TEST(SolverFailures, ABracketOfNoNumbersHasNoRoot) {
  const auto no_number = [](const Extended&) -> MissAndSlope {
    return {std::numeric_limits<Extended>::quiet_NaN(), 1};
  };
  expect_error(ErrorKind::numerical, "no root is found",
               [&] { root_in_bracket(no_number, Extended(0), Extended(1), Extended(0.5)); });
}

// A J2 of half the body makes the difference of mean and osculating elements larger than they are.
TEST(SolverFailures, MeanElementsOfAFieldThatIsNoPerturbation) {
  const OblateBody body{398600.4418, 6378.137, 0.5};
  const CartesianState osculating{{6800, 100, 200}, {0.1, 5.5, 5.3}};
  expect_error(ErrorKind::numerical, "mean elements",
               [&] { mean_of_osculating(osculating, body); });
}

}  // namespace
}  // namespace hamjet::test
