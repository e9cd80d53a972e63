#pragma once

#include <pybind11/pybind11.h>

#include "relative_evaluation.hpp"

namespace hamjet::python {

/// A RelativeStates, which the package defines, of the rows of `states`: carried through a stored
/// jet or through the polynomials of a scene. `chief` is what the coordinates are about. Warns if a
/// row is not inside the polynomials' reach, or throws Error(numerical) if that `is_strict`; throws
/// as evaluate_relative.
template <class Source>
pybind11::object relative_states(const io::StoredJet& chief, const Source& source,
                                 const pybind11::object& states,
                                 const RelativeCoordinates& coordinates, bool is_strict);

}  // namespace hamjet::python
