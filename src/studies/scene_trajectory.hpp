#pragma once

#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "hamjet/integrators/jet_trajectory.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The scene's integrator with this label, which must be a Gauss method; if the label is empty, its
/// first Gauss method. Throws Error(usage) if no integrator has this label, Error(scene) for
/// another method. Messages begin with `who` and name what other methods lack.
const IntegratorSettings& gauss_run_of(const Scene& scene, std::string_view label,
                                       std::string_view who, std::string_view others_lack);

/// The jets of a scene's flow at every time of its duration, from one run (JetTrajectory), in the
/// scene's precision.
class SceneTrajectory {
 public:
  /// Integrates with the scene's integrator of this label; if it is empty, with its first Gauss
  /// method. Throws Error(usage) if no integrator has this label, Error(scene) for an integrator
  /// that is not a Gauss method and for a scene in arcs, and as make_problem and integrate_gauss.
  SceneTrajectory(const Scene& scene, std::string_view label, const ProgressCallback& progress);

  const Scene& scene() const { return scene_; }
  const ComputedProblem& problem() const { return problem_; }
  const IntegratorSettings& settings() const { return *settings_; }
  const IntegrationStatistics& statistics() const;
  /// Ends of the steps, in canonical units, including 0 and the duration.
  std::vector<double> step_times() const;
  /// The jet at a canonical time between 0 and the duration. Throws as JetTrajectory::at. It may be
  /// called on several threads at once.
  FlowJet<Extended> at(double time) const;

 private:
  template <class Real>
  using Pointer = std::unique_ptr<const JetTrajectory<Real>>;

  Scene scene_;
  ComputedProblem problem_;
  const IntegratorSettings* settings_ = nullptr;  ///< a setting of scene_
  std::variant<Pointer<double>, Pointer<Extended>> trajectory_;
};

}  // namespace hamjet
