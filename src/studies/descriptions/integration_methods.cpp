#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "../../text/quantity_text.hpp"
#include "hamjet/integrators/cvode.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/newmark.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"
#include "hamjet/integrators/symmetric_composition.hpp"
#include "method_description.hpp"

namespace hamjet {
namespace {

using Settings = IntegratorSettings;
using Forms = std::vector<ComparedForm>;

/// Wraps one generic function as the integration in both arithmetics.
template <class Function>
MethodIntegration in_both(Function function) {
  return {function, function};
}

/// Number of lanes of the pack that holds this many stages: the next power of two.
int lanes_for(int stages) {
  int lanes = 1;
  while (lanes < stages) lanes *= 2;
  return lanes;
}

MethodDescription gauss() {
  return {
      .method = IntegrationMethod::gauss,
      .name = "gauss",
      .help =
          "Gauss collocation, 1 (implicit midpoint) to 12 stages, order 2 stages; symplectic; "
          "step_canonical, step_s or tolerance; compensated_summation",
      .settings = {{.key = "stages",
                    .help = "half the order; 1 is the implicit midpoint rule",
                    .member = &Settings::stages,
                    .least = 1,
                    .most = most_gauss_stages,
                    .text = [](const Settings& s) { return counted(s.stages, "stage"); }},
                   {.key = "compensated_summation",
                    .help = "what a sum rounds off is added to the next",
                    .member = &Settings::compensated_summation,
                    .text =
                        [](const Settings& s) {
                          return std::string(
                              s.compensated_summation ? "" : "without compensated summation");
                        },
                    .is_compared = false}},
      .has_tolerance = true,
      .tolerance_is_of_the_jet = true,
      .integrate = in_both([]<class Real>(const FlowProblem<Real>& flow, const Settings& settings,
                                          IntegrationStatistics& statistics,
                                          const StepObserver<Real>& observer, bool records) {
        GaussSettings used = gauss_settings(settings);
        used.estimates_step_error = records;
        return integrate_gauss<Real>(flow, used, statistics, observer);
      }),
      .splittable =
          [](const Settings& s) { return std::optional<SplittableMethod>(gauss_settings(s)); },
      .solves_no_equations = [](const Settings&) { return std::string_view(); },
      .is_stable_for_every_step = true,
      .numbers_held = [](const Settings& s, double values,
                         double) { return values * lanes_for(s.stages); },
      .compared_forms =
          [](const ComparisonSettings& wanted) {
            Forms forms;
            for (const int stages : std::set<int>(wanted.stages.begin(), wanted.stages.end())) {
              forms.push_back({{.stages = stages},
                               fmt::format("Gauss {}", stages),
                               fmt::format("gauss{}", stages),
                               2.0 * stages});
            }
            return forms;
          },
      .is_compared_by_default = true};
}

MethodDescription stormer() {
  return {
      .method = IntegrationMethod::stormer,
      .name = "stormer",
      .help =
          "Störmer's rule of the paper (symplectic Euler), order 1; symplectic; "
          "step_canonical or step_s",
      .integrate = in_both([]<class Real>(const FlowProblem<Real>& flow, const Settings& settings,
                                          IntegrationStatistics& statistics,
                                          const StepObserver<Real>& observer, bool) {
        return integrate_stormer<Real>(flow, {*settings.step_canonical}, statistics, observer);
      }),
      .splittable =
          [](const Settings& s) {
            return std::optional<SplittableMethod>(StormerSettings{*s.step_canonical});
          },
      .error_correction = 1,
      .compared_forms =
          [](const ComparisonSettings&) {
            return Forms{{{}, "Störmer", "stormer", 1}};
          },
      .needs_second_order_form = true};
}

MethodDescription velocity_verlet() {
  return {
      .method = IntegrationMethod::velocity_verlet,
      .name = "velocity-verlet",
      .help =
          "order 2, and symmetric compositions of it of order 4, 6, 8; symplectic; "
          "step_canonical or step_s",
      .settings = {{.key = "order",
                    .column = "method_order",
                    .help = "order of convergence",
                    .member = &Settings::order,
                    .least = 2,
                    .most = 8,
                    .choices = {2, 4, 6, 8},
                    .text = [](const Settings& s) { return fmt::format("order {}", s.order); }}},
      .integrate = in_both([]<class Real>(const FlowProblem<Real>& flow, const Settings& settings,
                                          IntegrationStatistics& statistics,
                                          const StepObserver<Real>& observer, bool) {
        const double step = *settings.step_canonical;
        if (settings.order == 2) {
          return integrate_velocity_verlet<Real>(flow, {step}, statistics, observer);
        }
        return integrate_symmetric_composition<Real>(flow, {settings.order, step}, statistics,
                                                     observer);
      }),
      .splittable =
          [](const Settings& s) {
            const double step = *s.step_canonical;
            if (s.order == 2) {
              return std::optional<SplittableMethod>(VelocityVerletSettings{step});
            }
            return std::optional<SplittableMethod>(SymmetricCompositionSettings{s.order, step});
          },
      .compared_forms =
          [](const ComparisonSettings&) {
            Forms forms;
            for (const int order : {2, 4, 6, 8}) {
              forms.push_back({{.order = order},
                               fmt::format("Verlet {}", order),
                               fmt::format("verlet{}", order),
                               static_cast<double>(order)});
            }
            return forms;
          },
      .is_compared_by_default = true,
      .needs_second_order_form = true};
}

MethodDescription newmark() {
  return {
      .method = IntegrationMethod::newmark,
      .name = "newmark",
      .help =
          "gamma = 1/2, beta from 0 to 1/2, implicit for beta > 0, order 2; not symplectic "
          "in (q, p) for beta > 0; step_canonical or step_s",
      .settings = {{.key = "beta",
                    .help = "Newmark's parameter; at 0 the method is explicit and symplectic",
                    .member = &Settings::beta,
                    .least = 0,
                    .most = 0.5,
                    .text = [](const Settings& s) { return fmt::format("beta {}", s.beta); }}},
      .integrate = in_both([]<class Real>(const FlowProblem<Real>& flow, const Settings& settings,
                                          IntegrationStatistics& statistics,
                                          const StepObserver<Real>& observer, bool) {
        return integrate_newmark<Real>(flow, {settings.beta, *settings.step_canonical}, statistics,
                                       observer);
      }),
      .not_symplectic = "newmark is symplectic in other variables than (q, p)",
      .is_symplectic_with = [](const Settings& s) { return s.beta == 0; },
      .symplectic_with = "beta = 0",
      .solves_no_equations =
          [](const Settings& s) {
            return std::string_view(s.beta > 0 ? "" : "an explicit method solves no equations");
          },
      .compared_forms =
          [](const ComparisonSettings&) {
            const Settings settings;
            return Forms{{settings, fmt::format("Newmark {}", settings.beta), "newmark", 2}};
          },
      .needs_second_order_form = true};
}

MethodDescription fehlberg78() {
  return {
      .method = IntegrationMethod::fehlberg78,
      .name = "fehlberg78",
      .help =
          "explicit Runge-Kutta-Fehlberg 7(8) of Boost.odeint; not symplectic; "
          "step_canonical, step_s or tolerance",
      .has_tolerance = true,
      .integrate = in_both([]<class Real>(const FlowProblem<Real>& flow, const Settings& settings,
                                          IntegrationStatistics& statistics,
                                          const StepObserver<Real>& observer, bool) {
        return integrate_fehlberg78<Real>(flow, {settings.step_canonical, settings.tolerance},
                                          statistics, observer);
      }),
      .not_symplectic = "fehlberg78 is not symplectic",
      .preserves_a_two_form = false,
      .error_correction = 1,
      .compared_forms =
          [](const ComparisonSettings&) {
            return Forms{{{}, "Fehlberg 7(8)", "fehlberg78", 8}};
          },
      .is_compared_by_default = true};
}

template <CvodeMethod method>
FlowJet<double> run_cvode(const FlowProblem<double>& flow, const Settings& settings,
                          IntegrationStatistics& statistics, const StepObserver<double>& observer,
                          bool records) {
  CvodeSettings cvode;
  cvode.method = method;
  cvode.tolerance = *settings.tolerance;
  cvode.records_step_error = records;
  return integrate_cvode(flow, cvode, statistics, observer);
}

/// The description that both methods of CVODE have in common.
MethodDescription of_cvode(IntegrationMethod method, std::string_view name, std::string_view help,
                           MethodIntegration::Function<double> integrate) {
  return {.method = method,
          .name = name,
          .help = help,
          .has_fixed_steps = false,
          .has_tolerance = true,
          .library = "CVODE",
          .build_option = "-DHAMJET_CVODE=ON",
          .is_built = cvode_available,
          .integrate = {integrate, nullptr},
          .solves_no_equations =
              [](const Settings&) {
                return std::string_view(
                    "CVODE iterates as far as its tolerance asks, and repeats "
                    "a step whose iteration does not come to that");
              },
          .is_multistep = true,
          .is_compared_by_default = true};
}

MethodDescription cvode_adams() {
  MethodDescription method = of_cvode(IntegrationMethod::cvode_adams, "cvode-adams",
                                      "Adams method of SUNDIALS CVODE; not symplectic; tolerance",
                                      run_cvode<CvodeMethod::adams>);
  method.not_symplectic = "cvode-adams is not symplectic";
  method.compared_forms = [](const ComparisonSettings&) {
    return Forms{{{}, "CVODE Adams", "cvode-adams", 0}};
  };
  return method;
}

MethodDescription cvode_bdf() {
  MethodDescription method =
      of_cvode(IntegrationMethod::cvode_bdf, "cvode-bdf",
               "backward differentiation of SUNDIALS CVODE, for stiff systems; not symplectic; "
               "tolerance",
               run_cvode<CvodeMethod::bdf>);
  method.not_symplectic = "cvode-bdf is not symplectic";
  method.compared_forms = [](const ComparisonSettings&) {
    return Forms{{{}, "CVODE BDF", "cvode-bdf", 0}};
  };
  return method;
}

}  // namespace

GaussSettings gauss_settings(const IntegratorSettings& settings) {
  GaussSettings gauss;
  gauss.stages = settings.stages;
  gauss.step = settings.step_canonical;
  gauss.tolerance = settings.tolerance;
  gauss.compensated_summation = settings.compensated_summation;
  return gauss;
}

const std::vector<MethodDescription>& all_methods() {
  static const std::vector<MethodDescription> methods = {
      gauss(), stormer(), velocity_verlet(), newmark(), fehlberg78(), cvode_adams(), cvode_bdf()};
  return methods;
}

const MethodDescription& description_of(IntegrationMethod method) {
  return all_methods().at(static_cast<std::size_t>(method));
}

const std::vector<std::string_view>& method_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> result;
    for (const MethodDescription& method : all_methods()) result.push_back(method.name);
    return result;
  }();
  return names;
}

std::string_view method_name(IntegrationMethod method) { return description_of(method).name; }

std::vector<MethodSetting> compared_settings() {
  std::vector<MethodSetting> all;
  for (const MethodDescription& method : all_methods()) {
    for (const MethodSetting& setting : method.settings) {
      const bool is_new = std::none_of(all.begin(), all.end(), [&](const MethodSetting& other) {
        return other.key == setting.key;
      });
      if (setting.is_compared && is_new) all.push_back(setting);
    }
  }
  return all;
}

std::vector<std::pair<std::string_view, std::string>> compared_values(const Settings& settings) {
  std::vector<std::pair<std::string_view, std::string>> values;
  for (const MethodSetting& setting : description_of(settings.method).settings) {
    if (!setting.is_compared) continue;
    std::visit(
        [&](auto member) { values.emplace_back(setting.key, fmt::format("{}", settings.*member)); },
        setting.member);
  }
  return values;
}

}  // namespace hamjet
