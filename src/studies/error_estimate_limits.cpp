#include "error_estimate_limits.hpp"

#include <algorithm>
#include <cmath>

#include "hamjet/integrators/error_estimate.hpp"
#include "largest_coefficient.hpp"
#include "number_scan.hpp"

namespace hamjet {
namespace {

/// How often a run's tolerance may count: once a period of the linearised motion for Gauss, whose
/// tolerance is that of the error after one; once a step for the others, whose tolerance is that of
/// a step.
double tolerance_count(const RunResult& run) {
  const bool is_gauss = run.settings.method == IntegrationMethod::gauss;
  return std::max(1.0,
                  is_gauss ? run.statistics.periods : static_cast<double>(run.statistics.steps));
}

/// By degree, by how much half-ulp changes of the start alone change the coefficients, relative to
/// the largest: those of degree d by the derivatives of the flow of one degree more. The last
/// degree is taken to grow as the one before.
std::vector<double> half_ulp_changes(const Scene& scene, const RunResult& run) {
  double size = 0;
  for (const double x : scene.nominal) size = std::max(size, std::abs(x));
  std::vector<double> changes;
  for (int d = 0; d < scene.order; ++d) {
    const double at = d == 0 ? size : largest_coefficient(run.jet, d);
    const double above = largest_coefficient(run.jet, d + 1);
    changes.push_back(
        at > 0 ? 0.5 * rounding_of(scene.precision) * (1 + (d + 1) * above * size / at) : 0);
  }
  changes.push_back(changes.back() * (scene.order + 1) / scene.order);
  return changes;
}

std::vector<double> promised_errors(const Scene& scene, const RunResult& run) {
  std::vector<double> promised = half_ulp_changes(scene, run);
  const std::vector<double>& measured = run.statistics.rounding_by_degree;
  const double steps = static_cast<double>(run.statistics.steps);
  for (std::size_t d = 0; d < promised.size(); ++d) {
    double floor = std::sqrt(1 + steps) * promised[d];
    if (d < measured.size()) floor = std::max(floor, measured[d]);
    // A degree without three digits is none, even where rounding is the reason.
    const double error = std::min(10 * floor, largest_delivered_rounding) +
                         100 * *run.settings.tolerance * tolerance_count(run);
    promised[d] = error_estimate_safety * error;
  }
  return promised;
}

}  // namespace

std::vector<double> error_estimate_limits(const Scene& scene, const RunResult& run) {
  if (const auto& limit = scene.checks[SelfCheckName::error_estimate].limit) {
    return std::vector<double>(static_cast<std::size_t>(scene.order) + 1, *limit);
  }
  return run.settings.tolerance ? promised_errors(scene, run) : std::vector<double>();
}

bool exceeds_limits(const std::vector<double>& estimate, const std::vector<double>& limits) {
  for (std::size_t d = 0; d < limits.size(); ++d) {
    if (!(estimate[d] <= limits[d])) return true;
  }
  return false;
}

}  // namespace hamjet
