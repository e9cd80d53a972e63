#pragma once

#include <memory>

#include "bindings.hpp"
#include "jet.hpp"

namespace hamjet::python {

/// Binds what writes one jet to a file and reads it, as `hamjet convert` does.
void bind_jet_files(pybind11::module_& module, pybind11::class_<Jet, std::shared_ptr<Jet>>& jet);

}  // namespace hamjet::python
