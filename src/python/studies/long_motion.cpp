#include <numbers>

#include "../../report/bounded/bounded_report.hpp"
#include "../../report/bounded/event_report.hpp"
#include "../../report/bounded/frozen_orbit_report.hpp"
#include "../../studies/bounded/relative_orbit_extent.hpp"
#include "../bindings.hpp"
#include "studied.hpp"

namespace hamjet::python {
namespace {

Studied<FrozenOrbitStudy> study_poincare(const GivenScene& given, const py::object& progress) {
  return studied(given, progress, "", &study_frozen_orbit, &io::frozen_orbit_report);
}

Studied<BoundedFormation> study_company(const GivenScene& given, const py::object& progress) {
  return studied(given, progress, "bounded", &study_bounded, &io::bounded_report);
}

Studied<EventStudy> study_condition(const GivenScene& given, const py::object& progress) {
  return studied(given, progress, "event", &study_event, &io::event_report);
}

py::dict event_arrays(const EventStudy& study) {
  const EventMap<double> told = study.told_map();
  const CanonicalUnits& units = told_units(study.scene);
  const SeriesSpace& space = told.time.space();
  Table state, exponents, coefficients, amplitude, position, time, linear_position, linear_time;
  for (const double x : told_state(study.scene, study.state())) state.add(x);
  for (std::size_t k = 0; k < space.size(); ++k) {
    for (const auto exponent : space.exponents(k)) exponents.add(exponent);
    coefficients.add(told.time[k]);
    for (const Series<double>& component : told.state) coefficients.add(component[k]);
  }
  for (const EventMisses& one : study.misses) {
    amplitude.add(one.amplitude_m);
    position.add(one.position_m.value_or(none));
    time.add(one.time_s.value_or(none));
    linear_position.add(one.linear_position_m.value_or(none));
    linear_time.add(one.linear_time_s.value_or(none));
  }
  const auto count = size_of(space.size());
  py::dict arrays;
  arrays["time_s"] = study.time_s();
  arrays["state_canonical"] = state.array();
  arrays["exponents"] = exponents.array({count, 6});
  arrays["coefficients"] = coefficients.array({count, 7});
  arrays["length_km"] = units.length_km;
  arrays["time_unit_s"] = units.time_s;
  arrays["amplitudes_m"] = amplitude.array();
  arrays["misses_m"] = position.array();
  arrays["misses_s"] = time.array();
  arrays["linear_misses_m"] = linear_position.array();
  arrays["linear_misses_s"] = linear_time.array();
  arrays["rounding_m"] = study.position_rounding_m;
  arrays["verdict"] = io::event_verdict(study);
  return arrays;
}

py::dict poincare_arrays(const FrozenOrbitStudy& study) {
  const double time_s = study.scene.units.time_s;
  constexpr double degrees = 180 / std::numbers::pi;
  Table state, amplitude, rotation, period, node, miss;
  for (const double x : told_state(study.scene, study.state)) state.add(x);
  std::vector<bool> chief;
  for (const LibrationCircle& circle : study.circles) {
    amplitude.add(study.length_m(circle.amplitude));
    rotation.add(circle.rotation_number);
    period.add(circle.mean_period * time_s);
    node.add(circle.mean_node * degrees);
    miss.add(circle.miss.value_or(none));
    chief.push_back(circle.is_chiefs);
  }
  py::dict arrays;
  arrays["state_canonical"] = state.array();
  arrays["a_km"] = study.semi_major_axis * study.scene.units.length_km;
  arrays["e"] = study.eccentricity;
  arrays["i_deg"] = study.inclination_deg;
  arrays["argp_deg"] = study.pericentre_deg;
  arrays["nodal_period_s"] = study.nodal_period * time_s;
  arrays["residual"] = study.residual;
  arrays["trace_less_2"] = study.trace_less_2;
  arrays["stable"] = study.is_stable();
  arrays["amplitudes_m"] = amplitude.array();
  arrays["is_chiefs"] = flags(chief);
  arrays["rotation_numbers"] = rotation.array();
  arrays["mean_nodal_periods_s"] = period.array();
  arrays["node_deg_per_revolution"] = node.array();
  arrays["misses"] = miss.array();
  arrays["reach_m"] = study.failure.empty() ? study.length_m(study.reach) : none;
  arrays["failure"] = study.failure;
  arrays["verdict"] = io::frozen_orbit_verdict(study);
  return arrays;
}

py::dict bounded_arrays(const BoundedFormation& formation) {
  Table wanted, size, widths, along, doubts, cross, start;
  py::list rules, failures;
  const Eigen::Vector3d nothing = Eigen::Vector3d::Constant(none);
  for (const BoundedDeputy& deputy : formation.deputies) {
    const bool is_there = deputy.failure.empty();
    wanted.add(deputy.wanted_m);
    size.add(is_there ? deputy.size_m : none);
    widths.add(is_there ? half_widths_m(deputy.first) : nothing);
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      along.add(is_there ? deputy.drifts[k].along : none);
      doubts.add(is_there ? deputy.drifts[k].along_doubt : none);
      cross.add(is_there ? deputy.drifts[k].cross : none);
    }
    const auto& rtn = deputy.forms[static_cast<std::size_t>(DeputyForm::rtn_rotating)];
    for (const double x : rtn) start.add(is_there ? x : none);
    rules.append(py::str(std::string(name_of(deputy.rule))));
    failures.append(py::str(deputy.failure));
  }
  const auto count = size_of(formation.deputies.size());
  py::dict arrays;
  arrays["rules"] = py::tuple(rules);
  arrays["wanted_m"] = wanted.array();
  arrays["size_m"] = size.array();
  arrays["half_widths_m"] = widths.array({count, 3});
  arrays["along_drifts"] = along.array({count, 2});
  arrays["along_doubts"] = doubts.array({count, 2});
  arrays["cross_drifts"] = cross.array({count, 2});
  arrays["starts"] = start.array({count, 6});
  arrays["revolutions"] = formation.revolutions;
  arrays["failures"] = py::tuple(failures);
  Table changes, durations, moments;
  if (formation.box) {
    for (const BoxReturn& one : formation.box->returns) {
      moments.add(one.time * formation.scene.units.time_s);
      durations.add(one.duration * formation.scene.units.time_s);
      changes.add(one.change_m_s());
    }
  }
  arrays["box_return_times_s"] = moments.array();
  arrays["box_return_durations_s"] = durations.array();
  arrays["box_changes_m_s"] = changes.array();
  arrays["box_change_m_s_a_day"] = formation.box ? formation.box->change_a_day_m_s() : none;
  arrays["box_farthest"] = formation.box ? formation.box->farthest : none;
  arrays["verdict"] = io::bounded_verdict(formation);
  return arrays;
}

}  // namespace

void bind_long_motion(py::module_& module) {
  bind_study<FrozenOrbitStudy>(module, "PoincareStudy", &io::frozen_orbit_csv, &poincare_arrays);
  bind_study<BoundedFormation>(module, "BoundedStudy", &io::bounded_csv, &bounded_arrays);
  bind_study<EventStudy>(module, "EventStudy", &io::event_csv, &event_arrays);
  module.def("study_event", &study_condition, py::arg("scene"), py::arg("progress"));
  module.def("study_poincare", &study_poincare, py::arg("scene"), py::arg("progress"));
  module.def("study_bounded", &study_company, py::arg("scene"), py::arg("progress"));
}

}  // namespace hamjet::python
