#include <gtest/gtest.h>

#include "dynamics/harmonic_oscillator.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"

// A problem without solution is an error; the solver never returns the last number of its search.

namespace hamjet::test {
namespace {

// q'' = q: the midpoint rule's matrix is singular for a step of 2, where its map has a pole. At
// rest on the top the nominal solves its equations all the same.
TEST(SolverFailures, DegreesOfAStepWhoseMatrixIsSingular) {
  const Flow<double> flow{harmonic_oscillator(1, -1), {0, 0}, 2, 1, {}};
  GaussSettings settings;
  settings.stages = 1;
  settings.step = 2;
  expect_error(ErrorKind::numerical, "no solution", [&] { run_gauss(flow, settings); });
}

}  // namespace
}  // namespace hamjet::test
