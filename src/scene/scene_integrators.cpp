#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <hamjet/error.hpp>
#include <hamjet/integrators/flow_problem.hpp>
#include <iterator>
#include <map>

#include "../text/scene_message.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

constexpr std::size_t longest_label = 100;

/// The jets of all are held until the end.
constexpr std::size_t most_integrators = 1000;

/// The files that stand beside the integrators' directories in the output.
bool is_reserved(std::string_view label) {
  static constexpr std::string_view names[] = {"summary.json",       "relative_hamiltonian.csv",
                                               "compare.json",       "compare.csv",
                                               "report.html",        "plots",
                                               "figure.svg",         "transfers.csv",
                                               "singular_times.csv", "conditions.csv",
                                               "validity.csv",       "assignment.csv",
                                               "costs.csv",          "stability.csv",
                                               "stability.html",     "jets.h5"};
  return std::find(std::begin(names), std::end(names), label) != std::end(names);
}

bool has_fixed_steps_only(IntegrationMethod method) {
  return method == IntegrationMethod::stormer || method == IntegrationMethod::velocity_verlet ||
         method == IntegrationMethod::newmark;
}

/// The keys of any method.
const std::vector<std::string_view> all_keys = {"label",
                                                "method",
                                                "stages",
                                                "order",
                                                "beta",
                                                "compensated_summation",
                                                "step_canonical",
                                                "step_s",
                                                "tolerance",
                                                "require_relative_error",
                                                "require_symplecticity"};

/// A label becomes the name of a directory, so that it must neither lead out of the output
/// directory nor need quotes in a shell.
std::string read_label(const TableReader& integrator) {
  const std::string label = integrator.text("label");
  const auto allowed = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  if (label.empty() || label.size() > longest_label || label[0] == '.' || is_reserved(label) ||
      !std::all_of(label.begin(), label.end(), allowed)) {
    integrator.fail("label", fmt::format("not usable as the name of a directory, got {}, must be 1 "
                                         "to {} of the characters A-Z a-z 0-9 . _ - without a dot "
                                         "at the start, and not the name of a result file",
                                         in_quotes(label), longest_label));
  }
  return label;
}

double read_step(const TableReader& integrator, std::string_view key, double duration,
                 const CanonicalScale& scale) {
  const double given = integrator.positive_number(key);
  const double step = key == "step_s" ? scale.time_of_s(given) : given;
  if (!std::isfinite(step) || step == 0) {
    integrator.fail(key, fmt::format("out of range, got {}, which is {} in canonical units, must "
                                     "be within binary64 there",
                                     integrator.found(key), step));
  }
  // In the unit of the key, so that the user can copy the figure.
  const double span = std::abs(duration) * (given / step);
  const double smallest_step = span * 0x1p-52;
  if (given < smallest_step) {
    integrator.fail(key, fmt::format("too small to advance the time, got {}, must be at least "
                                     "{:.3g}, and at least {:.3g} to keep within {:.0e} steps",
                                     integrator.found(key), smallest_step,
                                     span / largest_step_count, largest_step_count));
  }
  const double steps = std::ceil(std::abs(duration) / step);
  if (steps > largest_step_count) {
    throw Error(ErrorKind::too_large,
                fmt::format("{}: too many steps, got {}, which takes {:.3g} steps, must be at "
                            "least {:.3g} to keep within {:.0e}",
                            integrator.head(key), integrator.found(key), steps,
                            span / largest_step_count, largest_step_count));
  }
  return step;
}

double read_tolerance(const TableReader& integrator, Precision precision) {
  const double least = precision == Precision::double_precision ? least_tolerance : 1e-30;
  return integrator.number_between("tolerance", least, greatest_tolerance);
}

/// Of velocity Verlet and its compositions.
int read_order(const TableReader& integrator) {
  const auto order = integrator.integer_between("order", 2, 8);
  if (order % 2 != 0) {
    integrator.fail("order", fmt::format("out of range, got {}, must be 2, 4, 6 or 8", order));
  }
  return static_cast<int>(order);
}

/// The key that says how long the steps are.
std::string_view read_size_key(const TableReader& integrator, IntegrationMethod method) {
  if (is_cvode(method)) return "tolerance";
  if (has_fixed_steps_only(method)) return integrator.exactly_one_of({"step_canonical", "step_s"});
  return integrator.exactly_one_of({"step_canonical", "step_s", "tolerance"});
}

/// Whoever asks for one of these knows it from the paper and deserves to know why it is no choice.
void refuse_energy_conserving(const TableReader& integrator) {
  const std::string method = integrator.text("method");
  if (method != "energy-conserving-stormer" && method != "energy-conserving-midpoint") return;
  integrator.fail("method",
                  fmt::format("not available for a flow jet, got {}, must be one of: {}; {} (study "
                              "= \"energy-conservation\")",
                              in_quotes(method), listed(method_names()), no_energy_conserving_jet));
}

IntegratorSettings read_integrator(const TableReader& integrator, Precision precision,
                                   double duration, const CanonicalScale& scale) {
  if (!integrator.has("method")) integrator.check_keys({all_keys});  // a misspelt `method` is named
  if (integrator.has("method")) refuse_energy_conserving(integrator);
  IntegratorSettings settings;
  settings.method = static_cast<IntegrationMethod>(integrator.choice("method", method_names()));
  const std::string_view method = method_names()[static_cast<std::size_t>(settings.method)];
  integrator.check_keys(
      {integrator_keys(settings.method), all_keys, "the method " + std::string(method)});
  if (is_cvode(settings.method) && precision == Precision::extended) {
    integrator.fail("method", fmt::format("not available in extended precision, got {}, must be "
                                          "another method, or precision = \"double\": CVODE "
                                          "computes in double precision only",
                                          in_quotes(method)));
  }
  settings.label = read_label(integrator);
  if (integrator.has("stages")) {
    settings.stages = static_cast<int>(integrator.integer_between("stages", 1, most_gauss_stages));
  }
  if (integrator.has("order")) settings.order = read_order(integrator);
  if (integrator.has("beta")) settings.beta = integrator.number_between("beta", 0, 0.5);
  if (integrator.has("compensated_summation")) {
    settings.compensated_summation = integrator.boolean("compensated_summation");
  }
  const std::string_view size_key = read_size_key(integrator, settings.method);
  if (size_key == "tolerance") {
    settings.tolerance = read_tolerance(integrator, precision);
  } else {
    settings.step_canonical = read_step(integrator, size_key, duration, scale);
  }
  if (integrator.has("require_relative_error")) {
    settings.require_relative_error = integrator.positive_number("require_relative_error");
  }
  if (integrator.has("require_symplecticity")) {
    settings.require_symplecticity = integrator.positive_number("require_symplecticity");
  }
  return settings;
}

}  // namespace

std::vector<std::string_view> integrator_keys(IntegrationMethod method) {
  std::vector<std::string_view> keys = {"label", "method", "require_relative_error",
                                        "require_symplecticity"};
  if (method == IntegrationMethod::gauss) {
    keys.insert(keys.end(), {"stages", "compensated_summation"});
  }
  if (method == IntegrationMethod::velocity_verlet) keys.push_back("order");
  if (method == IntegrationMethod::newmark) keys.push_back("beta");
  if (!is_cvode(method)) keys.insert(keys.end(), {"step_canonical", "step_s"});
  if (!has_fixed_steps_only(method)) keys.push_back("tolerance");
  return keys;
}

std::vector<IntegratorSettings> read_integrators(const std::vector<TableReader>& integrators,
                                                 Precision precision, double duration,
                                                 const CanonicalScale& scale) {
  if (integrators.size() > most_integrators) {
    throw Error(
        ErrorKind::too_large,
        fmt::format("{}: too many, got {} integrators, must be at most {}; hamjet sweep runs "
                    "a scene many times",
                    integrators[most_integrators].head(""), integrators.size(), most_integrators));
  }
  std::vector<IntegratorSettings> all_settings;
  std::map<std::string, std::string> places;  // of the labels so far
  for (const TableReader& integrator : integrators) {
    const IntegratorSettings settings = read_integrator(integrator, precision, duration, scale);
    const auto [first, is_new] = places.emplace(settings.label, integrator.where("label"));
    if (!is_new) {
      integrator.fail("label", fmt::format("duplicate label, got {}, which is already at {}, must "
                                           "be unique",
                                           in_quotes(settings.label), first->second));
    }
    all_settings.push_back(settings);
  }
  return all_settings;
}

}  // namespace hamjet::io
