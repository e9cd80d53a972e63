#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../studies/descriptions/method_description.hpp"
#include "../text/scene_message.hpp"
#include "default_integrator.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

constexpr int most_repeats = 1000;

std::vector<int> as_int(const std::vector<std::int64_t>& values) {
  return {values.begin(), values.end()};
}

std::vector<double> positive_numbers(const TableReader& table, std::string_view key, double least,
                                     double greatest) {
  const std::vector<double> values = table.numbers(key);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= least) || !(values[i] <= greatest)) {
      table.fail_element(key, i,
                         fmt::format("out of range, got {}, must be from {:.3g} to {:.3g}",
                                     values[i], least, greatest));
    }
  }
  return values;
}

std::vector<IntegrationMethod> read_methods(const TableReader& table) {
  std::vector<IntegrationMethod> methods;
  const std::vector<std::string> names = table.texts("methods");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& known = method_names();
    const auto place = std::find(known.begin(), known.end(), names[i]);
    if (place == known.end()) {
      table.fail_element("methods", i,
                         fmt::format("unknown method, got {}, must be one of {}",
                                     in_quotes(names[i]), listed(known)));
    }
    const auto method = static_cast<IntegrationMethod>(place - known.begin());
    if (std::find(methods.begin(), methods.end(), method) != methods.end()) {
      table.fail_element(
          "methods", i,
          fmt::format("duplicate method, got {}, must be there once", in_quotes(names[i])));
    }
    methods.push_back(method);
  }
  return methods;
}

}  // namespace

const TableDescription& compare_table() {
  static const ComparisonSettings preset;
  static const TableDescription table = {
      {{"methods", form::array(form::choice(method_names())),
        absent::other("the usual ones of this build"), "methods to compare, each once"},
       {"stages", form::array(form::integer(1, most_gauss_stages)), absent::value(preset.stages),
        "stages of the Gauss methods"},
       {"steps_canonical", form::array(form::positive()),
        absent::other("halved from far too coarse to round-off"),
        "steps of the methods with fixed steps"},
       {"tolerances", form::array(form::between(least_tolerance, greatest_tolerance)),
        absent::other("by powers of ten from 1e-2 to round-off"),
        "tolerances of the adaptive methods"},
       {"orders",
        form::words("array of integers from 1 to `jet.order`",
                    form::array(form::integer(1, largest_order))),
        absent::other("1 to `jet.order`"), "orders for the curve of cost against order"},
       {"repeats", form::integer(1, most_repeats), absent::value(preset.repeats),
        "timings of each run, in turns"},
       {"time_budget_s", form::positive(), absent::value(preset.time_budget_s),
        "time for the runs that are compared, with their repeats; runs that would exceed it are "
        "left out, which is told. Reference, errors along time and fits of orders take more time "
        "on top of it"},
       {"wanted_error_m", form::positive(), absent::value(preset.wanted_error_m),
        "error at the separation of `[formation]` that verdict and advice refer to"}}};
  return table;
}

ComparisonSettings read_compare(const TableReader& table, const Scene& scene,
                                const Nominal& nominal) {
  table.check_keys();
  ComparisonSettings settings;
  if (table.has("methods")) settings.methods = read_methods(table);
  if (table.has("stages")) settings.stages = as_int(table.integers("stages"));
  if (table.has("steps_canonical")) {
    const double span = std::abs(nominal.told_time(scene.duration));
    settings.steps_canonical =
        positive_numbers(table, "steps_canonical", span / largest_step_count, 1e300);
    for (double& step : settings.steps_canonical) step = nominal.time_of_canonical(step);
  }
  if (table.has("tolerances")) {
    settings.tolerances =
        positive_numbers(table, "tolerances", least_tolerance, greatest_tolerance);
  }
  if (table.has("orders")) settings.orders = as_int(table.integers("orders", 1, scene.order));
  table.read_if_any("repeats", settings.repeats);
  table.read_if_any("time_budget_s", settings.time_budget_s);
  table.read_if_any("wanted_error_m", settings.wanted_error_m);
  return settings;
}

}  // namespace hamjet::io
