#include "hamjet/integrators/energy_conserving.hpp"

namespace hamjet {

const std::vector<std::string_view>& energy_conserving_method_names() {
  static const std::vector<std::string_view> names = {"stormer", "midpoint"};
  return names;
}

}  // namespace hamjet
