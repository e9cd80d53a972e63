#include <fmt/format.h>

#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

void validate_gauss(const GaussSettings& settings) {
  if (settings.stages < 1 || settings.stages > 16) {
    throw Error(ErrorKind::usage,
                fmt::format("Gauss: {} stages, allowed are 1..16", settings.stages));
  }
  if (settings.step.has_value() == settings.tolerance.has_value()) {
    throw Error(ErrorKind::usage, "Gauss: exactly one of step and tolerance must be given");
  }
  if (!(settings.step.value_or(1) > 0) || !(settings.tolerance.value_or(0.5) > 0) ||
      !(settings.tolerance.value_or(0.5) < 1)) {
    throw Error(ErrorKind::usage,
                "Gauss: the step must be positive, the tolerance between 0 and 1");
  }
}

}  // namespace hamjet
