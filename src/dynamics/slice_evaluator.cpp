#include "hamjet/detail/dynamics/slice_evaluator.hpp"

#include "../algebra/instantiated_real.hpp"

namespace hamjet {

template class SliceEvaluator<InstantiatedReal, InstantiatedReal>;

}  // namespace hamjet
