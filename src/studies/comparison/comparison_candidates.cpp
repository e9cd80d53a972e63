#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../descriptions/method_description.hpp"
#include "../nominal/nominal_period.hpp"
#include "hamjet/studies/comparison.hpp"

namespace hamjet {
namespace {

/// A value with six digits, so that the advice prints what was run.
double rounded(double value) { return std::stod(fmt::format("{:.6g}", value)); }

/// Shortest text that brings back the number.
std::string text_of(double value) { return fmt::format("{}", value); }

/// Steps from a few per revolution on, refined so that the error falls by 16 each time (by 4 for
/// the midpoint rule). The comparison stops where the error no longer falls, or where time runs
/// out.
std::vector<double> default_steps(const Scene& scene, double order) {
  constexpr int count = 32;
  const double span = std::abs(scene.duration);
  const double largest = std::min(nominal_period(scene).value_or(span), span) * order / 32;
  const double ratio = std::exp2(std::min(1.0, 4 / order));
  std::vector<double> steps;
  for (int k = 0; k < count; ++k) steps.push_back(rounded(largest / std::pow(ratio, k)));
  return steps;
}

std::vector<double> default_tolerances() {
  std::vector<double> tolerances;
  for (int k = 2; k <= 14; ++k) tolerances.push_back(std::stod(fmt::format("1e-{}", k)));
  return tolerances;
}

std::vector<double> coarsest_first(std::vector<double> values) {
  std::sort(values.rbegin(), values.rend());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// The inputs from which the series of one comparison are made.
class SeriesBuilder {
 public:
  explicit SeriesBuilder(const Scene& scene) : scene_(scene), wanted_(scene.comparison) {}

  std::vector<CandidateSeries> build() {
    std::vector<IntegrationMethod> methods = wanted_.methods;
    if (methods.empty()) {
      const bool has_second_order_form = make_system(scene_).second_order.has_value();
      for (const MethodDescription& method : all_methods()) {
        const bool serves = has_second_order_form || !method.needs_second_order_form;
        if (method.is_compared_by_default && method.is_built() && serves) {
          methods.push_back(method.method);
        }
      }
    }
    for (const IntegrationMethod method : methods) add_method(method);
    return std::move(series_);
  }

 private:
  void add_method(IntegrationMethod which) {
    const MethodDescription& method = description_of(which);
    for (ComparedForm& form : method.compared_forms(wanted_)) {
      form.settings.method = which;
      if (method.has_fixed_steps) add_fixed(form.settings, form.name, form.label, form.order);
      if (!method.has_tolerance) continue;
      add_adaptive(form.settings, form.name + (method.has_fixed_steps ? " adaptive" : ""),
                   form.label);
    }
  }

  /// Whether default lists are used: not if the scene gives steps or tolerances, even if it gives
  /// only one of them.
  bool uses_defaults() const {
    return wanted_.steps_canonical.empty() && wanted_.tolerances.empty();
  }

  void add_fixed(IntegratorSettings settings, const std::string& name, const std::string& label,
                 double order) {
    const auto steps =
        uses_defaults() ? default_steps(scene_, order) : coarsest_first(wanted_.steps_canonical);
    CandidateSeries series{name, order, uses_defaults(), {}};
    for (const double step : steps) {
      settings.step_canonical = step;
      settings.label = label + "-step-" + text_of(step);
      series.candidates.push_back({settings});
    }
    if (!series.candidates.empty()) series_.push_back(std::move(series));
  }

  void add_adaptive(IntegratorSettings settings, const std::string& name,
                    const std::string& label) {
    const auto tolerances =
        uses_defaults() ? default_tolerances() : coarsest_first(wanted_.tolerances);
    CandidateSeries series{name, 0, uses_defaults(), {}};
    for (const double tolerance : tolerances) {
      settings.tolerance = tolerance;
      settings.label = label + "-" + text_of(tolerance);
      series.candidates.push_back({settings});
    }
    if (!series.candidates.empty()) series_.push_back(std::move(series));
  }

  const Scene& scene_;
  const ComparisonSettings& wanted_;
  std::vector<CandidateSeries> series_;
};

}  // namespace

std::vector<CandidateSeries> candidate_series(const Scene& scene) {
  return SeriesBuilder(scene).build();
}

}  // namespace hamjet
