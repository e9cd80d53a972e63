#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "hamjet/report/results.hpp"
#include "hamjet/studies/propagation.hpp"

// What forces that are none of a Hamiltonian leave of symplecticity and of exactness, told beside
// what the integration leaves. With a friction -2 c p the flow of an oscillator has the determinant
// e^(-2 c t), and F1 the residual (1 - determinant) / (dq / dp0).

namespace hamjet {
namespace {

constexpr double friction = 1e-3;

Scene damped_scene(const std::string& kind) {
  const DynamicalSystem timed =
      make_system("damped", record(
                                3,
                                [](std::span<const Expression> z) {
                                  return std::vector<Expression>{(z[0] * z[0] + z[1] * z[1]) / 2 +
                                                                 z[0] * z[0] * z[0] / 10};
                                },
                                true));
  Scene scene =
      make_scene(with_force(timed,
                            [](std::span<const Expression> z) {
                              return std::vector<Expression>{Expression(-2 * friction) * z[1]};
                            }),
                 {0, 0}, 2, 3);
  scene.kinds = {kind};
  scene.integrators = {{.label = "gauss4", .stages = 4, .tolerance = 1e-7}};
  return scene;
}

TEST(ForcesResidual, IsThatOfFrictionInClosedForm) {
  const PropagationResult result = propagate(damped_scene("F1"));
  const RunResult& run = result.runs.at(0);
  ASSERT_EQ(run.failure, "");
  const double defect = 1 - std::exp(-2 * friction * 2.0);
  ASSERT_EQ(run.symplecticity.size(), 3U);
  EXPECT_NEAR(run.symplecticity[0].absolute, defect, 1e-6 * defect);
  ASSERT_EQ(run.integration_defects.size(), 3U);
  EXPECT_LT(run.integration_defects[0], 1e-3 * run.symplecticity[0].scaled);
  EXPECT_GT(run.integration_defects[0], 0);
  ASSERT_EQ(run.kinds.at(0).failure, "");
  const ExactnessEntry& first = run.kinds[0].by_degree.at(0);
  ASSERT_TRUE(first.forces && first.integration);
  // About the equilibrium: z'' + 2 c z' + z = 0, dq / dp0 = e^(-c t) sin(w t) / w.
  const double w = std::sqrt(1 - friction * friction);
  const double by_momentum = std::exp(-2 * friction) * std::sin(2 * w) / w;
  EXPECT_NEAR(first.forces->absolute, defect / by_momentum, 1e-9 * defect);
  EXPECT_LT(*first.integration, 1e-3 * first.forces->absolute);
  EXPECT_GT(*first.integration, 0);
  EXPECT_FALSE(first.floor);
  // The difference of the two residuals is at most that of the difference.
  for (const ExactnessEntry& entry : run.kinds[0].by_degree) {
    EXPECT_LE(std::abs(entry.residual.absolute - entry.forces->absolute),
              *entry.integration * (1 + 1e-9) + 1e-15);
  }
}

// The reference of a scene is as good as a finer jet.
TEST(ForcesResidual, IsTheSameWithAReference) {
  Scene scene = damped_scene("F1");
  const KindResult without = propagate(scene).runs.at(0).kinds.at(0);
  scene.reference.emplace();
  const KindResult with = propagate(scene).runs.at(0).kinds.at(0);
  ASSERT_EQ(with.by_degree.size(), without.by_degree.size());
  for (std::size_t d = 0; d < with.by_degree.size(); ++d) {
    const double forces = with.by_degree[d].forces.value().absolute;
    EXPECT_NEAR(without.by_degree[d].forces.value().absolute, forces, 1e-10 * forces) << d;
    EXPECT_FALSE(with.by_degree[d].floor);
  }
}

TEST(ForcesResidual, IsToldInPlaceOfOk) {
  const std::string told = io::summary_table(propagate(damped_scene("F1")));
  EXPECT_NE(told.find("not symplectic"), std::string::npos) << told;
  EXPECT_NE(told.find("F1 exactness by degree, of the forces"), std::string::npos) << told;
  EXPECT_NE(told.find("defect of the brackets by degree"), std::string::npos) << told;
  EXPECT_EQ(told.find(" ok\n"), std::string::npos) << told;
}

}  // namespace
}  // namespace hamjet
