#include "run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "../../algebra/raise_to.hpp"
#include "../../astronomy/sunlight.hpp"
#include "../formation/charts/charted_jet.hpp"
#include "kept_tolerance.hpp"

namespace hamjet {
namespace {

/// Two digits better than any user needs in the linear part: higher degrees lose some thousand
/// times more (Kepler's circle just after a revolution, F1 of degree 5).
constexpr double largest_quiet_error = 1e-8;
/// With a condition below this, a large error comes from the integrator's steps, not from the kind.
constexpr double smallest_near_singular_condition = 1e4;

/// The relative error of the map: the largest over its degrees, without the nominal's.
double map_error(const Scene& scene, const RunResult& run) {
  const auto& by_degree = run.error_by_degree ? run.error_by_degree : run.error_estimate.by_degree;
  double error = rounding_of(scene.precision);
  if (!by_degree) return error;
  for (std::size_t d = 1; d < by_degree->size(); ++d) {
    raise_to(error, (*by_degree)[d]);
  }
  return error;
}

/// The kind with the largest condition number; null if no kind exists.
const KindResult* worst_kind(const std::vector<KindResult>& kinds) {
  const KindResult* worst = nullptr;
  for (const KindResult& kind : kinds) {
    if (kind.failure.empty() && (!worst || kind.condition > worst->condition)) worst = &kind;
  }
  return worst;
}

}  // namespace

std::string near_singular_warning(const Scene& scene, const RunResult& run) {
  // The condition shows the distance in time from a singularity; the amplification also grows with
  // the duration.
  const KindResult* kind = worst_kind(run.kinds);
  if (!kind || kind->condition < smallest_near_singular_condition) return "";
  const double error = map_error(scene, run);
  if (kind->condition * error <= largest_quiet_error) return "";
  const std::string name =
      kind->requested == "auto" ? fmt::format("auto ({})", kind->kind.name()) : kind->requested;
  return fmt::format(
      "{} is near one of its singular times: it amplifies the error of the map, {:.2g}, up to "
      "{:.2g}-fold in its linear part, to {:.2g}, and more at higher degrees",
      name, error, kind->condition, kind->condition * error);
}

std::string no_digits_warning(const RunResult& run) {
  const auto& errors = run.error_by_degree ? run.error_by_degree : run.error_estimate.by_degree;
  if (!errors) return "";
  // NaN counts as larger than any number.
  const auto worst = std::max_element(errors->begin(), errors->end(), [](double a, double b) {
    return a < b || (!std::isnan(a) && std::isnan(b));
  });
  if (*worst < 1) return "";
  return fmt::format(
      "not one digit of degree {} of the jet is right: its error is about {:.2g} of its largest "
      "coefficient; shorter steps or a smaller tolerance are needed",
      worst - errors->begin(), *worst);
}

std::string charted_digits_warning(const Scene& scene, const RunResult& run) {
  if (!run.charted) return "";
  const std::vector<int> wrong = degrees_without_digits(scene, *run.charted).wrong;
  if (wrong.empty()) return "";
  return fmt::format(
      "not one digit of degree {} of the polynomials in {} coordinates is right; a smaller "
      "tolerance, a lower order or a shorter duration is needed",
      wrong.front(), name_of(run.charted->coordinates));
}

std::string passed_edges_warning(const Scene& scene, const RunResult& run) {
  if (!run.settings.step_canonical || !scene.system.earth || !scene.system.earth->sunlight) {
    return "";
  }
  const double end = scene.duration;
  const std::vector<double>& edges = scene.system.earth->sunlight->edges();
  const auto passed = std::count_if(edges.begin(), edges.end(), [&](double edge) {
    return end < 0 ? edge < 0 && edge > end : edge > 0 && edge < end;
  });
  if (passed == 0) return "";
  return fmt::format(
      "equal steps pass over {} edges of the shadow, at which the force has no derivatives, so "
      "that "
      "their error falls with the order of the method no more; with a tolerance steps end there",
      passed);
}

std::vector<std::string> run_warnings(const Scene& scene, const RunResult& run) {
  std::vector<std::string> warnings = {
      near_singular_warning(scene, run), no_digits_warning(run), charted_digits_warning(scene, run),
      passed_edges_warning(scene, run), tolerance_warning(scene, run)};
  std::erase(warnings, "");
  return warnings;
}

}  // namespace hamjet
