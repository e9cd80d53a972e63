#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../studies/descriptions/method_description.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

constexpr int most_repeats = 1000;

std::vector<int> integers(const TableReader& table, std::string_view key, int least, int greatest) {
  const std::vector<std::int64_t> values = table.integers(key, least, greatest);
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

ComparisonSettings read_compare(const TableReader& table, int order, double duration) {
  table.check_keys({{"methods", "stages", "steps_canonical", "tolerances", "orders", "repeats",
                     "time_budget_s", "wanted_error_m"}});
  ComparisonSettings settings;
  if (table.has("methods")) settings.methods = read_methods(table);
  if (table.has("stages")) settings.stages = integers(table, "stages", 1, most_gauss_stages);
  const double span = std::abs(duration);
  if (table.has("steps_canonical")) {
    settings.steps_canonical =
        positive_numbers(table, "steps_canonical", span / largest_step_count, 1e300);
  }
  if (table.has("tolerances")) {
    settings.tolerances =
        positive_numbers(table, "tolerances", least_tolerance, greatest_tolerance);
  }
  if (table.has("orders")) settings.orders = integers(table, "orders", 1, order);
  if (table.has("repeats")) {
    settings.repeats = static_cast<int>(table.integer_between("repeats", 1, most_repeats));
  }
  if (table.has("time_budget_s")) settings.time_budget_s = table.positive_number("time_budget_s");
  if (table.has("wanted_error_m")) {
    settings.wanted_error_m = table.positive_number("wanted_error_m");
  }
  return settings;
}

}  // namespace hamjet::io
