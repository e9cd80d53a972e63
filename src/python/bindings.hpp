#pragma once

#include <pybind11/pybind11.h>

// One function for each part of the extension module, in the file of its name.

namespace hamjet::python {

void bind_errors();
/// Binds the functions that pickle calls.
void bind_pickling(pybind11::module_& module);
void bind_jets(pybind11::module_& module);
void bind_generating_functions(pybind11::module_& module);
void bind_scenes(pybind11::module_& module);
void bind_axes(pybind11::module_& module);
void bind_elements(pybind11::module_& module);
void bind_orbit_keys(pybind11::module_& module);
void bind_runs(pybind11::module_& module);
void bind_relative_motion(pybind11::module_& module);
void bind_long_motion(pybind11::module_& module);
void bind_plain_studies(pybind11::module_& module);
void bind_trajectory(pybind11::module_& module);
void bind_polynomials(pybind11::module_& module);
void bind_uncertainty(pybind11::module_& module);
void bind_many(pybind11::module_& module);

}  // namespace hamjet::python
