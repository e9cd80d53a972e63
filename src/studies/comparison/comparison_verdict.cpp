#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "../../text/quantity_text.hpp"
#include "../descriptions/method_description.hpp"
#include "../nominal/nominal_period.hpp"
#include "hamjet/studies/comparison.hpp"

namespace hamjet {
namespace {

/// A length in the form that a scene has: with all its digits.
std::string given_length_text(double metres) {
  if (metres >= 1000 * (1 - 1e-12)) return fmt::format("{:g} km", metres / 1000);
  if (metres >= 1) return fmt::format("{:g} m", metres);
  if (metres >= 1e-3) return fmt::format("{:g} mm", metres * 1e3);
  return fmt::format("{:.0e} m", metres);
}

/// A run in words: "Gauss 8 adaptive (tolerance 1e-07)".
std::string configuration_text(const ComparedRun& run) {
  if (run.settings.tolerance) {
    return fmt::format("{} (tolerance {:g})", run.series, *run.settings.tolerance);
  }
  return fmt::format("{} (step {:g} canonical)", run.series, *run.settings.step_canonical);
}

/// The time from the start of the nominal, in suitable words, with the number of revolutions of an
/// elliptic orbit.
std::string span_text(const Scene& scene) {
  const double seconds = std::abs(scene.duration) * scene.units.time_s;
  const auto period = nominal_period(scene);
  if (period && is_orbit(scene.system.model)) {
    const double revolutions = std::abs(scene.duration) / *period;
    return fmt::format("{:.3g} h ({:.4g} revolution{})", seconds / 3600, revolutions,
                       std::abs(revolutions - 1) < 1e-4 ? "" : "s");
  }
  if (seconds < 60) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.3g} min", seconds / 60);
  return fmt::format("{:.3g} h", seconds / 3600);
}

double separation_m(const Scene& scene) {
  return scene.separation.value_or(0) * scene.units.length_km * 1000;
}

/// The end of the verdict if all timed runs that reach the error are of one family of methods.
std::string rest_text(const ComparisonResult& result, const std::vector<const ComparedRun*>& runs) {
  const ComparedRun& best = *runs[0];
  std::string text;
  if (runs.size() > 1) {
    text = fmt::format("; next is {}, of the same family, with {}, {:.1f} times as long",
                       configuration_text(*runs[1]), duration_text(runs[1]->median_seconds()),
                       runs[1]->median_seconds() / best.median_seconds());
  }
  const bool has_untimed =
      std::any_of(result.runs.begin(), result.runs.end(), [&](const ComparedRun& run) {
        return run.is_finished() && run.seconds.empty() &&
               run.settings.method != best.settings.method &&
               run.error_at_formation_m <= result.scene.comparison.wanted_error_m;
      });
  if (has_untimed) return text + "; others of other families that reach it were not timed.";
  return text + fmt::format("; no method of another family than {} that was run reaches it.",
                            method_name(best.settings.method));
}

}  // namespace

const std::vector<std::string_view>& corner_names() {
  static const std::vector<std::string_view> names = {"exact and accurate", "exact but wrong",
                                                      "accurate though not symplectic", "neither"};
  return names;
}

double ComparedRun::median_seconds() const {
  if (seconds.empty()) return 0;
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

double ComparedRun::largest_error_estimate() const {
  if (error_estimate_by_degree.empty()) return std::numeric_limits<double>::infinity();
  return *std::max_element(error_estimate_by_degree.begin(), error_estimate_by_degree.end());
}

double ComparedRun::largest_error() const {
  if (error_by_degree.empty()) return std::numeric_limits<double>::infinity();
  return *std::max_element(error_by_degree.begin(), error_by_degree.end());
}

double ComparedRun::largest_symplecticity() const {
  double largest = 0;
  for (const auto& entry : symplecticity) largest = std::max(largest, entry.scaled);
  return largest;
}

double ComparisonResult::smallest_claimed_error(int degree) const {
  const auto index = static_cast<std::size_t>(degree);
  const auto& uncertainty = reference.uncertainty_by_degree;
  return index < uncertainty.size() ? 10 * uncertainty[index] : 0;
}

double ComparisonResult::smallest_claimed_error_m() const {
  const double metres = scene.units.length_km * 1000;
  const FlowJet<Extended>& jet = reference.jet;
  if (jet.empty()) return 0;
  // The uncertainty of each coefficient times the power of the deviation, summed over the
  // monomials.
  const SeriesSpace& space = jet.front().space();
  double canonical = 0;
  for (int d = 0; d <= std::min(scene.order, space.order()); ++d) {
    double largest = 0;
    for (const Series<Extended>& component : jet) {
      for (const Extended& c : component.slice(d)) {
        largest = std::max(largest, std::abs(static_cast<double>(c)));
      }
    }
    canonical += smallest_claimed_error(d) * largest * std::pow(scene.separation.value_or(0), d) *
                 static_cast<double>(space.count(d));
  }
  return canonical * metres;
}

std::vector<const ComparedRun*> cheapest_runs(const ComparisonResult& result, double error_m) {
  std::map<std::string, const ComparedRun*> best;
  for (const ComparedRun& run : result.runs) {
    if (!run.is_finished() || run.seconds.empty() || !(run.error_at_formation_m <= error_m))
      continue;
    const ComparedRun*& place = best[run.series];
    if (place == nullptr || run.median_seconds() < place->median_seconds()) place = &run;
  }
  std::vector<const ComparedRun*> sorted;
  for (const auto& [series, run] : best) sorted.push_back(run);
  std::stable_sort(sorted.begin(), sorted.end(), [](const ComparedRun* a, const ComparedRun* b) {
    return a->median_seconds() < b->median_seconds();
  });
  return sorted;
}

std::string verdict(const ComparisonResult& result) {
  const Scene& scene = result.scene;
  const std::string task =
      fmt::format("For {} at {} separation after {}, order {}",
                  given_length_text(scene.comparison.wanted_error_m),
                  given_length_text(separation_m(scene)), span_text(scene), scene.order);
  const auto runs = cheapest_runs(result, scene.comparison.wanted_error_m);
  if (runs.empty()) {
    return task + (result.is_complete ? ": no integrator that was run reaches it."
                                      : ": nothing can be said yet, the comparison is partial.");
  }
  std::string text = fmt::format("{}: {} needs {}", task, configuration_text(*runs[0]),
                                 duration_text(runs[0]->median_seconds()));
  // A run of another method says more than a run of the same method with other stages.
  const auto other = std::find_if(runs.begin(), runs.end(), [&](const ComparedRun* run) {
    return run->settings.method != runs[0]->settings.method;
  });
  if (other == runs.end()) return text + rest_text(result, runs);
  return text + fmt::format("; the next method, {}, needs {}, {:.1f} times as long.",
                            configuration_text(**other), duration_text((*other)->median_seconds()),
                            (*other)->median_seconds() / runs[0]->median_seconds());
}

std::string advice(const ComparisonResult& result) {
  const double wanted = result.scene.comparison.wanted_error_m;
  const auto runs = cheapest_runs(result, wanted);
  if (runs.empty()) {
    return fmt::format("# no configuration that was run is within {} at {} separation\n",
                       given_length_text(wanted), given_length_text(separation_m(result.scene)));
  }
  const ComparedRun& run = *runs[0];
  const double claimed = result.smallest_claimed_error_m();
  std::string text = fmt::format(
      "# error {}{:.1e} m at {} separation (wanted: {}), {} a run\n[[integrator]]\nlabel = \"{}\"\n"
      "method = \"{}\"\n",
      run.error_at_formation_m < claimed ? "below " : "",
      std::max(run.error_at_formation_m, claimed), given_length_text(separation_m(result.scene)),
      given_length_text(wanted), duration_text(run.median_seconds()), run.settings.label,
      method_name(run.settings.method));
  for (const auto& [key, value] : compared_values(run.settings)) {
    text += fmt::format("{} = {}\n", key, value);
  }
  if (run.settings.tolerance) text += fmt::format("tolerance = {}\n", *run.settings.tolerance);
  if (run.settings.step_canonical) {
    text += fmt::format("step_canonical = {}\n", *run.settings.step_canonical);
  }
  return text;
}

}  // namespace hamjet
