#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "../../src/studies/exact_flow.hpp"
#include "../../src/studies/formation/single_transfer.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet::test {

/// Random deputies that no study has flown, to try a separation that one tells.
class UnseenDeputies {
 public:
  UnseenDeputies(const Scene& scene, const ComputedProblem& problem, RelativeFrame frame,
                 double mean_motion_canonical, unsigned seed)
      : scene_(scene),
        problem_(problem),
        units_(metric_units(scene)),
        frame_(scene.nominal, units_, frame),
        mean_motion_per_s_(mean_motion_canonical / units_.time_s),
        generator_(seed) {}

  std::mt19937_64& generator() { return generator_; }

  /// How many of so many deputies are more than a metre from where `predict(deviation, order)` says
  /// that they are at a time, canonical positions; `share(k)` is the k-th one's distance in parts
  /// of the proved separation.
  template <class Share, class Predict>
  int beyond_a_metre(const ValidityEntry& entry, double time, int count, const Share& share,
                     const Predict& predict) {
    int beyond = 0;
    for (int k = 0; k < count; ++k) {
      const double separation_m = share(k) * entry.proved_m;
      RelativeState state;
      state.position_m = drawn(separation_m);
      state.velocity_m_s = drawn(separation_m * mean_motion_per_s_);
      const std::vector<double> start = frame_.deviation(state);
      std::vector<double> deputy = scene_.nominal;
      for (std::size_t i = 0; i < start.size(); ++i) deputy[i] += start[i];
      const std::vector<double> flown =
          exact_flow(problem_.system, deputy, problem_.start_time, time);
      const std::array<double, 3> predicted = predict(start, entry.order);
      const double miss =
          std::hypot(predicted[0] - flown[0], predicted[1] - flown[1], predicted[2] - flown[2]);
      beyond += miss * units_.length_m > 1 ? 1 : 0;
    }
    return beyond;
  }

 private:
  Eigen::Vector3d drawn(double length) {
    Eigen::Vector3d direction(normal_(generator_), normal_(generator_), normal_(generator_));
    return direction.normalized() * length;
  }

  const Scene& scene_;
  const ComputedProblem& problem_;
  MetricUnits units_;
  ChiefFrame frame_;
  double mean_motion_per_s_;
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace hamjet::test
