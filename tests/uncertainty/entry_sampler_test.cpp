#include "uncertainty/entry_sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "uncertainty/sampled_paths.hpp"

namespace hamjet {
namespace {

// Two on circles that cross at right angles, whose passage of the sphere takes a 60th of the
// window: of boxes in time and direction most lie where paths leave the sphere, and those at the
// edge hold grazing entries that no point of a box may see. Draws must be able to come by every
// entry there is.
TEST(EntrySampler, KnowsTheDensityOfEveryPathThatEnters) {
  constexpr double s = 7e-7, after = 1e-5;
  EncounterProblem problem{kepler(), {}, ClockTime::epoch()};
  const double c = std::cos(after), d = std::sin(after), miss = 6e-7;
  problem.spacecraft[0].state = {c, -d, 0, d, c, 0};
  problem.spacecraft[1].state = {c * (1 + miss), 0, -d * (1 + miss), d, 0, c};
  for (UncertainSpacecraft& craft : problem.spacecraft) {
    craft.factor.topLeftCorner<3, 3>() = s * Eigen::Matrix3d::Identity();
    craft.factor.bottomRightCorner<3, 3>() = 4e-6 * Eigen::Matrix3d::Identity();
  }
  problem.to = 2 * after;
  problem.radius = 4e-7;
  problem.order = 1;
  problem.settings.tolerance = 1e-13;
  const RelativePaths paths(problem, 1e-5 * problem.radius, problem.radius);
  const EntrySampler sampler(paths, problem.radius, false);
  RandomStream random(3, 0);
  SampledPath path(paths.times().size());
  int entries = 0;
  for (int k = 0; k < 30'000; ++k) {
    EncounterDeviation deviation;
    for (double& x : deviation) x = random.normal();
    for (std::size_t node = 0; node < path.size(); ++node) {
      const LinearRelativeState& linear = paths.linear(node);
      const Eigen::Matrix<double, 6, 1> state = linear.mean + linear.by_deviation * deviation;
      for (std::size_t i = 0; i < 6; ++i) path[node][i] = state[static_cast<Eigen::Index>(i)];
    }
    if (least_distance(paths, path) >= problem.radius) continue;
    ++entries;
    EXPECT_TRUE(sampler.log_density_ratio(path)) << k;
  }
  EXPECT_GT(entries, 1000);
}

}  // namespace
}  // namespace hamjet
