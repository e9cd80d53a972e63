#include "default_integrator.hpp"

#include <fmt/format.h>

#include "../studies/descriptions/method_description.hpp"

namespace hamjet::io {

std::string default_label(const IntegratorSettings& settings) {
  ComparisonSettings wanted;
  wanted.stages = {settings.stages};
  const MethodDescription& method = description_of(settings.method);
  for (const ComparedForm& form : method.compared_forms(wanted)) {
    IntegratorSettings same_method = form.settings;
    same_method.method = settings.method;
    if (compared_values(same_method) == compared_values(settings)) return form.label;
  }
  return std::string(method.name);
}

IntegratorSettings default_integrator() {
  IntegratorSettings settings;
  settings.method = IntegrationMethod::gauss;
  settings.stages = 8;
  settings.tolerance = 1e-12;
  settings.label = default_label(settings);
  return settings;
}

const std::string& default_integrator_text() {
  static const std::string text = [] {
    const IntegratorSettings settings = default_integrator();
    return fmt::format("Gauss, {} stages, tolerance {:g}", settings.stages, *settings.tolerance);
  }();
  return text;
}

const std::string& default_integrator_table() {
  static const std::string table = [] {
    const IntegratorSettings settings = default_integrator();
    return fmt::format(
        "[[integrator]]\nlabel = \"{}\"\nmethod = \"{}\"\nstages = {}\ntolerance = {:e}\n",
        settings.label, method_name(settings.method), settings.stages, *settings.tolerance);
  }();
  return table;
}

}  // namespace hamjet::io
