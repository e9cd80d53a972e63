#include "hamjet/studies/scene.hpp"

#include <limits>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

double rounding_of(Precision precision) {
  return precision == Precision::double_precision
             ? std::numeric_limits<double>::epsilon()
             : static_cast<double>(std::numeric_limits<Extended>::epsilon());
}

}  // namespace hamjet
