#include "energy_conservation.hpp"

namespace hamjet {

const std::vector<std::string_view>& energy_conservation_outcome_names() {
  static const std::vector<std::string_view> names = {"completes", "stops"};
  return names;
}

}  // namespace hamjet
