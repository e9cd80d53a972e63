#include <gtest/gtest.h>

#include <cstdint>

#include "studies/estimated_scenes.hpp"

// The estimated error of random scenes beside the true one, from the reference in extended
// precision; error_estimate_statistics does the same with hundreds.

namespace hamjet::test {
namespace {

TEST(ErrorEstimate, IsNotFarBelowTheErrorOnRandomScenes) {
  int judged = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Scene scene = estimated_scene(seed);
    scene.order = std::min(scene.order, 2);
    const PropagationResult result = propagate(scene);
    for (const JudgedDegree& one : judged_degrees(result)) {
      ++judged;
      EXPECT_LT(one.ratio(), 100) << description(scene) << ", degree " << one.degree << ", error "
                                  << one.error << ", estimate " << one.estimate;
    }
  }
  EXPECT_GT(judged, 20);
}

}  // namespace
}  // namespace hamjet::test
