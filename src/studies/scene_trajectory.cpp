#include "scene_trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../text/scene_message.hpp"
#include "arcs.hpp"
#include "descriptions/method_description.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "integration.hpp"

namespace hamjet {
namespace {

/// The memory that a run may use for its jets; between the jets that are kept, steps are repeated.
constexpr double most_bytes = 1e9;

bool is_gauss(const IntegratorSettings& settings) {
  return settings.method == IntegrationMethod::gauss;
}

template <class Real>
std::unique_ptr<const JetTrajectory<Real>> trajectory_of(const ComputedProblem& problem,
                                                         const IntegratorSettings& settings,
                                                         double duration,
                                                         const ProgressCallback& progress) {
  StepObserver<Real> observer;
  if (progress) {
    observer = [&](const Real& time, const FlowJet<Real>&) {
      progress("trajectory", static_cast<double>(time) / duration);
    };
  }
  return std::make_unique<const JetTrajectory<Real>>(
      flow_problem<Real>(problem, duration), std::get<GaussSettings>(splittable_method(settings)),
      most_bytes, observer);
}

}  // namespace

const IntegratorSettings& gauss_run_of(const Scene& scene, std::string_view label,
                                       std::string_view who, std::string_view others_lack) {
  const auto& all = scene.integrators;
  if (label.empty()) {
    const auto first = std::find_if(all.begin(), all.end(), is_gauss);
    if (first != all.end()) return *first;
    throw Error(ErrorKind::scene,
                fmt::format("{}: no integrator has {}, must have one of the method "
                            "gauss",
                            who, others_lack));
  }
  const auto named = std::find_if(all.begin(), all.end(),
                                  [&](const IntegratorSettings& s) { return s.label == label; });
  if (named == all.end()) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: no run has the label {}", who, io::in_quotes(std::string(label))));
  }
  if (!is_gauss(*named)) {
    throw Error(ErrorKind::scene,
                fmt::format("{}: {} has no {}, must be of the method gauss, got {}", who,
                            named->label, others_lack, description_of(named->method).name));
  }
  return *named;
}

SceneTrajectory::SceneTrajectory(const Scene& scene, std::string_view label,
                                 const ProgressCallback& progress)
    : scene_(scene), problem_(make_problem(scene_)) {
  require_unsplit(scene_, "a trajectory");
  settings_ = &gauss_run_of(scene_, label, "trajectory", "jets between its steps");
  if (scene_.precision == Precision::extended) {
    trajectory_ = trajectory_of<Extended>(problem_, *settings_, scene_.duration, progress);
  } else {
    trajectory_ = trajectory_of<double>(problem_, *settings_, scene_.duration, progress);
  }
}

const IntegrationStatistics& SceneTrajectory::statistics() const {
  return std::visit(
      [](const auto& trajectory) -> const IntegrationStatistics& {
        return trajectory->statistics();
      },
      trajectory_);
}

std::vector<double> SceneTrajectory::step_times() const {
  std::vector<double> times;
  std::visit(
      [&](const auto& trajectory) {
        for (const auto& time : trajectory->step_times())
          times.push_back(static_cast<double>(time));
      },
      trajectory_);
  return times;
}

FlowJet<Extended> SceneTrajectory::at(double time) const {
  return std::visit(
      [time](const auto& trajectory) { return convert_map<Extended>(trajectory->at(time)); },
      trajectory_);
}

}  // namespace hamjet
