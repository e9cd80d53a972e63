#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "hamjet/maps/map_evaluator.hpp"

namespace hamjet::python {

/// Evaluates a map at `count` points, which lie row by row (as NumPy's default order has them), and
/// writes its values row by row. A block of points is read whole before its values are written, so
/// that a map of as many components as variables may write in place. Returns the number of values
/// that are not finite. `pause` is called now and then and may throw.
std::size_t evaluate_rows(const MapEvaluator& map, const double* points, std::size_t count,
                          double* values, const std::function<void()>& pause);

}  // namespace hamjet::python
