#include "hamjet/detail/studies/self_check_settings.hpp"

namespace hamjet {

const std::vector<std::string_view>& self_check_names() {
  static const std::vector<std::string_view> names = {"finite",  "convergence",   "step-error",
                                                      "energy",  "symplecticity", "inversion",
                                                      "surface", "error-estimate"};
  return names;
}

}  // namespace hamjet
