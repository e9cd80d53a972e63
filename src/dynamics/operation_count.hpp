#pragma once

#include "hamjet/algebra/series_space.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// Multiply-adds of one evaluation of a list on series up to a degree, where products of series
/// and expansions of fields are counted. Run times are compared with this measure of work. A sine
/// and its cosine count as two products.
double series_multiply_adds(const OperationList& list, const SeriesSpace& space, int working_order);

}  // namespace hamjet
