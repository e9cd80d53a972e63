#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <variant>

#include "../formats/output_formats.hpp"
#include "../studies/descriptions/method_description.hpp"
#include "../text/scene_message.hpp"
#include "default_integrator.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

constexpr std::size_t longest_label = 100;

/// Names of files that stand beside the integrators' directories in the output, which a label must
/// not have.
bool is_reserved(std::string_view label) {
  static constexpr std::string_view names[] = {"summary.json",       "relative_hamiltonian.csv",
                                               "compare.json",       "compare.csv",
                                               "report.html",        "plots",
                                               "figure.svg",         "transfers.csv",
                                               "singular_times.csv", "conditions.csv",
                                               "validity.csv",       "assignment.csv",
                                               "costs.csv",          "pairs.csv",
                                               "stability.csv",      "stability.html"};
  const auto& formats = output_formats();
  return std::find(std::begin(names), std::end(names), label) != std::end(names) ||
         std::any_of(formats.begin(), formats.end(), [&](const OutputFormat* format) {
           return format->of_results != nullptr && format->file == label;
         });
}

/// The keys of a method, without those that every method has.
std::vector<std::string_view> own_keys(const MethodDescription& method) {
  std::vector<std::string_view> keys;
  for (const MethodSetting& setting : method.settings) keys.push_back(setting.key);
  if (method.has_fixed_steps) keys.insert(keys.end(), {"step_canonical", "step_s"});
  if (method.has_tolerance) keys.push_back("tolerance");
  return keys;
}

template <class Condition>
std::vector<std::string_view> methods_where(const Condition& condition) {
  std::vector<std::string_view> names;
  for (const MethodDescription& method : all_methods()) {
    if (condition(method)) names.push_back(method.name);
  }
  return names;
}

SceneKey key_of(const MethodSetting& setting) {
  const auto has_it = [&](const MethodDescription& method) {
    const std::vector<std::string_view> keys = own_keys(method);
    return std::find(keys.begin(), keys.end(), setting.key) != keys.end();
  };
  const auto describe = [&](auto member) {
    const auto preset = IntegratorSettings().*member;
    using Value = std::remove_const_t<decltype(preset)>;
    SceneKey key = {setting.key, form::boolean(), absent::value(preset), setting.help,
                    methods_where(has_it)};
    if (std::is_same_v<Value, double>) key.form = form::between(setting.least, setting.most);
    if (std::is_same_v<Value, int>) key.form = form::integer(setting.least, setting.most);
    if (!setting.choices.empty()) {
      key.form.words = fmt::format("one of {}", fmt::join(setting.choices, ", "));
    }
    return key;
  };
  return std::visit(describe, setting.member);
}

/// The keys of all methods, each once: first the keys that distinguish methods, then the others,
/// then those of the step size.
TableDescription describe_integrators() {
  TableDescription table{
      {{"label",
        form::words(fmt::format("1 to {} of `A-Z a-z 0-9 . _ -`, no dot first, not the name of a "
                                "result file",
                                longest_label)),
        absent::other("the method, with stages or order where it has several forms"),
        "name of the run and of its folder; no other run has it"},
       {"method", form::choice(method_names()), absent::refused(),
        "see `hamjet list integrators`"}}};
  const auto add = [&](const MethodSetting& setting) {
    if (table.find(setting.key) == nullptr) table.keys.push_back(key_of(setting));
  };
  for (const MethodSetting& setting : compared_settings()) add(setting);
  for (const MethodDescription& method : all_methods()) {
    for (const MethodSetting& setting : method.settings) add(setting);
  }
  const auto steps = methods_where([](const auto& method) { return method.has_fixed_steps; });
  const auto adaptive = methods_where([](const auto& method) { return method.has_tolerance; });
  const auto other_size = absent::other("another step or tolerance");
  return {joined<SceneKey>(
      {table.keys,
       {{"step_canonical", form::positive(), other_size, "fixed steps, at most 1e8", steps},
        {"step_s", form::positive(), other_size, "the same in seconds", steps},
        {"tolerance",
         form::words(fmt::format("number from {} (extended: {}) to {}", least_tolerance,
                                 least_extended_tolerance, greatest_tolerance),
                     form::between(least_tolerance, greatest_tolerance)),
         other_size, "adaptive steps", adaptive},
        {"require_relative_error", form::positive(), absent::other("no check"),
         "a larger error of any degree is exit code 1"},
        {"require_symplecticity", form::positive(), absent::other("no check"),
         "a larger scaled defect is exit code 1"}}})};
}

/// A label becomes the name of a directory. It must therefore not lead out of the output directory,
/// nor need quotes in a shell.
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
                 const Nominal& nominal) {
  const double given = integrator.number(key);
  const double step =
      key == "step_s" ? nominal.scale.time_of_s(given) : nominal.time_of_canonical(given);
  if (!std::isfinite(step) || step == 0) {
    integrator.fail(key, fmt::format("out of range, got {}, which is {} in canonical units, must "
                                     "be within binary64 there",
                                     integrator.found(key), step));
  }
  // The span is in the unit of the key, so that the user can copy the step that the message
  // suggests.
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
  const bool is_double = precision == Precision::double_precision;
  const double least = is_double ? least_tolerance : least_extended_tolerance;
  return integrator.number_between("tolerance", least, greatest_tolerance);
}

void read_setting(const TableReader& integrator, const MethodSetting& setting,
                  IntegratorSettings& settings) {
  if (!integrator.has(setting.key)) return;
  const auto read = [&](auto member) {
    using Value = std::remove_reference_t<decltype(settings.*member)>;
    if constexpr (std::is_same_v<Value, bool>) {
      return integrator.boolean(setting.key);
    } else if constexpr (std::is_same_v<Value, double>) {
      return integrator.number_between(setting.key, setting.least, setting.most);
    } else {
      const auto least = static_cast<std::int64_t>(setting.least);
      const auto most = static_cast<std::int64_t>(setting.most);
      const auto value = static_cast<int>(integrator.integer_between(setting.key, least, most));
      const auto& choices = setting.choices;
      if (choices.empty() || std::find(choices.begin(), choices.end(), value) != choices.end()) {
        return value;
      }
      const std::vector<int> all_but_last(choices.begin(), choices.end() - 1);
      integrator.fail(setting.key, fmt::format("out of range, got {}, must be {} or {}", value,
                                               fmt::join(all_but_last, ", "), choices.back()));
    }
  };
  std::visit([&](auto member) { settings.*member = read(member); }, setting.member);
}

/// The key that gives the step size.
std::string_view read_size_key(const TableReader& integrator, const MethodDescription& method) {
  if (!method.has_fixed_steps) return "tolerance";
  if (!method.has_tolerance) return integrator.exactly_one_of({"step_canonical", "step_s"});
  return integrator.exactly_one_of({"step_canonical", "step_s", "tolerance"});
}

/// Whoever asks for one of these methods knows it from the paper, and should read why it cannot be
/// used here.
void refuse_energy_conserving(const TableReader& integrator) {
  const std::string method = integrator.text_if_any("method").value_or("");
  if (method != "energy-conserving-stormer" && method != "energy-conserving-midpoint") return;
  integrator.fail("method",
                  fmt::format("not available for a flow jet, got {}, must be one of: {}; {} (study "
                              "= \"energy-conservation\")",
                              in_quotes(method), listed(method_names()), no_energy_conserving_jet));
}

/// Adds labels to the integrators that have none, with a number if the name is already in use.
void add_labels(std::vector<IntegratorSettings>& integrators) {
  std::set<std::string> labels;
  for (const IntegratorSettings& settings : integrators) labels.insert(settings.label);
  for (IntegratorSettings& settings : integrators) {
    if (!settings.label.empty()) continue;
    const std::string label = default_label(settings);
    settings.label = label;
    for (int k = 2; !labels.insert(settings.label).second; ++k) {
      settings.label = fmt::format("{}-{}", label, k);
    }
  }
}

IntegratorSettings read_integrator(const TableReader& integrator, Precision precision,
                                   double duration, const Nominal& nominal) {
  if (!integrator.has("method")) integrator.check_keys();  // a misspelt `method` is reported first
  refuse_energy_conserving(integrator);
  IntegratorSettings settings;
  settings.method = static_cast<IntegrationMethod>(integrator.choice("method"));
  const MethodDescription& method = description_of(settings.method);
  integrator.check_keys({integrator_keys(settings.method), integrator_table().names(),
                         "the method " + std::string(method.name)});
  if (method.integrate.in_extended == nullptr && precision == Precision::extended) {
    integrator.fail("method", fmt::format("not available in extended precision, got {}, must be "
                                          "another method, or precision = \"double\": {} "
                                          "computes in double precision only",
                                          in_quotes(method.name), method.library));
  }
  if (integrator.has("label")) settings.label = read_label(integrator);
  for (const MethodSetting& setting : method.settings) read_setting(integrator, setting, settings);
  const std::string_view size_key = read_size_key(integrator, method);
  if (size_key == "tolerance") {
    settings.tolerance = read_tolerance(integrator, precision);
  } else {
    settings.step_canonical = read_step(integrator, size_key, duration, nominal);
  }
  integrator.read_if_any("require_relative_error", settings.require_relative_error);
  integrator.read_if_any("require_symplecticity", settings.require_symplecticity);
  return settings;
}

}  // namespace

const TableDescription& integrator_table() {
  static const TableDescription table = describe_integrators();
  return table;
}

std::vector<std::string_view> integrator_keys(IntegrationMethod method) {
  std::vector<std::string_view> keys = {"label", "method", "require_relative_error",
                                        "require_symplecticity"};
  const std::vector<std::string_view> own = own_keys(description_of(method));
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

std::vector<IntegratorSettings> read_integrators(const std::vector<TableReader>& integrators,
                                                 Precision precision, double duration,
                                                 const Nominal& nominal) {
  if (integrators.size() > most_integrators) {
    throw Error(
        ErrorKind::too_large,
        fmt::format("{}: too many, got {} integrators, must be at most {}; hamjet sweep runs "
                    "a scene many times",
                    integrators[most_integrators].head(""), integrators.size(), most_integrators));
  }
  std::vector<IntegratorSettings> all_settings;
  std::map<std::string, std::string> places;  // places of the labels so far
  for (const TableReader& integrator : integrators) {
    integrator.attempt([&] {
      const IntegratorSettings settings = read_integrator(integrator, precision, duration, nominal);
      all_settings.push_back(settings);
      if (settings.label.empty()) return;
      const auto [first, is_new] = places.emplace(settings.label, integrator.where("label"));
      if (is_new) return;
      integrator.fail("label", fmt::format("duplicate label, got {}, which is already at {}, must "
                                           "be unique",
                                           in_quotes(settings.label), first->second));
    });
  }
  add_labels(all_settings);
  return all_settings;
}

}  // namespace hamjet::io
