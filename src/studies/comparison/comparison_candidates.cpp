#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "../nominal_period.hpp"
#include "hamjet/integrators/cvode.hpp"
#include "hamjet/studies/comparison.hpp"

namespace hamjet {
namespace {

/// Six digits, so that what is printed in the advice is what was run.
double rounded(double value) { return std::stod(fmt::format("{:.6g}", value)); }

/// Shortest text that brings back the number.
std::string text_of(double value) { return fmt::format("{}", value); }

/// From a few steps a revolution on, refined so that the error falls by 16 a time (by 4 for the
/// midpoint rule). The comparison stops where it no longer falls, or where the time runs out.
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

/// What the series of one comparison are made from.
class SeriesBuilder {
 public:
  explicit SeriesBuilder(const Scene& scene) : scene_(scene), wanted_(scene.comparison) {}

  std::vector<CandidateSeries> build() {
    std::vector<IntegrationMethod> methods = wanted_.methods;
    if (methods.empty()) {
      methods = {IntegrationMethod::gauss, IntegrationMethod::velocity_verlet,
                 IntegrationMethod::fehlberg78};
      if (cvode_available()) {
        methods.push_back(IntegrationMethod::cvode_adams);
        methods.push_back(IntegrationMethod::cvode_bdf);
      }
    }
    for (const IntegrationMethod method : methods) add_method(method);
    return std::move(series_);
  }

 private:
  void add_method(IntegrationMethod method) {
    IntegratorSettings settings;
    settings.method = method;
    switch (method) {
      case IntegrationMethod::gauss:
        for (const int stages : std::set<int>(wanted_.stages.begin(), wanted_.stages.end())) {
          settings.stages = stages;
          const std::string name = fmt::format("Gauss {}", stages);
          const std::string label = fmt::format("gauss{}", stages);
          add_fixed(settings, name, label, 2.0 * stages);
          add_adaptive(settings, name + " adaptive", label);
        }
        break;
      case IntegrationMethod::stormer:
        add_fixed(settings, "Störmer", "stormer", 1);
        break;
      case IntegrationMethod::velocity_verlet:
        for (const int order : {2, 4, 6, 8}) {
          settings.order = order;
          add_fixed(settings, fmt::format("Verlet {}", order), fmt::format("verlet{}", order),
                    order);
        }
        break;
      case IntegrationMethod::newmark:
        add_fixed(settings, fmt::format("Newmark {}", settings.beta), "newmark", 2);
        break;
      case IntegrationMethod::fehlberg78:
        add_fixed(settings, "Fehlberg 7(8)", "fehlberg78", 8);
        add_adaptive(settings, "Fehlberg 7(8) adaptive", "fehlberg78");
        break;
      case IntegrationMethod::cvode_adams:
        add_adaptive(settings, "CVODE Adams", "cvode-adams");
        break;
      case IntegrationMethod::cvode_bdf:
        add_adaptive(settings, "CVODE BDF", "cvode-bdf");
        break;
    }
  }

  /// Whether a list is to be run as it stands: as soon as the scene gives steps or tolerances, the
  /// other list is no longer filled in by default.
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
