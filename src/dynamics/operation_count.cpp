#include "operation_count.hpp"

namespace hamjet {

double series_multiply_adds(const OperationList& list, const SeriesSpace& space,
                            int working_order) {
  double product = 0;
  double square = 0;
  for (int d = 1; d <= working_order; ++d) {
    product += static_cast<double>(space.products(d).multiply_adds);
    square += static_cast<double>(space.products(d).square_multiply_adds);
  }
  double total = 0;
  for (const Operation& o : list.operations()) {
    if (o.code == OperationCode::input || o.code == OperationCode::linear) continue;
    const bool is_square = o.code == OperationCode::square ||
                           (o.code == OperationCode::power && o.constant == Extended(0.5));
    total += is_square ? square : product;
  }
  return total;
}

}  // namespace hamjet
