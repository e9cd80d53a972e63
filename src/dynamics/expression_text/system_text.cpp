#include "hamjet/dynamics/system_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../../text/printable_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/scene_message.hpp"
#include "../factored_field.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"

namespace hamjet {
namespace {

[[noreturn]] void fail_part(std::string part, std::string problem) {
  throw ExpressionTextError(std::move(part), std::move(problem));
}

/// Checks names by themselves, so that the message is about the list in which they stand.
void require_names(const std::vector<std::string>& names, const std::string& part) {
  FunctionText alone;
  alone.variables = names;
  try {
    record_function(alone);
  } catch (const ExpressionTextError& error) {
    fail_part(part, error.problem());
  }
}

/// The names of (q, p), without the parameters of the state.
std::vector<std::string> names_of_phase_space(const SystemText& text) {
  std::vector<std::string> names = text.variables();
  names.resize(names.size() - text.state_parameters.size());
  return names;
}

/// Refuses parameters of the state that are none, or that have the name of an adjoint variable.
void require_state_parameters(const SystemText& text) {
  const std::vector<std::string> taken = names_of_phase_space(text);
  for (const std::string& name : text.state_parameters) {
    const auto is_it = [&](const NamedText& parameter) { return parameter.name == name; };
    if (std::none_of(text.parameters.begin(), text.parameters.end(), is_it)) {
      fail_part("parameters", fmt::format("not there, got {} as a parameter of the state, must be "
                                          "one of them",
                                          io::printable(name)));
    }
    if (std::find(taken.begin(), taken.end(), name) == taken.end()) continue;
    fail_part("parameters." + io::printable(name),
              fmt::format("a name that is taken, got {}, must be another one: a variable of the "
                          "state has this name",
                          io::printable(name)));
  }
}

void require_fitting_names(const SystemText& text) {
  const std::string part = text.is_hamiltonian() ? "coordinates" : "states";
  const std::vector<std::string>& names = text.is_hamiltonian() ? text.coordinates : text.states;
  if (names.empty() || names.size() > most_degrees_of_freedom_of_text) {
    fail_part(part, fmt::format("wrong length, got {}, must be 1 to {}",
                                counted(names.size(), "name"), most_degrees_of_freedom_of_text));
  }
  require_names(names, part);
  if (!text.is_hamiltonian()) return;
  if (text.momenta.size() != names.size()) {
    fail_part("momenta",
              fmt::format("wrong length, got {}, must be {}, one for each coordinate and "
                          "in their order",
                          counted(text.momenta.size(), "name"), names.size()));
  }
  require_names(names_of_phase_space(text), "momenta");
}

/// The text of what is recorded: of the Hamiltonian, or of the vector field.
FunctionText function_of(const SystemText& text) {
  require_fitting_names(text);
  require_state_parameters(text);
  FunctionText function;
  function.varied = text.state_parameters;
  for (const NamedText& parameter : text.parameters) {
    const auto& varied = function.varied;
    const bool is_varied = std::find(varied.begin(), varied.end(), parameter.name) != varied.end();
    if (!is_varied) function.parameters.push_back(parameter);
  }
  function.definitions = text.definitions;
  if (text.is_hamiltonian()) {
    function.variables = names_of_phase_space(text);
    function.outputs = {{"hamiltonian", text.hamiltonian}};
    return function;
  }
  function.variables = text.states;
  for (const NamedText& line : text.vector_field) {
    if (std::find(text.states.begin(), text.states.end(), line.name) != text.states.end()) continue;
    const std::vector<std::string_view> states(text.states.begin(), text.states.end());
    fail_part("vector_field." + io::printable(line.name),
              fmt::format("no state, got {}, {}", io::printable(line.name),
                          io::suggestion(line.name, states)));
  }
  for (const std::string& state : text.states) {
    const auto line =
        std::find_if(text.vector_field.begin(), text.vector_field.end(),
                     [&](const NamedText& candidate) { return candidate.name == state; });
    if (line == text.vector_field.end()) {
      fail_part("vector_field", fmt::format("incomplete, got nothing for {}, must have the "
                                            "derivative of every state by the time",
                                            state));
    }
    function.outputs.push_back({"vector_field." + state, line->text});
  }
  return function;
}

OperationList hamiltonian_of(const SystemText& text) {
  const FunctionText function = function_of(text);
  OperationList list = record_function(function);
  if (text.is_hamiltonian()) return list;
  const std::size_t n = text.states.size();
  return record(
      2 * n + text.state_parameters.size() + (list.has_time() ? 1 : 0),
      [&](std::span<const Expression> z) {
        // Of (x, lambda, c, t) the field has the inputs (x, c, t).
        std::vector<Expression> inputs(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n));
        inputs.insert(inputs.end(), z.begin() + static_cast<std::ptrdiff_t>(2 * n), z.end());
        const std::vector<Expression> field = recorded_outputs(list, inputs);
        Expression sum(0);
        for (std::size_t i = 0; i < n; ++i) sum += z[n + i] * field[i];
        return std::vector<Expression>{sum};
      },
      list.has_time());
}

/// The system with the rotation of the first plane of coordinates under which it does not change,
/// if there is one.
DynamicalSystem with_found_rotation(DynamicalSystem system) {
  const std::size_t n = system.degrees_of_freedom;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      try {
        return with_rotation(system, {{i, j}});
      } catch (const Error&) {
        // The vector field changes under this rotation.
      }
    }
  }
  return system;
}

}  // namespace

std::vector<std::string> SystemText::variables() const {
  std::vector<std::string> names = is_hamiltonian() ? coordinates : states;
  if (is_hamiltonian()) {
    names.insert(names.end(), momenta.begin(), momenta.end());
  } else {
    for (const std::string& state : states) names.push_back("lambda_" + state);
  }
  names.insert(names.end(), state_parameters.begin(), state_parameters.end());
  return names;
}

std::vector<double> state_parameter_values(const SystemText& text) {
  FunctionText function;
  function.parameters = text.parameters;
  for (const std::string& name : text.state_parameters) {
    function.outputs.push_back({"parameters." + io::printable(name), name});
  }
  std::vector<double> values;
  for (const Extended& value : evaluate_function(function, {})) {
    values.push_back(static_cast<double>(value));
  }
  return values;
}

DynamicalSystem make_system(std::string name, const SystemText& text) {
  const std::size_t parameters = text.state_parameters.size();
  DynamicalSystem system =
      make_system(std::move(name), hamiltonian_of(text), std::nullopt, parameters);
  if (text.is_hamiltonian()) {
    if (auto field = factored_field(system.hamiltonian, parameters)) {
      DynamicalSystem factored =
          make_system(system.name, system.hamiltonian, std::move(field), parameters);
      const auto cost = [](const DynamicalSystem& one) {
        return one.evaluated_list().nonlinear_operations();
      };
      if (cost(factored) < cost(system)) system = std::move(factored);
    }
  }
  return with_found_rotation(std::move(system));
}

void require_finite_at(const SystemText& text, const DynamicalSystem& system,
                       std::span<const double> state, double time) {
  const FunctionText function = function_of(text);
  std::vector<Extended> point(
      state.begin(), state.begin() + static_cast<std::ptrdiff_t>(function.variables.size()));
  const auto parameters = state.last(function.varied.size());
  point.insert(point.end(), parameters.begin(), parameters.end());
  try {
    evaluate_function(function, point, Extended(time));
  } catch (const ExpressionTextError& error) {
    fail_part(error.part(), "at the start: " + error.problem());
  }
  DifferentiableFunction<double> field(system.vector_field);
  field.evaluate(state, time);
  const std::vector<std::string> names = text.variables();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::isfinite(field.value(i))) continue;
    fail_part(
        text.is_hamiltonian() ? "hamiltonian" : "vector_field",
        fmt::format("no finite equations of motion at the start, got {} for the derivative of "
                    "{} by the time, must be finite there",
                    field.value(i), names[i]));
  }
}

std::vector<std::pair<std::string, std::string>> likely_mistakes(const SystemText& text,
                                                                 const DynamicalSystem& system) {
  std::vector<std::pair<std::string, std::string>> found;
  for (const std::string& name : unused_names(function_of(text))) {
    found.emplace_back(name, "nothing uses it");
  }
  if (!text.is_hamiltonian()) return found;
  for (std::size_t i = 0; i < text.momenta.size(); ++i) {
    for (std::size_t j = 0; j < text.coordinates.size(); ++j) {
      const std::string& coordinate = text.coordinates[j];
      const bool is_named_so =
          text.momenta[i] == "p" + coordinate || text.momenta[i] == "p_" + coordinate;
      if (i == j || !is_named_so) continue;
      found.emplace_back(
          "momenta", fmt::format("{} is the momentum of {} by its place, not of {}: momenta are "
                                 "in the order of the coordinates",
                                 text.momenta[i], text.coordinates[i], coordinate));
    }
  }
  const OperationList& field = system.vector_field;
  const std::size_t n = system.degrees_of_freedom;
  const std::uint64_t momenta = ((std::uint64_t{1} << n) - 1) << n;
  bool moves_by_momenta = false;
  for (std::size_t i = 0; i < n; ++i) {
    moves_by_momenta = moves_by_momenta || (field.dependencies(field.outputs()[i]) & momenta) != 0;
    if (!output_vanishes(field, i)) continue;
    found.emplace_back("hamiltonian", fmt::format("does not depend on {}, so that {} stands still",
                                                  text.momenta[i], text.coordinates[i]));
  }
  if (!moves_by_momenta) {
    found.emplace_back("hamiltonian",
                       "is linear in the momenta, so that velocities do not depend on them");
  }
  return found;
}

SystemText system_text(const DynamicalSystem& system, std::vector<std::string> coordinates,
                       std::vector<std::string> momenta) {
  SystemText text;
  text.coordinates = std::move(coordinates);
  text.momenta = std::move(momenta);
  FunctionText function = print_list(system.hamiltonian, text.variables(), {"hamiltonian"});
  text.definitions = std::move(function.definitions);
  text.hamiltonian = std::move(function.outputs[0].text);
  return text;
}

}  // namespace hamjet
