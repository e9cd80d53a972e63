#include "bindings.hpp"
#include "hamjet/version.hpp"

PYBIND11_MODULE(_hamjet, module) {
  module.doc() = "The compiled part of the package hamjet, which is what is meant to be used.";
  module.attr("__version__") = hamjet::version;
  // Types of C++ in signatures say nothing to Python; those that are written do.
  pybind11::options options;
  options.disable_function_signatures();
  hamjet::python::bind_errors();
  hamjet::python::bind_pickling(module);
  // In this order: the help of a method shows the Python name of a class only once it is bound.
  hamjet::python::bind_generating_functions(module);
  hamjet::python::bind_jets(module);
  hamjet::python::bind_scenes(module);
  hamjet::python::bind_axes(module);
  hamjet::python::bind_elements(module);
  hamjet::python::bind_orbit_keys(module);
  hamjet::python::bind_runs(module);
  hamjet::python::bind_relative_motion(module);
  hamjet::python::bind_long_motion(module);
  hamjet::python::bind_plain_studies(module);
  hamjet::python::bind_uncertainty(module);
  hamjet::python::bind_trajectory(module);
  hamjet::python::bind_polynomials(module);
  hamjet::python::bind_many(module);
}
