#pragma once

#include <memory>

#include "bindings.hpp"
#include "jet.hpp"

namespace hamjet::python {

/// Binds what makes a jet of coefficients that did not come from hamjet.
void bind_jet_arrays(pybind11::class_<Jet, std::shared_ptr<Jet>>& jet);

}  // namespace hamjet::python
