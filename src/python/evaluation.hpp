#pragma once

#include <functional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "hamjet/maps/map_evaluator.hpp"

namespace hamjet::python {

/// The names of the columns of points; asked for only where the points are labelled.
using ColumnNames = std::function<std::vector<std::string>()>;

/// Numbers row by row, `columns` a row, as they are if they are aligned float64 in C order, else
/// converted. A one-dimensional array is one row. A data frame (what has `columns`) and a row of
/// one (what has labels as its `index`) are taken by name, whatever the order. Throws Error(usage),
/// naming `what`, for another shape, other names, or what are no real numbers.
py::array_t<double> rows_of(const py::object& points, std::size_t columns, const ColumnNames& names,
                            const std::string& what);

/// Values of a map at an array of points (N, variables) or (variables,), in a new array (N,
/// components) or (components,), or in `out` if that is not None. Points are taken as by rows_of.
/// Works without the GIL; warns if values are not finite. Throws Error(usage).
py::object evaluate_array(const MapEvaluator& map, const py::object& points,
                          const ColumnNames& names, const py::object& out, const std::string& what);

/// Gives a RuntimeWarning about `count` numbers that are not finite, as NumPy gives one where it
/// overflows.
void warn_if_not_finite(std::size_t count, const std::string& what);

}  // namespace hamjet::python
