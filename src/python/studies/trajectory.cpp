#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>

#include "../../app/scene_refusal.hpp"
#include "../../studies/scene_trajectory.hpp"
#include "../arrays.hpp"
#include "../bindings.hpp"
#include "../given_scene.hpp"
#include "../interruptible.hpp"
#include "../jet.hpp"

namespace hamjet::python {
namespace {

/// A run's jets at any time; the package makes a Trajectory of it.
class TrajectoryStudy {
 public:
  explicit TrajectoryStudy(std::shared_ptr<const SceneTrajectory> trajectory)
      : trajectory_(std::move(trajectory)) {}

  std::string label() const { return trajectory_->settings().label; }
  double duration_s() const { return trajectory_->scene().duration * unit_s(); }
  py::array_t<double> step_times_s() const {
    std::vector<double> times = trajectory_->step_times();
    for (double& time : times) time *= unit_s();
    return python::array_of(std::move(times));
  }

  Jet at(double time_s) const {
    const Scene& scene = trajectory_->scene();
    // The ends in seconds are the ends in canonical units, whatever the rounding between.
    const double time = time_s == duration_s() ? scene.duration : time_s / unit_s();
    FlowJet<Extended> jet = interruptibly(
        py::none(),
        [trajectory = trajectory_, time](const ProgressCallback&) { return trajectory->at(time); });
    PropagationResult result;
    result.scene = scene;
    result.problem = trajectory_->problem();
    RunResult run;
    run.settings = trajectory_->settings();
    run.nominal_final.assign(scene.nominal.size(), 0);
    for (std::size_t i = 0; i < jet.size(); ++i) {
      run.nominal_final[result.problem.components[i]] = convert<double>(jet[i][0]);
    }
    run.jet = std::move(jet);
    result.scene.duration = time;
    return jet_of(result, run);
  }

 private:
  double unit_s() const { return trajectory_->scene().units.time_s; }

  std::shared_ptr<const SceneTrajectory> trajectory_;
};

TrajectoryStudy follow(const GivenScene& given, const std::string& run,
                       const py::object& progress) {
  const Scene scene = given.flow_jet(io::SceneUnits::told);
  return interruptibly(progress, [scene, file = given.file, run](const ProgressCallback& report) {
    return TrajectoryStudy(cli::study_of(
        file, [&] { return std::make_shared<const SceneTrajectory>(scene, run, report); }));
  });
}

}  // namespace

void bind_trajectory(py::module_& module) {
  py::class_<TrajectoryStudy>(module, "TrajectoryStudy")
      .def_property_readonly("label", &TrajectoryStudy::label)
      .def_property_readonly("duration_s", &TrajectoryStudy::duration_s)
      .def_property_readonly("step_times_s", &TrajectoryStudy::step_times_s)
      .def("at", &TrajectoryStudy::at, py::arg("time_s"));
  module.def("follow", &follow, py::arg("scene"), py::arg("run"), py::arg("progress"));
}

}  // namespace hamjet::python
