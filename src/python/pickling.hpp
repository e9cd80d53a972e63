#pragma once

#include <pybind11/pybind11.h>

#include "hamjet/detail/report/study_report.hpp"
#include "inverted_jet.hpp"
#include "jet.hpp"
#include "studies/polynomials_study.hpp"

namespace hamjet::python {

/// What Python's pickle stores of an object: a function of the package and its arguments, of which
/// the function makes the same object bit by bit.
pybind11::tuple reduced(const CanonicalUnits& units);
pybind11::tuple reduced(const Jet& jet);
pybind11::tuple reduced(const PolynomialsStudy& study);
pybind11::tuple reduced(const InvertedJet& function);
pybind11::tuple reduced(const io::StudyReport& report);

/// Pickling by reduced(); a copy of what is immutable is the object itself.
template <class PythonClass>
void bind_copies(PythonClass& python_class) {
  using Value = typename PythonClass::type;
  const auto itself = [](pybind11::object self) { return self; };
  python_class.def("__reduce__", [](const Value& self) { return reduced(self); })
      .def("__copy__", itself)
      .def("__deepcopy__", [](pybind11::object self, const pybind11::object&) { return self; });
}

}  // namespace hamjet::python
