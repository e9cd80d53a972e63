#include "near_singular.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace hamjet {
namespace {

constexpr double largest_quiet_error = 1e-6;
/// Below this a large error is that of the integrator's steps, not of the kind.
constexpr double smallest_near_singular_amplification = 1e4;

/// The relative error of the map's linear part.
double linear_error(const Scene& scene, const RunResult& run) {
  const auto& by_degree = run.error_by_degree ? run.error_by_degree : run.error_estimate.by_degree;
  const double known = by_degree && by_degree->size() > 1 ? (*by_degree)[1] : 0;
  return std::max(known, rounding_of(scene.precision));
}

}  // namespace

std::string near_singular_warning(const Scene& scene, const RunResult& run) {
  if (!run.inversion || run.inversion->kinds == 0) return "";
  const double amplification = run.inversion->amplification;
  const double error = linear_error(scene, run);
  if (amplification < smallest_near_singular_amplification ||
      amplification * error <= largest_quiet_error) {
    return "";
  }
  return fmt::format(
      "{} is near one of its singular times: it amplifies the error of the map's linear part, "
      "{:.2g}, up to {:.2g}-fold, to {:.2g} of its own linear part, and no less at higher degrees",
      run.inversion->amplified_kind, error, amplification, amplification * error);
}

}  // namespace hamjet
