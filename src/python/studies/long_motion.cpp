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
  const FlowJet<double> told = io::told_polynomials(study);
  const CanonicalUnits& units = told_units(study.scene);
  const SeriesSpace& space = told[0].space();
  Table exponents, coefficients;
  for (std::size_t k = 0; k < space.size(); ++k) {
    for (const auto exponent : space.exponents(k)) exponents.add(exponent);
    for (const Series<double>& series : told) coefficients.add(series[k]);
  }
  const auto count = size_of(space.size());
  py::dict polynomials;
  polynomials["exponents"] = exponents.array({count, size_of(space.variables())});
  polynomials["coefficients"] = coefficients.array({count, size_of(told.size())});
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
