#include "hamjet/detail/dynamics/local_field.hpp"

#include <vector>

namespace hamjet {

void LocalField::expand(std::size_t count, const DoubleDouble* x, const DoubleDouble* y,
                        const DoubleDouble* z, int degree, DoubleDouble* out) const {
  const auto extended = [count](const DoubleDouble* values) {
    std::vector<Extended> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(Extended(values[i]));
    return result;
  };
  std::vector<Extended> coefficients(local_field_size(degree) * count);
  expand(count, extended(x).data(), extended(y).data(), extended(z).data(), degree,
         coefficients.data());
  for (std::size_t i = 0; i < coefficients.size(); ++i) out[i] = DoubleDouble(coefficients[i]);
}

}  // namespace hamjet
