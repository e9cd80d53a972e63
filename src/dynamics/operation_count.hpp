#pragma once

#include "hamjet/algebra/series_space.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// Multiply-adds of one evaluation of a list on series up to a degree, counting products of series
/// alone: the measure of work that time is compared with. A sine and its cosine are two products.
double series_multiply_adds(const OperationList& list, const SeriesSpace& space, int working_order);

}  // namespace hamjet
