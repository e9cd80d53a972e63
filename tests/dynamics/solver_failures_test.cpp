#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "dynamics/kepler_root.hpp"
#include "hamjet/dynamics/mean_elements.hpp"
#include "support/errors.hpp"

// A problem without solution is an error; the solver never returns the last number of its search.

namespace hamjet::test {
namespace {

TEST(SolverFailures, ABracketOfNoNumbersHasNoRoot) {
  const auto no_number = [](const Extended&) -> MissAndSlope {
    return {std::numeric_limits<Extended>::quiet_NaN(), 1};
  };
  expect_error(ErrorKind::numerical, "no root is found",
               [&] { root_in_bracket(no_number, Extended(0), Extended(1), Extended(0.5)); });
}

// The expected value satisfies Kepler's equation. At these eccentricities the slope at perigee is
// as small as 0.01, so that the function's rounding is larger in terms of the place. A search that
// refuses this rounding refuses real orbits.
TEST(SolverFailures, RoundingWhereTheSlopeIsSmallIsNoFailure) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> of_anomaly(-3.2, 3.2), of_eccentricity(0.9, 0.99);
  for (int k = 0; k < 5000; ++k) {
    const Extended e = of_eccentricity(generator);
    const Extended mean = of_anomaly(generator);
    const auto miss = [&](const Extended& E) -> MissAndSlope {
      return {E - e * sin(E) - mean, 1 - e * cos(E)};
    };
    const Extended E = root_in_bracket(miss, mean - e, mean + e, mean);
    EXPECT_LE(abs(miss(E).miss), 16 * std::numeric_limits<Extended>::epsilon() * (1 + abs(E)));
  }
}

// A J2 of half the body makes the difference of mean and osculating elements larger than the
// elements.
TEST(SolverFailures, MeanElementsOfAFieldThatIsNoPerturbation) {
  const OblateBody body{398600.4418, 6378.137, 0.5};
  const CartesianState osculating{{6800, 100, 200}, {0.1, 5.5, 5.3}};
  expect_error(ErrorKind::numerical, "mean elements",
               [&] { mean_of_osculating(osculating, body); });
}

}  // namespace
}  // namespace hamjet::test
