#include "studies/exact_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {
namespace {

/// The largest distance between the end of a flight and the ends of the same in two legs, as a part
/// of the distance from the centre.
double largest_gap_of_legs(const SharedSystem& system, const std::vector<double>& start,
                           const ClockTime& start_time, double duration) {
  const std::vector<double> whole = exact_flow(system, start, start_time, duration);
  const double reach = std::hypot(whole[0], whole[1], whole[2]);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.05, 0.95);
  double largest = 0;
  for (int k = 0; k < 20; ++k) {
    const double cut = share(random) * duration;
    const std::vector<double> middle = exact_flow(system, start, start_time, cut);
    const std::vector<double> end = exact_flow(system, middle, start_time + cut, duration - cut);
    largest = std::max(largest,
                       std::hypot(end[0] - whole[0], end[1] - whole[1], end[2] - whole[2]) / reach);
  }
  return largest;
}

// Expected: the property of a flow, that a flight in legs ends where the whole one does. What is
// left is rounding, 2.2e-16 a coordinate, at the cut and at the end, which the flow stretches along
// the track by some ten in a revolution and half. Steps of a jet's tolerance, 1e-13, leave legs
// 1e-12 apart.
constexpr double rounding = 1e-14;

TEST(ExactFlow, OfLegsIsThatOfTheWhole) {
  const Scene scene = io::parse_scene(R"(schema = 1
[system]
model = "earth"
[nominal]
epoch_utc = "1984-04-27T01:06:55"
height_km = 500
i_deg = 51
raan_deg = 40
u_deg = 70
[jet]
order = 1
duration_s = 8248
)",
                                      "legs.toml");
  const ComputedProblem problem = make_problem(scene);
  EXPECT_LE(
      largest_gap_of_legs(problem.system, problem.nominal, problem.start_time, scene.duration),
      rounding);
}

}  // namespace
}  // namespace hamjet
