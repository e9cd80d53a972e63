#include "hamjet/detail/studies/self_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "../../integrators/momentum_unit.hpp"
#include "../../integrators/phase_space_scale.hpp"
#include "../../text/quantity_text.hpp"
#include "../descriptions/method_description.hpp"
#include "../largest_coefficient.hpp"
#include "../stopwatch.hpp"
#include "error_promise.hpp"
#include "flight_checks.hpp"
#include "hamjet/integrators/error_estimate.hpp"
#include "hamjet/studies/propagation.hpp"
#include "number_scan.hpp"
#include "rounding_degrees.hpp"
#include "run_warnings.hpp"

namespace hamjet {
namespace {

constexpr double largest_fixed_step_error = 5;
constexpr double gauss_excess = 10;  ///< ratio of error to tolerance that Gauss accepts in a step
constexpr double largest_energy_change = 0.1;
constexpr double largest_symplecticity_defect = 1e-6;
constexpr double largest_inversion_miss = 1e-20;  ///< or epsilon, if larger
constexpr double largest_amplified_rounding = 1e-4;

void not_applicable(SelfCheck& check, std::string why) {
  check.state = SelfCheckState::not_applicable;
  check.limit.reset();
  check.text = std::move(why);
}

/// Judges a value that may be at most the limit; a value that is not finite fails.
bool judge(SelfCheck& check, double value, double limit) {
  if (!check.limit) check.limit = limit;
  const bool is_good = value <= *check.limit;
  if (std::isfinite(value)) check.value = value;
  check.state = is_good ? SelfCheckState::passed : SelfCheckState::failed;
  return is_good;
}

void check_finite(SelfCheck& check, const Scene& scene, const RunResult& run) {
  const NumberScan scan = scan_numbers(scene, run);
  if (judge(check, static_cast<double>(scan.not_finite), 0)) {
    check.text = fmt::format("all {} numbers of the result are finite", scan.numbers);
  } else {
    check.text = fmt::format("{} of {} numbers of the result are not finite, the first in {}",
                             scan.not_finite, scan.numbers, scan.first);
  }
}

void check_convergence(SelfCheck& check, const RunResult& run) {
  const auto& method = description_of(run.settings.method);
  const std::string_view no_equations = method.solves_no_equations(run.settings);
  if (!no_equations.empty()) return not_applicable(check, std::string(no_equations));
  if (run.statistics.steps == 0) return not_applicable(check, "no step was taken");
  const int iterations = run.statistics.most_newton_iterations;
  check.value = iterations;
  check.state = SelfCheckState::passed;
  if (check.limit && iterations > *check.limit) {
    check.state = SelfCheckState::failed;
    check.text =
        fmt::format("Newton's iteration took {} in a step", counted(iterations, "iteration"));
  } else {
    check.text = "the equations of every step were solved to round-off (else it is an error), ";
    check.text += iterations == 0 ? "by fixed-point iteration"
                                  : fmt::format("some by Newton's method, in at most {}",
                                                counted(iterations, "iteration"));
  }
}

void check_step_error(SelfCheck& check, const RunResult& run) {
  const auto& tolerance = run.settings.tolerance;
  if (run.statistics.steps == 0) return not_applicable(check, "no step was taken");
  if (!run.statistics.largest_step_error) {
    return not_applicable(check, std::string(method_name(run.settings.method)) +
                                     " with fixed steps estimates no local error; the "
                                     "energy shows steps that are far too large");
  }
  check.seconds += run.statistics.step_error_seconds;
  const double value = *run.statistics.largest_step_error;
  const double limit = tolerance ? (is_tolerance_of_jet(run) ? gauss_excess : 1) * *tolerance
                                 : largest_fixed_step_error;
  const bool is_good = judge(check, value, limit);
  if (tolerance) {
    check.text =
        fmt::format("the largest local error estimate of a step is {:.2g} of the tolerance",
                    value / *tolerance);
    const std::vector<double>& unmet = run.statistics.unmet_by_degree;
    if (!unmet.empty()) {
      const auto worst = std::max_element(unmet.begin(), unmet.end());
      check.text += fmt::format(
          "; warning: no step size that was tried kept every degree to the tolerance, the last one "
          "left an error of {:.2g} at degree {}",
          *worst, worst - unmet.begin());
    }
  } else if (is_good) {
    check.text = fmt::format("the largest local error estimate of a step is {:.2g}", value);
  } else {
    check.text = fmt::format(
        "the local error estimate of a step comes to {:.2g}: the step is too large to resolve the "
        "motion",
        value);
  }
}

/// The scene's system, made where the first check asks for it.
class CheckedSystem {
 public:
  explicit CheckedSystem(const Scene& scene) : scene_(scene) {}
  const DynamicalSystem& get() {
    if (!made_) made_ = make_system(scene_);
    return *made_;
  }

 private:
  const Scene& scene_;
  std::optional<DynamicalSystem> made_;
};

void check_energy(SelfCheck& check, const Scene& scene, CheckedSystem& system,
                  const RunResult& run) {
  const EnergyAlongNominal& energy = run.energy;
  check.seconds += energy.seconds;
  const ConservedQuantity kept = system.get().conserved_quantity();
  if (kept == ConservedQuantity::none) return not_applicable(check, no_energy_is_kept);
  const char* const name = kept == ConservedQuantity::energy ? "the energy" : "Jacobi's integral";
  const double scale = std::max(std::abs(energy.initial), energy.initial_terms / 100);
  const double value = energy.largest_change > 0 ? energy.largest_change / scale : 0;
  double limit = largest_energy_change;
  if (run.settings.tolerance) {
    const double steps = static_cast<double>(std::max(run.statistics.steps, 1L));
    const double terms = energy.largest_terms > 0 ? energy.largest_terms / scale : 0;
    limit = std::min(limit,
                     10 * steps * (*run.settings.tolerance + rounding_of(scene.precision)) * terms);
  }
  if (judge(check, value, limit)) {
    check.text =
        fmt::format("{} along the nominal changed by at most {:.2g} of its size", name, value);
  } else {
    check.text = fmt::format(
        "{} along the nominal changed by {:.3g} from {:.6g}: the nominal left its orbit, through a "
        "collision or steps that are too large",
        name, energy.largest_change, energy.initial);
  }
}

/// The ratio of the largest frequency of the linearised motion along the nominal to that at its
/// end, at least 1. Coefficients of degree d grow and shrink along an orbit as the d-th power of
/// the frequency, and so does rounding that arises where they are large.
double frequency_growth(const Scene& scene, const DynamicalSystem& system, const RunResult& run) {
  FieldAtStates<double> field(system);
  double largest = 0;
  double last = 0;
  for (const NominalPoint& point : run.nominal) {
    last = field.linearised_motion(point.state, scene.start_time + point.time).frequency();
    largest = std::max(largest, last);
  }
  return last > 0 && std::isfinite(largest) ? std::max(1.0, largest / last) : 1;
}

void check_symplecticity(SelfCheck& check, const Scene& scene, CheckedSystem& system,
                         const RunResult& run) {
  const auto& method = description_of(run.settings.method);
  if (!method.not_symplectic.empty()) {
    return not_applicable(check, std::string(method.not_symplectic));
  }
  if (run.symplecticity.empty()) {
    return not_applicable(check, "the jet is not expanded in all variables");
  }
  const auto largest =
      std::max_element(run.symplecticity.begin(), run.symplecticity.end(),
                       [](const auto& a, const auto& b) { return a.scaled < b.scaled; });
  if (!system.get().is_hamiltonian) {
    return not_applicable(
        check, fmt::format("drag is no Hamiltonian force, so that the flow is not symplectic: the "
                           "Poisson brackets miss symplecticity by {:.2g} at degree {}",
                           largest->scaled, largest->degree));
  }
  if (has_time_shift(run.statistics.left_out)) {
    return not_applicable(
        check,
        fmt::format("a shift in time was put back, which is exact for the true flow alone: the "
                    "Poisson brackets miss symplecticity by {:.2g} at degree {}",
                    largest->scaled, largest->degree));
  }
  const double steps = static_cast<double>(run.statistics.steps);
  const double linear_limit =
      1000 * rounding_of(scene.precision) *
      std::sqrt((1 + steps) * std::max(1.0, largest_coefficient(comparable_jet(scene, run), 1)));
  const double growth = frequency_growth(scene, system.get(), run);
  const auto limit_of = [&](const SymplecticityDefect& defect) {
    return std::min(largest_symplecticity_defect, linear_limit * std::pow(growth, defect.degree));
  };
  std::vector<SymplecticityDefect> defects = run.symplecticity;
  const bool is_in_doubt = std::any_of(defects.begin(), defects.end(), [&](const auto& defect) {
    return !(defect.scaled <= check.limit.value_or(limit_of(defect)));
  });
  if (is_in_doubt) {
    // Where terms of the equations cancel, their rounding is what brackets can be kept to.
    const std::vector<double> floors = defects_of_rounding(scene, system.get(), run);
    std::erase_if(defects, [&](const SymplecticityDefect& defect) {
      return defect.absolute <= floors[static_cast<std::size_t>(defect.degree)];
    });
  }
  const SymplecticityDefect* worst = nullptr;
  double worst_limit = 0;
  for (const SymplecticityDefect& defect : defects) {
    const double limit = limit_of(defect);
    if (worst == nullptr || !(defect.scaled / limit <= worst->scaled / worst_limit)) {
      worst = &defect;
      worst_limit = limit;
    }
  }
  if (judge(check, worst->scaled, worst_limit)) {
    check.text = fmt::format(
        "the map is symplectic to rounding at every degree: to {:.2g} at degree {} of its "
        "brackets{}",
        worst->scaled, worst->degree,
        defects.size() < run.symplecticity.size()
            ? "; where terms of the equations cancel, what their rounding makes is not judged"
            : "");
  } else {
    check.text = fmt::format(
        "the Poisson brackets of degree {} miss symplecticity by {:.2g}, {}", worst->degree,
        worst->scaled,
        worst_limit < largest_symplecticity_defect
            ? "more than rounding explains"
            : "which rounding may explain; precision = \"extended\" or a lower order is needed");
  }
}

void check_inversion(SelfCheck& check, const Scene& scene, const RunResult& run) {
  if (!scene.kinds) return not_applicable(check, "no generating function was asked for");
  if (!run.inversion || run.inversion->kinds == 0) {
    return not_applicable(check, "no map was inverted");
  }
  const InversionQuality& inversion = *run.inversion;
  check.seconds += inversion.seconds;
  const double miss_limit = std::max(largest_inversion_miss, rounding_of(scene.precision));
  if (!(inversion.miss <= miss_limit)) {
    check.limit.reset();
    judge(check, inversion.miss, miss_limit);
    check.text = fmt::format(
        "{}: the inverted map composed with the map misses the identity by {:.2g} of its terms",
        inversion.missing_kind, inversion.miss);
    return;
  }
  const double value = rounding_of(scene.precision) * inversion.amplification;
  if (judge(check, value, largest_amplified_rounding)) {
    check.text = fmt::format(
        "inverted maps composed with the map are the identity to {:.2g} of their terms; rounding "
        "of the map shows as {:.2g} in the linear part of {}",
        inversion.miss, value, inversion.amplified_kind);
    const std::string warning = near_singular_warning(scene, run);
    if (!warning.empty()) check.text += "; " + warning;
  } else {
    check.text = fmt::format(
        "{} is ill-conditioned: it amplifies the rounding of the map to {:.2g} in its linear part; "
        "another kind, or 'auto', may be better",
        inversion.amplified_kind, value);
  }
}

void check_surface(SelfCheck& check, const Scene& scene, const RunResult& run) {
  if (!(scene.system.radius_km > 0)) {
    return not_applicable(check, "the model has no radius");
  }
  if (!run.lowest_point) return not_applicable(check, "the nominal was not watched");
  const LowestPoint& lowest = *run.lowest_point;
  check.seconds += lowest.seconds;
  const bool is_own_limit = check.limit.has_value();
  const double limit = check.limit.value_or(scene.system.radius_km);
  check.limit = limit;
  const double time_s = lowest.time * scene.units.time_s;
  const double distance = lowest.distance * scene.units.length_km;
  check.value = distance;
  const std::string where =
      is_own_limit ? fmt::format("the distance of {:.10g} km", limit) : std::string("the surface");
  if (!lowest.failure.empty()) {
    check.state = SelfCheckState::failed;
    check.text = fmt::format("after t = {:.6g} s the nominal cannot be followed down: {}",
                             lowest.failure_time * scene.units.time_s, lowest.failure);
  } else if (distance >= limit) {
    check.state = SelfCheckState::passed;
    check.text = fmt::format("the nominal stays {:.6g} km above {}, lowest at t = {:.6g} s",
                             distance - limit, where, time_s);
  } else {
    check.state = SelfCheckState::failed;
    check.text = fmt::format("the nominal passes {:.6g} km below {} at t = {:.6g} s",
                             limit - distance, where, time_s);
  }
}

void check_error_estimate(SelfCheck& check, const Scene& scene, const RunResult& run) {
  check.seconds += run.error_estimate.seconds;
  if (!run.error_estimate.by_degree) return not_applicable(check, run.error_estimate.failure);
  const std::vector<double>& estimate = *run.error_estimate.by_degree;
  std::vector<double> limits;  // empty for fixed steps, which promise no error
  if (check.limit) {
    limits.assign(estimate.size(), *check.limit);
  } else if (run.settings.tolerance) {
    limits = promised_errors(scene, run).total;
  }
  std::size_t worst = 0;
  const auto badness = [&](std::size_t d) {
    return limits.empty() ? estimate[d] : estimate[d] / limits[d];
  };
  for (std::size_t d = 1; d < estimate.size(); ++d) {
    if (!(badness(d) <= badness(worst))) worst = d;
  }
  check.text =
      fmt::format("degree {} of the jet has an error of about {:.2g}", worst, estimate[worst]);
  if (limits.empty()) {
    check.value = estimate[worst];
    check.state = SelfCheckState::passed;
    check.text += "; fixed steps promise none";
    if (const std::string warning = no_digits_warning(run); !warning.empty()) {
      check.text += "; warning: " + warning;
    }
  } else if (judge(check, estimate[worst], limits[worst])) {
    if (run.settings.tolerance && estimate[worst] > promised_errors(scene, run).of_tolerance) {
      check.text += ", which is rounding and more than the tolerance asks for";
    }
  } else {
    const bool is_rounding = worst < run.statistics.rounding_by_degree.size();
    check.text +=
        is_rounding ? ": shorter steps leave it what rounding makes; precision = \"extended\" or a "
                      "lower order is needed"
                    : ", more than the tolerance lets expect; a smaller one, or other steps, are "
                      "needed";
  }
}

void run_check(SelfCheck& check, const Scene& scene, CheckedSystem& system, const RunResult& run) {
  switch (check.name) {
    case SelfCheckName::finite:
      return check_finite(check, scene, run);
    case SelfCheckName::convergence:
      return check_convergence(check, run);
    case SelfCheckName::step_error:
      return check_step_error(check, run);
    case SelfCheckName::energy:
      return check_energy(check, scene, system, run);
    case SelfCheckName::symplecticity:
      return check_symplecticity(check, scene, system, run);
    case SelfCheckName::inversion:
      return check_inversion(check, scene, run);
    case SelfCheckName::surface:
      return check_surface(check, scene, run);
    case SelfCheckName::error_estimate:
      return check_error_estimate(check, scene, run);
  }
}

}  // namespace

std::string_view name_of(SelfCheckState state) {
  switch (state) {
    case SelfCheckState::passed:
      return "passed";
    case SelfCheckState::failed:
      return "failed";
    case SelfCheckState::off:
      return "off";
    case SelfCheckState::not_applicable:
      break;
  }
  return "not applicable";
}

std::vector<SelfCheck> self_checks(const Scene& scene, const RunResult& run) {
  CheckedSystem system(scene);
  std::vector<SelfCheck> checks;
  for (std::size_t i = 0; i < self_check_count; ++i) {
    SelfCheck& check = checks.emplace_back();
    check.name = static_cast<SelfCheckName>(i);
    const SelfCheckSetting& setting = scene.checks[check.name];
    if (!setting.is_on) {
      check.text = "turned off in the scene";
      continue;
    }
    check.limit = setting.limit;
    const Stopwatch stopwatch(check.seconds);
    run_check(check, scene, system, run);
  }
  return checks;
}

}  // namespace hamjet
