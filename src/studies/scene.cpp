#include "hamjet/studies/scene.hpp"

#include <iterator>
#include <limits>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

double rounding_of(Precision precision) {
  return precision == Precision::double_precision
             ? std::numeric_limits<double>::epsilon()
             : static_cast<double>(std::numeric_limits<Extended>::epsilon());
}

const std::vector<std::string_view>& model_names() {
  static const std::vector<std::string_view> names = {
      "zonal-gravity",   "kepler",          "harmonic-oscillator", "double-well",
      "oscillator-pair", "spring-pendulum", "fermi-pasta-ulam"};
  return names;
}

bool is_orbit(SystemModel model) {
  return model == SystemModel::zonal_gravity || model == SystemModel::kepler;
}

std::vector<std::size_t> possible_degrees_of_freedom(SystemModel model) {
  switch (model) {
    case SystemModel::zonal_gravity:
    case SystemModel::kepler:
      return {3};
    case SystemModel::oscillator_pair:
    case SystemModel::spring_pendulum:
      return {2};
    case SystemModel::fermi_pasta_ulam:
      return {2, 4, 6, 8};
    case SystemModel::harmonic_oscillator:
    case SystemModel::double_well:
      break;
  }
  return {1};
}

std::vector<std::string_view> variable_names(SystemModel model, std::size_t degrees_of_freedom) {
  static constexpr std::string_view positions[] = {"q1", "q2", "q3", "q4", "q5", "q6", "q7", "q8"};
  static constexpr std::string_view momenta[] = {"p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8"};
  if (is_orbit(model)) return {"x", "y", "z", "px", "py", "pz"};
  if (degrees_of_freedom == 1) return {"q", "p"};
  std::vector<std::string_view> names(std::begin(positions),
                                      std::begin(positions) + degrees_of_freedom);
  names.insert(names.end(), std::begin(momenta), std::begin(momenta) + degrees_of_freedom);
  return names;
}

std::size_t degrees_of_freedom_of(const SystemSettings& settings) {
  if (settings.model == SystemModel::fermi_pasta_ulam) return 2 * settings.pairs;
  return possible_degrees_of_freedom(settings.model).front();
}

std::vector<std::string_view> variable_names(const SystemSettings& settings) {
  return variable_names(settings.model, degrees_of_freedom_of(settings));
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
