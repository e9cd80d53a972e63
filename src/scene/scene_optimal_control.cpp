#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

/// This limit is far above the number of steps that a study allows; the study itself refuses too
/// many.
constexpr std::int64_t most_steps = 1'000'000'000;

/// The components that `free_end` leaves free.
std::vector<bool> read_free_end(const TableReader& table,
                                const std::vector<std::string_view>& names) {
  std::vector<bool> is_free(names.size(), false);
  if (!table.has("free_end")) return is_free;
  const std::vector<std::string> given = table.texts("free_end");
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto place = std::find(names.begin(), names.end(), given[i]);
    if (place == names.end()) {
      table.fail_element("free_end", i,
                         fmt::format("unknown state, got {}, must be one of {}",
                                     in_quotes(given[i]), listed(names)));
    }
    const auto component = static_cast<std::size_t>(place - names.begin());
    if (is_free[component]) {
      table.fail_element(
          "free_end", i,
          fmt::format("duplicate state, got {}, must be there once", in_quotes(given[i])));
    }
    is_free[component] = true;
  }
  if (std::find(is_free.begin(), is_free.end(), false) == is_free.end()) {
    table.fail("free_end", fmt::format("leaves no end condition, got all of {}, must leave at "
                                       "least one state fixed",
                                       listed(names)));
  }
  return is_free;
}

/// An array with one number for each of `names`.
std::vector<double> read_components(const TableReader& table, std::string_view key,
                                    const std::vector<std::string_view>& names,
                                    std::string_view model) {
  std::vector<double> values = table.numbers(key);
  if (values.size() != names.size()) {
    table.fail(key,
               fmt::format("wrong size, got {}, must be {} for {} ({})",
                           counted(values.size(), "number"), names.size(), model, listed(names)));
  }
  return values;
}

std::vector<std::optional<double>> read_end(const TableReader& table,
                                            const std::vector<std::string_view>& names,
                                            std::string_view model) {
  const std::vector<bool> is_free = read_free_end(table, names);
  std::vector<std::string_view> fixed;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_free[i]) fixed.push_back(names[i]);
  }
  const std::vector<double> values = read_components(
      table, "end", fixed,
      fixed.size() == names.size() ? std::string(model) : fmt::format("{}, its free end", model));
  std::vector<std::optional<double>> end(names.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_free[i]) end[i] = values[next++];
  }
  return end;
}

}  // namespace

const TableDescription& optimal_control_table() {
  const auto states = form::words("array of a number for each state", form::array(form::number()));
  static const OptimalControlStudy preset;
  static const TableDescription table = {
      {{"problem", form::choice(control_model_names()), absent::refused(), "which problem"},
       {"method", form::choice(discretization_names()), absent::refused(), "the discretisation"},
       // Costs are proportional to the inverse third power of the duration, and binary64 must hold
       // them.
       {"duration", form::between(1e-30, 1e30), absent::refused(),
        "duration of the motion, without unit"},
       {"steps", form::integer(1, most_steps), absent::refused(), "equal ones"},
       {"refinements", form::array(form::integer(1, most_steps)), absent::other("none"),
        "further numbers of steps, for the order of convergence"},
       {"start", states, absent::refused(), "initial states"},
       {"end", states, absent::refused(), "final states, but the free ones"},
       {"free_end", form::words("array of names of states", form::array(form::text())),
        absent::other("none"), "states that the end leaves free"},
       {"costate_guess", states, absent::other("of the right size"), "a first initial costate"},
       {"shooting_intervals",
        form::words("integer from 1 to `steps`", form::integer(1, most_steps)),
        absent::value(preset.shooting_intervals), "number of intervals of multiple shooting"},
       {"require_cost_error", form::positive(), absent::other("no check"),
        "largest relative difference from the closed form, where there is one"},
       {"require_equivalence", form::positive(), absent::other("no check"),
        "largest relative difference of the two routes"}}};
  return table;
}

Study read_optimal_control(const TableReader& root) {
  OptimalControlStudy study;
  const TableReader table = root.table("optimal_control");
  table.check_keys();
  study.model = static_cast<ControlModel>(table.choice("problem"));
  study.discretization = static_cast<Discretization>(table.choice("method"));
  const auto& names = state_names(study.model);
  const auto model = control_model_names()[static_cast<std::size_t>(study.model)];
  study.duration = table.number("duration");
  study.steps = static_cast<std::size_t>(table.integer("steps"));
  if (table.has("refinements")) {
    const std::vector<std::int64_t> counts = table.integers("refinements");
    study.refinements.assign(counts.begin(), counts.end());
  }
  study.start = read_components(table, "start", names, model);
  study.end = read_end(table, names, model);
  if (table.has("costate_guess")) {
    study.costate_guess = read_components(table, "costate_guess", names, model);
  }
  if (table.has("shooting_intervals")) {
    study.shooting_intervals = static_cast<std::size_t>(
        table.integer_between("shooting_intervals", 1, static_cast<std::int64_t>(study.steps)));
  }
  table.read_if_any("require_cost_error", study.require_cost_error);
  if (study.require_cost_error && !closed_form_cost(study, study.steps)) {
    table.fail("require_cost_error",
               "cannot be checked, for the least cost has no closed form with this start, end and "
               "number of steps; must be left out");
  }
  table.read_if_any("require_equivalence", study.require_equivalence);
  return study;
}

}  // namespace hamjet::io
