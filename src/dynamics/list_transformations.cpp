#include <algorithm>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/error.hpp"

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
    case OperationCode::input:
    case OperationCode::linear:
      break;
  }
  return {0, 0};
}

}  // namespace

std::vector<Expression> replay(const OperationList& list, std::span<const Expression> inputs) {
  if (inputs.size() != list.inputs()) {
    throw Error(ErrorKind::usage, "operation list: wrong number of inputs");
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
    }
  }
  return values;
}

std::vector<Expression> recorded_outputs(const OperationList& list,
                                         std::span<const Expression> inputs) {
  const std::vector<Expression> values = replay(list, inputs);
  std::vector<Expression> outputs;
  for (const std::size_t place : list.outputs()) outputs.push_back(values[place]);
  return outputs;
}

OperationList gradient(const OperationList& list) {
  if (list.outputs().size() != 1) {
    throw Error(ErrorKind::usage, "gradient: the list must have one output");
  }
  return record(list.inputs(), [&](std::span<const Expression> inputs) {
    const std::vector<Expression> values = replay(list, inputs);
    std::vector<Expression> adjoint(values.size(), Expression(0));
    adjoint[list.outputs()[0]] = 1;
    for (std::size_t i = values.size(); i-- > 0;) {
      const Operation& o = list.operations()[i];
      if (o.code == OperationCode::input ||
          (adjoint[i].is_constant() && adjoint[i].constant() == 0)) {
        continue;
      }
      if (o.code == OperationCode::linear) {
        for (const LinearTerm& t : o.terms) adjoint[t.value] += t.coefficient * adjoint[i];
        continue;
      }
      const Partials partials = partial_derivatives(o, values, i);
      adjoint[o.u] += adjoint[i] * partials.u;
      if (has_two_operands(o.code)) adjoint[o.v] += adjoint[i] * partials.v;
    }
    adjoint.resize(list.inputs());  // the inputs stand first
    return adjoint;
  });
}

OperationList jacobian(const OperationList& list) {
  return record(list.inputs(), [&](std::span<const Expression> inputs) {
    const std::vector<Expression> values = replay(list, inputs);
    const std::size_t n = list.inputs();
    std::vector<std::vector<Expression>> tangents;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Operation& o = list.operations()[i];
      std::vector<Expression> tangent(n, Expression(0));
      if (o.code == OperationCode::input) {
        tangent[o.u] = 1;
      } else if (o.code == OperationCode::linear) {
        for (const LinearTerm& t : o.terms) {
          for (std::size_t j = 0; j < n; ++j) tangent[j] += t.coefficient * tangents[t.value][j];
        }
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
  });
}

OperationList restrict_list(const OperationList& list, std::span<const std::size_t> kept_inputs,
                            std::span<const std::size_t> kept_outputs) {
  return record(kept_inputs.size(), [&](std::span<const Expression> inputs) {
    std::vector<Expression> all(list.inputs(), Expression(0));
    for (std::size_t i = 0; i < kept_inputs.size(); ++i) all[kept_inputs[i]] = inputs[i];
    const std::vector<Expression> values = replay(list, all);
    std::vector<Expression> outputs;
    for (const std::size_t o : kept_outputs) outputs.push_back(values[list.outputs()[o]]);
    return outputs;
  });
}

bool output_vanishes(const OperationList& list, std::size_t output) {
  const Operation& o = list.operations()[list.outputs()[output]];
  return o.code == OperationCode::linear && o.terms.empty() && o.constant == 0;
}

}  // namespace hamjet
