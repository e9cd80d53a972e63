#pragma once

#include <vector>

#include "../../integrators/taylor_flow.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/scene.hpp"
#include "initial_states.hpp"
#include "standard_normals.hpp"

namespace hamjet {

/// Samples of a start that are flown side by side with the full equations, each with its own
/// parameters.
class SampledFlights {
 public:
  /// `scene` is that of scene_of_start, `system` its system. The normal variables of the parameters
  /// that all spacecraft share stand in the columns of `common`: the first start draws them, others
  /// find them there.
  SampledFlights(const SharedSystem& system, const Scene& scene, const InitialState& start,
                 int samples, StandardNormals& normals, Matrix<double>& common);

  void advance_to(double time, const ProgressCallback& progress);

  /// Canonical deviations from the chief's nominal, whose state at the time is given.
  Matrix<double> deviations(const Vector<double>& chief) const;

  /// One state, flown alone as the samples are.
  static SampledFlights of_nominal(const SharedSystem& system, const Scene& scene);
  Vector<double> first() const;

 private:
  SampledFlights(const SharedSystem& system, const Scene& scene);

  TaylorFlow flow_;
  ClockTime start_time_;
  std::size_t size_;            ///< numbers of a state
  std::vector<double> states_;  ///< columns
  double time_ = 0;             ///< since the start
};

}  // namespace hamjet
