#include "../../report/bounded/event_report.hpp"
#include "../bindings.hpp"
#include "studied.hpp"

namespace hamjet::python {
namespace {

Studied<EventStudy> study_condition(const GivenScene& given, const py::object& progress) {
  return studied(given, progress, "event", &study_event, &io::event_report);
}

/// The polynomials of the time and of the state at the event, a row a monomial.
py::dict event_polynomials(const EventStudy& study) {
  const EventMap<double> told = study.told_map();
  const CanonicalUnits& units = told_units(study.scene);
  const SeriesSpace& space = told.time.space();
  Table exponents, coefficients;
  for (std::size_t k = 0; k < space.size(); ++k) {
    for (const auto exponent : space.exponents(k)) exponents.add(exponent);
    coefficients.add(told.time[k]);
    for (const Series<double>& component : told.state) coefficients.add(component[k]);
  }
  const auto count = size_of(space.size());
  py::dict polynomials;
  polynomials["exponents"] = exponents.array({count, 6});
  polynomials["coefficients"] = coefficients.array({count, 7});
  polynomials["length_km"] = units.length_km;
  polynomials["time_unit_s"] = units.time_s;
  return polynomials;
}

}  // namespace

void bind_long_motion(py::module_& module) {
  bind_study<EventStudy>(module, "EventStudy", &io::event_tables)
      .def("polynomials",
           [](const Studied<EventStudy>& s) { return event_polynomials(*s.result()); });
  module.def("study_event", &study_condition, py::arg("scene"), py::arg("progress"));
}

}  // namespace hamjet::python
