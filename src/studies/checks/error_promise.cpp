#include "error_promise.hpp"

#include <algorithm>
#include <cmath>

#include "../../integrators/momentum_unit.hpp"
#include "../descriptions/method_description.hpp"
#include "../largest_coefficient.hpp"

namespace hamjet {
namespace {

constexpr double largest_rounding = 1e-3;  ///< relative rounding of a degree that is still usable
/// The factor by which an estimate of rounding may exceed the measured floor. Among 1033 degrees of
/// 260 random jets that rounding limits (error_estimate_statistics floors), the ratio was above ten
/// in 1.7 %, above twenty in 0.2 %, and 1.4 in the median.
constexpr double rounding_scatter = 20;

/// The number of times that a run's tolerance counts: once per period of the linearised motion for
/// Gauss, whose tolerance is the error after one period; once per step for the others, whose
/// tolerance is that of a step.
double tolerance_count(const RunResult& run) {
  return std::max(1.0, is_tolerance_of_jet(run) ? run.statistics.periods
                                                : static_cast<double>(run.statistics.steps));
}

/// By degree, the change of the coefficients, relative to the largest, that half-ulp changes of the
/// start alone cause. Degree d changes by the coefficients of degree d + 1; the last degree is
/// assumed to grow as the one before.
std::vector<double> half_ulp_changes(const Scene& scene, const RunResult& run) {
  const int exponent = natural_momentum_exponent(is_orbit(scene.system.model), scene.nominal);
  const FlowJet<Extended> jet = comparable_jet(scene, run);
  const std::size_t n = degrees_of_freedom_of(scene.system);
  double size = 0;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const int momentum = i < n ? 0 : exponent;
    size = std::max(size, std::ldexp(std::abs(scene.nominal[i]), -momentum));
  }
  std::vector<double> changes;
  for (int d = 0; d < scene.order; ++d) {
    const double at = d == 0 ? size : largest_coefficient(jet, d);
    const double above = largest_coefficient(jet, d + 1);
    changes.push_back(
        at > 0 ? 0.5 * rounding_of(scene.precision) * (1 + (d + 1) * above * size / at) : 0);
  }
  changes.push_back(changes.back() * (scene.order + 1) / scene.order);
  return changes;
}

}  // namespace

FlowJet<Extended> comparable_jet(const Scene& scene, const RunResult& run) {
  const std::size_t of_model = degrees_of_freedom_of(scene.system);
  const std::size_t of_jet = (run.jet.size() - (scene.nominal.size() - 2 * of_model)) / 2;
  return compared_components(
      run.jet, kinds_of_variables(scene.variables, of_model, of_jet), of_jet,
      natural_momentum_exponent(is_orbit(scene.system.model), scene.nominal));
}

PromisedErrors promised_errors(const Scene& scene, const RunResult& run) {
  PromisedErrors promised;
  promised.of_tolerance = 100 * *run.settings.tolerance * tolerance_count(run);
  promised.total = half_ulp_changes(scene, run);
  const std::vector<double>& measured = run.statistics.rounding_by_degree;
  const double steps = static_cast<double>(run.statistics.steps);
  for (std::size_t d = 0; d < promised.total.size(); ++d) {
    double floor = std::sqrt(1 + steps) * promised.total[d];
    if (d < measured.size()) floor = std::max(floor, measured[d]);
    promised.rounding.push_back(floor);
    // A degree with fewer than three digits is not accepted, even if rounding is the reason.
    promised.total[d] =
        promised.of_tolerance + std::min(rounding_scatter * floor, largest_rounding);
  }
  return promised;
}

bool is_tolerance_of_jet(const RunResult& run) {
  return description_of(run.settings.method).tolerance_is_of_the_jet;
}

bool exceeds_promise(const Scene& scene, const RunResult& run) {
  const auto& estimate = run.error_estimate.by_degree;
  if (!estimate || scene.checks[SelfCheckName::error_estimate].limit) return false;
  const std::vector<double> most = promised_errors(scene, run).total;
  for (std::size_t d = 0; d < estimate->size(); ++d) {
    if (!((*estimate)[d] <= most[d])) return true;
  }
  return false;
}

}  // namespace hamjet
