#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/detail/studies/fields.hpp"

namespace hamjet {

/// The integrators of flow jets. MethodDescription describes their differences.
enum class IntegrationMethod {
  gauss,
  stormer,
  velocity_verlet,
  newmark,
  fehlberg78,
  cvode_adams,
  cvode_bdf,
};

/// One table `[[integrator]]`. MethodDescription says which of the keys a method has.
struct IntegratorSettings {
  std::string label = {};
  IntegrationMethod method = IntegrationMethod::gauss;
  int stages = 8;
  int order = 2;
  double beta = 0.25;
  bool compensated_summation = true;
  std::optional<double> step_canonical =
      {};  ///< fixed steps (positive; the sign follows the duration)
  std::optional<double> tolerance =
      {};  ///< adaptive steps; exactly one of step and tolerance is set
  std::optional<double> require_relative_error =
      {};  ///< check: largest relative error over all degrees
  std::optional<double> require_symplecticity = {};  ///< check: largest scaled symplecticity defect
};
HAMJET_FIELDS(IntegratorSettings, label, method, stages, order, beta, compensated_summation,
              step_canonical, tolerance, require_relative_error, require_symplecticity)

/// The methods' names in scenes, in the order of the enumeration.
const std::vector<std::string_view>& method_names();

/// The name of a method in scenes and results.
std::string_view method_name(IntegrationMethod method);

}  // namespace hamjet
