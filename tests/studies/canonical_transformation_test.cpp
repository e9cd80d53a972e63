#include "studies/paper/canonical_transformation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "support/errors.hpp"
#include "support/symplectic.hpp"

namespace hamjet::test {
namespace {

CanonicalTransformationStudy paper_study() {
  CanonicalTransformationStudy study;
  study.system.model = SystemModel::double_well;
  study.nominal = {1, 0.05};
  study.duration = 100;
  study.steps = {0.1, 0.2};
  study.transformation = phase_plane_rotation<Extended>(acos(Extended(0.99)));
  return study;
}

// The paper's claim, and the erratum on its step: 0.1 crosses the barrier, 0.2 does not because its
// energy error exceeds the 0.00125 that the start is above it.
TEST(CanonicalTransformation, PaperCase) {
  const auto result = run_study(paper_study());
  // The bound is four roundings of terms of H that are up to 1/2 in size at the start, and cancel.
  EXPECT_NEAR(result.energy, 0.00125, 4 * 0x1p-54);
  EXPECT_EQ(exit_code(result), 0);
  ASSERT_EQ(result.runs.size(), 2U);
  for (const auto& run : result.runs) {
    EXPECT_EQ(run.steps, std::lround(100 / run.requested_step));
    EXPECT_NEAR(run.step, run.requested_step, 1e-15);
    EXPECT_EQ(run.trajectory.size(), static_cast<std::size_t>(run.steps) + 1);
    EXPECT_GT(run.largest_energy_error, 4e-4);
    EXPECT_LE(run.largest_energy_difference, 1e-13);
    EXPECT_NEAR(run.largest_transformed_energy_error, run.largest_energy_error, 1e-13);
    EXPECT_LE(run.largest_symplecticity_defect, 4e-16);
    EXPECT_NEAR(run.largest_condition, 2, 1e-14);  // the norm of a rotation is the Frobenius norm
    // Sine or cosine is at least 0.7, so that no inversion amplifies.
    ASSERT_TRUE(run.hamilton_jacobi_residual);
    EXPECT_LE(*run.hamilton_jacobi_residual, 2e-15);
    // The identity at k = 0 has no first kind; at all other angles both kinds exist.
    EXPECT_EQ(run.first_kind.steps, run.steps - 1);
    EXPECT_EQ(run.second_kind.steps, run.steps);
    EXPECT_EQ(run.failure, "");
  }
  EXPECT_EQ(result.runs[0].crosses_barrier, true);
  EXPECT_EQ(result.runs[1].crosses_barrier, false);
  EXPECT_LT(result.runs[0].largest_energy_error, 0.00125);
  EXPECT_GT(result.runs[1].largest_energy_error, 0.00125);
  const auto& last = result.runs[0].trajectory.back();
  EXPECT_EQ(last.step, 1000);
  EXPECT_NEAR(last.time, 100, 1e-12);
  // Z_k is z_k rotated by k arccos 0.99.
  const double angle = 1000 * std::acos(0.99);
  EXPECT_NEAR(last.transformed[0],
              std::cos(angle) * last.original[0] - std::sin(angle) * last.original[1], 1e-11);
}

// Steps that are not stored count too.
TEST(CanonicalTransformation, LongRunsAreThinned) {
  auto study = paper_study();
  study.steps = {0.0031};
  const auto run = run_study(study).runs[0];
  EXPECT_EQ(run.steps, 32259);
  EXPECT_EQ(run.stored_interval, 2);
  EXPECT_EQ(run.trajectory.back().step, run.steps);
  EXPECT_EQ(run.trajectory[1].step, 2);
}

// Shears grow in proportion to k, their condition to its square; a hyperbolic map is stopped where
// round-off would be all that is left. The condition of diag(2^k, 2^-k) is 4^k + 4^-k: above 1e12
// from k = 20 on.
TEST(CanonicalTransformation, GrowingTransformations) {
  auto study = paper_study();
  study.steps = {0.1};
  Matrix<Extended> matrix(2, 2);
  matrix << Extended(1), Extended(0.01), Extended(0), Extended(1);
  study.transformation = AffineSymplecticMap<Extended>(matrix, Vector<Extended>::Ones(2));
  const auto shear = run_study(study).runs[0];
  EXPECT_EQ(shear.failure, "");
  EXPECT_NEAR(shear.largest_condition, 102, 1e-9);  // 2 + (1000 * 0.01)^2
  // B_k grows as k^2 and its round-off with it.
  EXPECT_LE(shear.largest_energy_difference, 1e-7);
  matrix << Extended(2), Extended(0), Extended(0), Extended(0.5);
  study.transformation = AffineSymplecticMap<Extended>(matrix);
  const auto result = run_study(study);
  EXPECT_EQ(exit_code(result), 4);
  EXPECT_NE(result.runs[0].failure.find("after 19 of 1000 steps: the condition of A_20 is 1.1e+12"),
            std::string::npos)
      << result.runs[0].failure;
  EXPECT_EQ(result.runs[0].trajectory.size(), 20U);
}

TEST(CanonicalTransformation, CheckOfTheInvariance) {
  auto study = paper_study();
  study.require_invariance = 1e-12;
  EXPECT_EQ(exit_code(run_study(study)), 0);
  study.require_invariance = 1e-18;
  EXPECT_EQ(exit_code(run_study(study)), 1);
}

TEST(CanonicalTransformation, StepWithoutSolutionEndsItsRunOnly) {
  auto study = paper_study();
  study.nominal = {0.01, 0};  // on the barrier, where a step of 2 or more is too long
  study.steps = {2.5, 0.1};
  const auto result = run_study(study);
  EXPECT_EQ(exit_code(result), 4);
  EXPECT_NE(result.runs[0].failure.find("after 0 of 40 steps: midpoint"), std::string::npos);
  EXPECT_EQ(result.runs[1].failure, "");
}

TEST(CanonicalTransformation, RefusesWhatDoesNotFit) {
  auto study = paper_study();
  study.steps = {1e-6, 0.1};
  expect_error(ErrorKind::too_large, "1e+08 steps, at most 1e+07", [&] { run_study(study); });
  study.steps = {};
  expect_error(ErrorKind::usage, "there must be a step size", [&] { run_study(study); });
  study.steps = {0.1, 0};
  expect_error(ErrorKind::usage, "must be above 0", [&] { run_study(study); });
  study = paper_study();
  study.transformation = AffineSymplecticMap<Extended>::identity(2);
  expect_error(ErrorKind::usage, "the model has 2 variables, the nominal 2, the transformation 4",
               [&] { run_study(study); });
}

TEST(CanonicalTransformation, CanBeStopped) {
  int calls = 0;
  const auto stop = [&](const std::string&, double) {
    if (++calls == 3) throw std::runtime_error("stop");
  };
  EXPECT_THROW(run_study(paper_study(), stop), std::runtime_error);
}

}  // namespace
}  // namespace hamjet::test
