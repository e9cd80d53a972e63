#pragma once

#include <string>

#include "arrays.hpp"
#include "hamjet/maps/map_evaluator.hpp"

namespace hamjet::python {

/// Numbers row by row, `columns` a row, as they are if they are aligned float64 in C order, else
/// converted. A one-dimensional array is one row. Throws Error(usage), naming `what`, for another
/// shape or what are no real numbers.
py::array_t<double> rows_of(const py::object& points, std::size_t columns, const std::string& what);

/// Values of a map at an array of points (N, variables) or (variables,), in a new array (N,
/// components) or (components,), or in `out` if that is not None. Without the GIL; warns if values
/// are not finite. Throws Error(usage).
py::object evaluate_array(const MapEvaluator& map, const py::object& points, const py::object& out,
                          const std::string& what);

/// RuntimeWarning of numbers that are not finite, as NumPy gives one where it overflows.
void warn_if_not_finite(std::size_t count, const std::string& what);

}  // namespace hamjet::python
