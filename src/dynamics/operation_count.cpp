#include "operation_count.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace hamjet {

double series_multiply_adds(const OperationList& recorded, const SeriesSpace& space,
                            int working_order) {
  const OperationList list = expand_fields(recorded, working_order);
  double product = 0;
  double square = 0;
  for (int d = 1; d <= working_order; ++d) {
    product += static_cast<double>(space.products(d).multiply_adds);
    square += static_cast<double>(space.products(d).square_multiply_adds);
  }
  double total = 0;
  const int order = std::max(working_order, 1);
  std::map<std::pair<const LocalField*, std::array<std::size_t, 3>>, int> points;
  for (std::size_t i = 0; i < list.operations().size(); ++i) {
    const Operation& o = list.operations()[i];
    for (const FieldPart& part : o.parts) {
      int& orders = points[{part.field.get(), part.position}];
      orders = std::max(orders, part.orders[0] + part.orders[1] + part.orders[2]);
    }
    if (!list.has_sums(i)) continue;
    if (o.code == OperationCode::field) {
      total += static_cast<double>(o.terms.size()) * product;
      for (const FieldProduct& p : o.products) {
        // This counts the product's share in a cofactor, whose slices begin with the degree of the
        // factor.
        for (int d = 1; d < working_order; ++d) {
          if (p.monomial < local_field_size(d + 1)) total += static_cast<double>(space.count(d));
        }
      }
      continue;
    }
    if (o.code == OperationCode::deviation_product) {
      for (int d = o.lowest[0] + o.lowest[1]; d < working_order; ++d) {
        const ProductSchedule& schedule =
            space.products_above(d, o.lowest[0], o.lowest[1], o.u == o.v);
        total += static_cast<double>(o.u == o.v ? schedule.square_multiply_adds
                                                : schedule.multiply_adds);
      }
      continue;
    }
    const bool is_square = o.code == OperationCode::square ||
                           (o.code == OperationCode::power && o.constant == Extended(0.5));
    total += is_square ? square : product;
  }
  for (const auto& [point, orders] : points) total += point.first->multiply_adds(order + orders);
  return total;
}

}  // namespace hamjet
