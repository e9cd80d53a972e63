#include "discretization.hpp"

namespace hamjet {

const std::vector<std::string_view>& discretization_names() {
  static const std::vector<std::string_view> names = {"stormer", "midpoint"};
  return names;
}

double state_weight(Discretization discretization) {
  return discretization == Discretization::stormer ? 0 : 0.5;
}

double costate_weight(Discretization discretization) {
  return discretization == Discretization::stormer ? 1 : 0.5;
}

}  // namespace hamjet
