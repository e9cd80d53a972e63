#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/error.hpp"
#include "list_about_time.hpp"

namespace hamjet {
namespace {

/// The partial derivatives of a nonlinear operation with respect to its operands, as expressions.
struct Partials {
  Expression u;
  Expression v;
};

Partials partial_derivatives(const Operation& o, std::span<const Expression> values,
                             std::size_t self) {
  const Expression& u = values[o.u];
  switch (o.code) {
    case OperationCode::product:
      return {values[o.v], u};
    case OperationCode::square:
      return {2 * u, 0};
    case OperationCode::quotient:
      return {1 / values[o.v], -values[self] / values[o.v]};
    case OperationCode::power:
      return {o.constant * pow(u, Expression(Extended(o.constant - 1))), 0};
    case OperationCode::exponential:
      return {values[self], 0};
    case OperationCode::logarithm:
      return {1 / u, 0};
    case OperationCode::sine:
      return {cos(u), 0};
    case OperationCode::cosine:
      return {-sin(u), 0};
    case OperationCode::hyperbolic_sine:
      return {cosh(u), 0};
    case OperationCode::hyperbolic_cosine:
      return {sinh(u), 0};
    case OperationCode::angle:
      return {values[o.v], -u};
    case OperationCode::time_function:  // its operand depends on no variable
    case OperationCode::field:          // see for_each_field_derivative
    case OperationCode::deviation_product:
    case OperationCode::input:
    case OperationCode::linear:
      break;
  }
  return {0, 0};
}

std::array<Expression, 3> position_of(const FieldPart& part, std::span<const Expression> values) {
  return {values[part.position[0]], values[part.position[1]], values[part.position[2]]};
}

/// The operand x of a product x^2 x, and the product's slope 3 x^2 by it; no value for others. By
/// the rule of products the derivative would be formed twice, of x and of x^2.
std::optional<std::pair<std::size_t, Expression>> slope_of_cube(
    const OperationList& list, const Operation& o, std::span<const Expression> values) {
  if (o.code != OperationCode::product) return std::nullopt;
  const auto is_square_of = [&](std::size_t square, std::size_t x) {
    const Operation& candidate = list.operations()[square];
    return candidate.code == OperationCode::square && candidate.u == x;
  };
  if (is_square_of(o.v, o.u)) return std::pair{std::size_t{o.u}, 3 * values[o.v]};
  if (is_square_of(o.u, o.v)) return std::pair{std::size_t{o.v}, 3 * values[o.u]};
  return std::nullopt;
}

/// Calls add(operand, derivative) with the derivatives of a field by its position.
template <class Add>
void for_each_field_derivative(const Operation& o, std::span<const Expression> values,
                               const Add& add) {
  for (const FieldPart& part : o.parts) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<int, 3> orders = part.orders;
      ++orders[i];
      add(part.position[i],
          part.factor * field_value(part.field, position_of(part, values), orders));
    }
  }
}

/// The value of a component of a function of the time.
using TimeValue = std::function<Expression(const Operation&, const Expression& time)>;

std::vector<Expression> replay_with(const OperationList& list, std::span<const Expression> inputs,
                                    const TimeValue& time_value) {
  if (inputs.size() != list.inputs()) {
    const bool lacks_time = list.has_time() && inputs.size() == list.variables();
    throw Error(ErrorKind::usage, lacks_time
                                      ? "operation list: it depends on the time, which is not given"
                                      : "operation list: wrong number of inputs");
  }
  std::vector<Expression> values;
  for (const Operation& o : list.operations()) {
    switch (o.code) {
      case OperationCode::input:
        values.push_back(inputs[o.u]);
        break;
      case OperationCode::linear: {
        Expression sum(o.constant);
        for (const LinearTerm& t : o.terms) sum += t.coefficient * values[t.value];
        values.push_back(sum);
        break;
      }
      case OperationCode::product:
        values.push_back(values[o.u] * values[o.v]);
        break;
      case OperationCode::square:
        values.push_back(square(values[o.u]));
        break;
      case OperationCode::quotient:
        values.push_back(values[o.u] / values[o.v]);
        break;
      case OperationCode::power:
        values.push_back(pow(values[o.u], Expression(o.constant)));
        break;
      case OperationCode::exponential:
        values.push_back(exp(values[o.u]));
        break;
      case OperationCode::logarithm:
        values.push_back(log(values[o.u]));
        break;
      case OperationCode::sine:
        values.push_back(sin(values[o.u]));
        break;
      case OperationCode::cosine:
        values.push_back(cos(values[o.u]));
        break;
      case OperationCode::hyperbolic_sine:
        values.push_back(sinh(values[o.u]));
        break;
      case OperationCode::hyperbolic_cosine:
        values.push_back(cosh(values[o.u]));
        break;
      case OperationCode::angle:
        values.push_back(angle(values[o.u], values[o.v]));
        break;
      case OperationCode::time_function:
        values.push_back(time_value(o, values[o.u]));
        break;
      case OperationCode::field: {
        Expression sum(0);
        for (const FieldPart& part : o.parts) {
          sum += part.factor * field_value(part.field, position_of(part, values), part.orders);
        }
        values.push_back(sum);
        break;
      }
      case OperationCode::deviation_product:
        throw Error(ErrorKind::usage,
                    "operation list: a list that was expanded for series is recorded");
    }
  }
  return values;
}

/// The list with other inputs, from which `inputs_of_list` makes its own, and with some of its
/// outputs.
OperationList recorded_anew(
    const OperationList& list, std::size_t inputs, bool has_time,
    const std::vector<std::size_t>& outputs,
    const std::function<std::vector<Expression>(std::span<const Expression>)>& inputs_of_list) {
  return record(
      inputs,
      [&](std::span<const Expression> variables) {
        const std::vector<Expression> values = replay(list, inputs_of_list(variables));
        std::vector<Expression> result;
        for (const std::size_t o : outputs) result.push_back(values[list.outputs()[o]]);
        return result;
      },
      has_time);
}

std::vector<std::size_t> all_outputs(const OperationList& list) {
  std::vector<std::size_t> result(list.outputs().size());
  std::iota(result.begin(), result.end(), std::size_t{0});
  return result;
}

std::vector<Expression> outputs_of(const OperationList& list,
                                   const std::vector<Expression>& values) {
  std::vector<Expression> outputs;
  for (const std::size_t place : list.outputs()) outputs.push_back(values[place]);
  return outputs;
}

}  // namespace

std::vector<Expression> replay(const OperationList& list, std::span<const Expression> inputs) {
  return replay_with(list, inputs, [](const Operation& o, const Expression& time) {
    return time_values(o.time_function, time)[o.component];
  });
}

std::vector<Expression> recorded_outputs(const OperationList& list,
                                         std::span<const Expression> inputs) {
  return outputs_of(list, replay(list, inputs));
}

OperationList gradient(const OperationList& list) {
  if (list.outputs().size() != 1) {
    throw Error(ErrorKind::usage, "gradient: the list must have one output");
  }
  return record(
      list.inputs(),
      [&](std::span<const Expression> inputs) {
        const std::vector<Expression> values = replay(list, inputs);
        std::vector<Expression> adjoint(values.size(), Expression(0));
        adjoint[list.outputs()[0]] = 1;
        for (std::size_t i = values.size(); i-- > 0;) {
          const Operation& o = list.operations()[i];
          if (o.code == OperationCode::input || list.is_number(i) ||
              (adjoint[i].is_constant() && adjoint[i].constant() == 0)) {
            continue;
          }
          if (o.code == OperationCode::linear) {
            for (const LinearTerm& t : o.terms) adjoint[t.value] += t.coefficient * adjoint[i];
            continue;
          }
          if (o.code == OperationCode::field) {
            for_each_field_derivative(o, values, [&](std::size_t operand, const Expression& slope) {
              adjoint[operand] += adjoint[i] * slope;
            });
            continue;
          }
          if (const auto cube = slope_of_cube(list, o, values)) {
            adjoint[cube->first] += adjoint[i] * cube->second;
            continue;
          }
          const Partials partials = partial_derivatives(o, values, i);
          adjoint[o.u] += adjoint[i] * partials.u;
          if (has_two_operands(o.code)) adjoint[o.v] += adjoint[i] * partials.v;
        }
        adjoint.resize(list.variables());  // the inputs stand first
        return adjoint;
      },
      list.has_time());
}

OperationList jacobian(const OperationList& list) {
  return record(
      list.inputs(),
      [&](std::span<const Expression> inputs) {
        const std::vector<Expression> values = replay(list, inputs);
        const std::size_t n = list.variables();
        std::vector<std::vector<Expression>> tangents;
        for (std::size_t i = 0; i < values.size(); ++i) {
          const Operation& o = list.operations()[i];
          std::vector<Expression> tangent(n, Expression(0));
          const auto add = [&](std::size_t operand, const Expression& slope) {
            for (std::size_t j = 0; j < n; ++j) tangent[j] += slope * tangents[operand][j];
          };
          if (list.is_number(i)) {
            // The tangent stays zero.
          } else if (o.code == OperationCode::input) {
            tangent[o.u] = 1;
          } else if (o.code == OperationCode::linear) {
            for (const LinearTerm& t : o.terms) add(t.value, Expression(t.coefficient));
          } else if (o.code == OperationCode::field) {
            for_each_field_derivative(o, values, add);
          } else {
            const Partials partials = partial_derivatives(o, values, i);
            for (std::size_t j = 0; j < n; ++j) {
              tangent[j] = partials.u * tangents[o.u][j];
              if (has_two_operands(o.code)) tangent[j] += partials.v * tangents[o.v][j];
            }
          }
          tangents.push_back(std::move(tangent));
        }
        std::vector<Expression> outputs;
        for (const std::size_t o : list.outputs()) {
          outputs.insert(outputs.end(), tangents[o].begin(), tangents[o].end());
        }
        return outputs;
      },
      list.has_time());
}

OperationList at_time(const OperationList& list, const Extended& time) {
  if (!list.has_time()) return list;
  return recorded_anew(list, list.variables(), false, all_outputs(list),
                       [&](std::span<const Expression> variables) {
                         std::vector<Expression> all(variables.begin(), variables.end());
                         all.emplace_back(time);
                         return all;
                       });
}

OperationList about_time(const OperationList& list, const Extended& time, int degree) {
  const auto terms = static_cast<std::size_t>(degree) + 1;
  std::map<const TimeFunction*, std::vector<Extended>> coefficients;
  return record(list.variables() + 1, [&](std::span<const Expression> variables) {
    const Expression& later = variables.back();
    const auto polynomial = [&](const Operation& o, const Expression& at) {
      if (at.is_constant()) return time_values(o.time_function, at)[o.component];
      std::vector<Extended>& known = coefficients[o.time_function.get()];
      if (known.empty()) {
        known.resize(o.time_function->components() * terms);
        o.time_function->expand(time, degree, known.data());
      }
      Expression sum(0);
      for (std::size_t k = terms; k-- > 0;) {
        sum = sum * later + Expression(known[o.component * terms + k]);
      }
      return sum;
    };
    std::vector<Expression> inputs(variables.begin(), variables.end() - 1);
    if (list.has_time()) inputs.push_back(time + later);
    return outputs_of(list, replay_with(list, inputs, polynomial));
  });
}

OperationList with_time(const OperationList& list) {
  if (list.has_time()) return list;
  return recorded_anew(list, list.inputs() + 1, true, all_outputs(list),
                       [&](std::span<const Expression> inputs) {
                         return std::vector<Expression>(inputs.begin(), inputs.end() - 1);
                       });
}

OperationList restrict_list(const OperationList& list, std::span<const std::size_t> kept_inputs,
                            std::span<const std::size_t> kept_outputs) {
  return recorded_anew(list, kept_inputs.size() + (list.has_time() ? 1 : 0), list.has_time(),
                       {kept_outputs.begin(), kept_outputs.end()},
                       [&](std::span<const Expression> inputs) {
                         std::vector<Expression> all(list.inputs(), Expression(0));
                         for (std::size_t i = 0; i < kept_inputs.size(); ++i) {
                           all[kept_inputs[i]] = inputs[i];
                         }
                         if (list.has_time()) all.back() = inputs.back();
                         return all;
                       });
}

bool output_vanishes(const OperationList& list, std::size_t output) {
  const Operation& o = list.operations()[list.outputs()[output]];
  return o.code == OperationCode::linear && o.terms.empty() && o.constant == 0;
}

}  // namespace hamjet
