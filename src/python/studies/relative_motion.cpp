#include <pybind11/stl.h>

#include <cstdint>

#include "../../formats/relative_frame_text.hpp"
#include "../../report/formation/deputy_motion_report.hpp"
#include "../../report/formation/transfer_view.hpp"
#include "../../report/formation/validity_table.hpp"
#include "../../studies/formation/deputy_motion.hpp"
#include "../bindings.hpp"
#include "hamjet/error.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "hamjet/studies/assignment.hpp"
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

Studied<AssignmentResult> assign(const GivenScene& given, const py::object& progress) {
  return studied(given, progress, "assignment", &study_assignment, &io::assignment_report);
}

Studied<ValidityResult> study_separations(const GivenScene& given, const py::object& progress) {
  return studied(given, progress, "validity", &study_validity, &io::validity_report);
}

const Eigen::Vector3d no_vector = Eigen::Vector3d::Constant(none);

/// Velocity changes and misses of all orders, NaN where an order has no answer.
void add_orders(const TransferResult& result, py::dict& arrays) {
  Table start, end, miss;
  const auto points = size_of(result.points.size());
  const py::ssize_t orders = result.scene.order;
  for (const TransferPoint& point : result.points) {
    for (int order = 1; order <= result.scene.order; ++order) {
      const TransferAnswer* answer = io::answer_of_order(point, order);
      start.add(answer != nullptr ? answer->start_change_m_s : no_vector);
      end.add(answer != nullptr ? answer->end_change_m_s : no_vector);
      miss.add(answer != nullptr ? answer->miss_m : none);
    }
  }
  arrays["start_change_by_order_m_s"] = start.array({points, orders, 3});
  arrays["end_change_by_order_m_s"] = end.array({points, orders, 3});
  arrays["miss_by_order_m"] = miss.array({points, orders});
}

py::dict transfer_arrays(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  Table time, condition, position_condition, distance, start, end, total, miss, residual;
  std::vector<bool> near, beyond, refined, forbidden;
  py::list kinds, failures;
  for (const TransferPoint& point : result.points) {
    const TransferAnswer* answer = io::shown_answer(point);
    time.add(point.time * unit);
    condition.add(point.kind ? point.condition : none);
    position_condition.add(point.position_condition);
    distance.add(point.singular_distance.value_or(none) * unit);
    start.add(answer != nullptr ? answer->start_change_m_s : no_vector);
    end.add(answer != nullptr ? answer->end_change_m_s : no_vector);
    total.add(answer != nullptr ? answer->total_change_m_s() : none);
    miss.add(answer != nullptr ? answer->miss_m : none);
    residual.add(point.hamilton_jacobi_residual.value_or(none));
    near.push_back(point.is_near_singular);
    beyond.push_back(point.is_beyond_tolerance);
    refined.push_back(point.is_refined());
    forbidden.push_back(!point.is_allowed());
    kinds.append(point.kind ? py::object(py::str(point.kind->name())) : py::none());
    failures.append(py::str(io::failure_text(point)));
  }
  const auto points = size_of(result.points.size());
  py::dict arrays;
  arrays["times_s"] = time.array();
  arrays["kinds"] = py::tuple(kinds);
  arrays["conditions"] = condition.array();
  arrays["position_conditions"] = position_condition.array();
  arrays["singular_distances_s"] = distance.array();
  arrays["start_change_m_s"] = start.array({points, 3});
  arrays["end_change_m_s"] = end.array({points, 3});
  arrays["total_change_m_s"] = total.array();
  arrays["miss_m"] = miss.array();
  arrays["hamilton_jacobi_residuals"] = residual.array();
  arrays["near_singular"] = flags(near);
  arrays["beyond_tolerance"] = flags(beyond);
  arrays["refined"] = flags(refined);
  arrays["forbidden"] = flags(forbidden);
  arrays["failures"] = py::tuple(failures);
  Table windows;
  for (const BudgetWindow& window : result.budget_windows) {
    windows.add(window.first * unit);
    windows.add(window.last * unit);
  }
  arrays["budget_windows_s"] = windows.array({size_of(result.budget_windows.size()), 2});
  add_orders(result, arrays);
  Table singular;
  for (const SingularTime& entry : result.position_singularities()) singular.add(entry.time * unit);
  arrays["singular_times_s"] = singular.array();
  arrays["best"] = result.best_point();
  arrays["flight_floor_m"] = result.flight_floor_m;
  return arrays;
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

/// Which deputy goes where, and how near all come to each other.
py::dict assignment_arrays(const AssignmentResult& result) {
  const double unit = result.scene.units.time_s;
  std::vector<std::int64_t> deputies, slots, pairs;
  Table time, start, end, total, miss, costs, separation, pair_time;
  std::vector<bool> beyond;
  for (const AssignedTransfer& assigned : result.transfers) {
    const TransferAnswer* answer = io::shown_answer(assigned.transfer);
    deputies.push_back(static_cast<std::int64_t>(assigned.deputy));
    slots.push_back(static_cast<std::int64_t>(assigned.slot));
    time.add(assigned.transfer.time * unit);
    start.add(answer != nullptr ? answer->start_change_m_s : no_vector);
    end.add(answer != nullptr ? answer->end_change_m_s : no_vector);
    total.add(answer != nullptr ? answer->total_change_m_s() : none);
    miss.add(answer != nullptr ? answer->miss_m : none);
    beyond.push_back(assigned.transfer.is_beyond_tolerance);
  }
  for (const auto& row : result.costs) {
    for (const AssignmentCost& cost : row) costs.add(cost.time ? cost.total_change_m_s : none);
  }
  for (const DeputyPair& pair : result.pairs) {
    pairs.push_back(static_cast<std::int64_t>(pair.first));
    pairs.push_back(static_cast<std::int64_t>(pair.second));
    separation.add(pair.separation_m);
    pair_time.add(pair.time * unit);
  }
  const auto count = size_of(result.transfers.size());
  const AssignmentSettings& settings = *result.scene.assignment;
  py::dict arrays;
  arrays["deputies"] = python::array_of(std::move(deputies));
  arrays["slots"] = python::array_of(std::move(slots));
  arrays["times_s"] = time.array();
  arrays["start_change_m_s"] = start.array({count, 3});
  arrays["end_change_m_s"] = end.array({count, 3});
  arrays["total_change_m_s"] = total.array();
  arrays["miss_m"] = miss.array();
  arrays["beyond_tolerance"] = flags(beyond);
  arrays["costs_m_s"] =
      result.costs.empty()
          ? costs.array({0, 0})
          : costs.array({size_of(settings.deputies.size()), size_of(settings.slots.size())});
  arrays["pairs"] = python::array_of(std::move(pairs), {size_of(result.pairs.size()), 2});
  arrays["pair_separation_m"] = separation.array();
  arrays["pair_times_s"] = pair_time.array();
  arrays["flight_floor_m"] = result.flight_floor_m;
  arrays["failure"] = result.failure;
  return arrays;
}

/// A place at one time as (time in s, separation, position, velocity), in m and m/s.
py::tuple separation(const DeputyMotion& motion, const SeparationAt& at) {
  Table position, velocity;
  position.add(at.state.position_m);
  velocity.add(at.state.velocity_m_s);
  return py::make_tuple(at.time * motion.scene.units.time_s, separation_m(at.state),
                        position.array(), velocity.array());
}

py::dict motion_arrays(const DeputyMotion& motion) {
  Table time, position, velocity, distance, error;
  for (const DeputyMotionPoint& point : motion.points) {
    time.add(point.time * motion.scene.units.time_s);
    position.add(point.state.position_m);
    velocity.add(point.state.velocity_m_s);
    distance.add(separation_m(point.state));
    for (const double error_m : point.errors_m) error.add(error_m);
  }
  const auto points = size_of(motion.points.size());
  py::dict arrays;
  arrays["frame"] = io::frame_text(motion.scene.deputy->frame);
  arrays["times_s"] = time.array();
  arrays["position_m"] = position.array({points, 3});
  arrays["velocity_m_s"] = velocity.array({points, 3});
  arrays["separation_m"] = distance.array();
  arrays["error_by_order_m"] = error.array({points, motion.scene.order});
  arrays["flight_floor_m"] = motion.flight_floor_m;
  arrays["verdict"] = io::deputy_motion_verdict(motion);
  return arrays;
}

/// Where the deputy is nearest to its chief, and where farthest.
py::tuple extremes(const DeputyMotion& motion) {
  return py::make_tuple(separation(motion, motion.extremes.nearest),
                        separation(motion, motion.extremes.farthest));
}

}  // namespace

void bind_relative_motion(py::module_& module) {
  module.def("declarations", &declarations);
  bind_study<TransferResult>(module, "TransferStudy", &io::transfers_csv, &transfer_arrays)
      .def_property_readonly(
          "exit_code", [](const Studied<TransferResult>& s) { return exit_code(*s.result()); })
      .def("fly", &fly);
  bind_study<DeputyMotion>(module, "MotionStudy", &io::deputy_motion_csv, &motion_arrays)
      .def("extremes", [](const Studied<DeputyMotion>& s) { return extremes(*s.result()); });
  bind_study<ValidityResult>(module, "ValidityStudy", &io::validity_tables);
  bind_study<AssignmentResult>(module, "AssignmentStudy", &io::assignment_csv, &assignment_arrays)
      .def_property_readonly(
          "exit_code", [](const Studied<AssignmentResult>& s) { return exit_code(*s.result()); });
  module.def("study_assignment", &assign, py::arg("scene"), py::arg("progress"));
  module.def("study_transfers", &study_transfers, py::arg("scene"), py::arg("progress"));
  module.def("study_motion", &study_motion, py::arg("scene"), py::arg("progress"));
  module.def("study_separations", &study_separations, py::arg("scene"), py::arg("progress"));
}

}  // namespace hamjet::python
