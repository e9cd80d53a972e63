#include <pybind11/stl.h>

#include <cstdint>

#include "../../formats/relative_frame_text.hpp"
#include "../../report/formation/deputy_motion_report.hpp"
#include "../../report/formation/transfer_tables.hpp"
#include "../../report/formation/transfer_view.hpp"
#include "../../studies/formation/deputy_motion.hpp"
#include "../bindings.hpp"
#include "hamjet/error.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "studied.hpp"

namespace hamjet::python {
namespace {

Studied<TransferResult> study_transfers(const GivenScene& given, const py::object& progress) {
  const auto study = [](const Scene& scene, const ProgressCallback& report) {
    return study_transfer(scene, report);
  };
  return studied(given, progress, "transfer", study, &io::flown_transfer_report);
}

Studied<DeputyMotion> study_motion(const GivenScene& given, const py::object& progress) {
  return studied(given, progress, "deputy", &study_deputy_motion, &io::deputy_motion_report);
}

/// One point's best answer, flown: (times in s, states (count + 1, 6) along R, T, N in m and m/s).
py::tuple fly(const Studied<TransferResult>& studied, std::size_t point, int count) {
  const TransferResult& result = *studied.result();
  if (point >= result.points.size() || io::shown_answer(result.points[point]) == nullptr) {
    throw Error(ErrorKind::usage, "trajectory: this transfer time has no answer");
  }
  if (count < 1) throw Error(ErrorKind::usage, "trajectory: count must be at least 1");
  const RelativeTrajectory trajectory =
      interruptibly(py::none(), [result = studied.result(), point, count](const ProgressCallback&) {
        std::vector<double> times;
        for (int k = 0; k <= count; ++k) times.push_back(result->points[point].time * k / count);
        return fly_relative(*result, point, times);
      });
  Table times, states;
  for (std::size_t i = 0; i < trajectory.times.size(); ++i) {
    times.add(trajectory.times[i] * result.scene.units.time_s);
    states.add(trajectory.states[i].position_m);
    states.add(trajectory.states[i].velocity_m_s);
  }
  const auto rows = size_of(trajectory.times.size());
  return py::make_tuple(times.array(), states.array({rows, 6}));
}

/// A place at one time as (time in s, separation, position, velocity), in m and m/s.
py::tuple separation(const DeputyMotion& motion, const SeparationAt& at) {
  Table position, velocity;
  position.add(at.state.position_m);
  velocity.add(at.state.velocity_m_s);
  return py::make_tuple(at.time * motion.scene.units.time_s, separation_m(at.state),
                        position.array(), velocity.array());
}

/// Where the deputy is nearest to its chief, and where farthest.
py::tuple extremes(const DeputyMotion& motion) {
  return py::make_tuple(separation(motion, motion.extremes.nearest),
                        separation(motion, motion.extremes.farthest));
}

}  // namespace

void bind_relative_motion(py::module_& module) {
  bind_study<TransferResult>(module, "TransferStudy", &io::transfer_tables).def("fly", &fly);
  bind_study<DeputyMotion>(module, "MotionStudy", &io::deputy_motion_tables)
      .def("extremes", [](const Studied<DeputyMotion>& s) { return extremes(*s.result()); });
  module.def("study_transfers", &study_transfers, py::arg("scene"), py::arg("progress"));
  module.def("study_motion", &study_motion, py::arg("scene"), py::arg("progress"));
}

}  // namespace hamjet::python
