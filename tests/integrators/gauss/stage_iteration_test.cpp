#include "integrators/gauss/stage_iteration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hamjet/dynamics/dynamical_system.hpp"
#include "integrators/gauss/gauss_tableau.hpp"
#include "integrators/gauss/stage_coefficients.hpp"

// Tests the solution of the stages of q'' = -q, whose iteration is linear: each step multiplies an
// error by -h^2 A^2, which follows from the tableau.

namespace hamjet {
namespace {

using P = Pack<double, 8>;

class StagesOfAnOscillator : public ::testing::Test {
 protected:
  StagesOfAnOscillator() : system_(oscillator_, gauss_tableau(8)), iteration_(system_) {
    system_.set_step(0.01);
  }

  StageIteration<double, 8>::Outcome solve(std::vector<P>& slopes) {
    evaluations_ = 0;
    const auto state = [](std::size_t i) { return i == 0 ? 1.0 : 0.0; };
    return iteration_.solve_constant_terms(state, slopes,
                                           [this](const std::vector<P>& stages, std::vector<P>& g) {
                                             ++evaluations_;
                                             g[0] = -stages[0];
                                           });
  }

  /// The slopes -cos t of the solution, with an error that changes its sign from stage to stage.
  std::vector<P> guess(double error) const {
    P slopes;
    for (int i = 0; i < 8; ++i) {
      slopes.set_lane(i, -std::cos(0.01 * system_.nodes().lane(i)) + (i % 2 == 0 ? error : -error));
    }
    return {slopes};
  }

  DynamicalSystem oscillator_ =
      make_system("oscillator", 1, [](auto q, auto p) { return (p[0] * p[0] + q[0] * q[0]) / 2; });
  StageSystem<double, 8> system_;
  StageIteration<double, 8> iteration_;
  int evaluations_ = 0;
};

TEST_F(StagesOfAnOscillator, OneEvaluationIsEnoughForAGoodGuess) {
  std::vector<P> slopes = guess(1e-7);
  ASSERT_EQ(solve(slopes), iteration_.expected);
  EXPECT_EQ(evaluations_, 1);
  // The stages are then right to h^2 1e-7, and evaluated slopes likewise.
  const std::vector<P> exact = guess(0);
  EXPECT_TRUE(iteration_.is_confirmed(slopes, [&](std::size_t c) { return exact[c]; }));
  EXPECT_LT(iteration_.contraction(), 1e-4);
}

TEST_F(StagesOfAnOscillator, ABadGuessIsIterated) {
  std::vector<P> slopes = guess(1e-2);
  EXPECT_EQ(solve(slopes), iteration_.solved);
  EXPECT_GE(evaluations_, 2);
  // The stages, base + h^2 A^2 slopes, are right to rounding.
  EXPECT_LE(largest_magnitude(system_.couple(slopes[0] - guess(0)[0])),
            std::numeric_limits<double>::epsilon());
}

TEST_F(StagesOfAnOscillator, WhatDoesNotContractAsExpectedIsNotConfirmed) {
  std::vector<P> slopes = guess(1e-7);
  ASSERT_EQ(solve(slopes), iteration_.expected);
  // As if the field were steeper than it was: the evaluated slopes differ from those assumed.
  EXPECT_FALSE(iteration_.is_confirmed(slopes, [&](std::size_t c) { return slopes[c] + P(1e-7); }));
  EXPECT_FALSE(iteration_.is_confirmed(
      slopes, [&](std::size_t) { return P(std::numeric_limits<double>::quiet_NaN()); }));
  // The next step knows that, and iterates.
  slopes = guess(1e-7);
  EXPECT_EQ(solve(slopes), iteration_.solved);
  EXPECT_GE(evaluations_, 2);
}

}  // namespace
}  // namespace hamjet
