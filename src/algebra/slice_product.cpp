#include "hamjet/detail/algebra/slice_product.hpp"

namespace hamjet::detail {

HAMJET_COMPILED_BLOCKS()

}  // namespace hamjet::detail
