#include "hamjet/studies/scene.hpp"

namespace hamjet {

const std::vector<std::string_view>& model_names() {
  static const std::vector<std::string_view> names = {"zonal-gravity", "kepler",
                                                      "harmonic-oscillator", "double-well"};
  return names;
}

bool is_orbit(SystemModel model) {
  return model == SystemModel::zonal_gravity || model == SystemModel::kepler;
}

std::vector<std::string_view> variable_names(SystemModel model) {
  if (!is_orbit(model)) return {"q", "p"};
  return {"x", "y", "z", "px", "py", "pz"};
}

const std::vector<std::string_view>& method_names() {
  static const std::vector<std::string_view> names = {
      "gauss", "stormer", "velocity-verlet", "newmark", "fehlberg78", "cvode-adams", "cvode-bdf"};
  return names;
}

bool is_cvode(IntegrationMethod method) {
  return method == IntegrationMethod::cvode_adams || method == IntegrationMethod::cvode_bdf;
}

}  // namespace hamjet
