#include "hamjet/studies/scene.hpp"

namespace hamjet {

const std::vector<std::string_view>& model_names() {
  static const std::vector<std::string_view> names = {"zonal-gravity", "kepler",
                                                      "harmonic-oscillator"};
  return names;
}

std::vector<std::string_view> variable_names(SystemModel model) {
  if (model == SystemModel::harmonic_oscillator) return {"q", "p"};
  return {"x", "y", "z", "px", "py", "pz"};
}

const std::vector<std::string_view>& method_names() {
  static const std::vector<std::string_view> names = {
      "gauss", "stormer", "velocity-verlet", "newmark", "fehlberg78", "cvode-adams", "cvode-bdf"};
  return names;
}

}  // namespace hamjet
