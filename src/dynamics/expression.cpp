#include "hamjet/detail/dynamics/expression.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Sums longer than this are not copied into other sums.
constexpr std::size_t longest_flattened_sum = 8;

Recorder& common_recorder(const Expression& a, const Expression& b) {
  if (a.is_constant()) return *b.recorder();
  if (!b.is_constant() && a.recorder() != b.recorder()) {
    throw Error(ErrorKind::usage, "expressions of two recordings are combined");
  }
  return *a.recorder();
}

Expression scaled_sum(const Expression& a, const Extended& factor_a, const Expression& b,
                      const Extended& factor_b) {
  if (a.is_constant() && b.is_constant()) {
    return Extended(factor_a * a.constant() + factor_b * b.constant());
  }
  Extended constant = 0;
  std::vector<LinearTerm> terms;
  for (const auto& [e, factor] : {std::pair{a, factor_a}, std::pair{b, factor_b}}) {
    if (e.is_constant()) {
      constant += factor * e.constant();
    } else {
      terms.push_back({e.value(), factor});
    }
  }
  return common_recorder(a, b).linear(constant, terms);
}

template <class Function>
Expression unary(const Expression& a, OperationCode code, Function fold) {
  if (a.is_constant()) return Extended(fold(a.constant()));
  return a.recorder()->operation(code, a.value());
}

}  // namespace

Expression operator+(const Expression& a, const Expression& b) { return scaled_sum(a, 1, b, 1); }
Expression operator-(const Expression& a, const Expression& b) { return scaled_sum(a, 1, b, -1); }
Expression operator-(const Expression& a) { return scaled_sum(a, -1, Expression(), 0); }

Expression operator*(const Expression& a, const Expression& b) {
  if (a.is_constant()) return scaled_sum(b, a.constant(), Expression(), 0);
  if (b.is_constant()) return scaled_sum(a, b.constant(), Expression(), 0);
  Recorder& recorder = common_recorder(a, b);
  if (a.value() == b.value()) return square(a);
  return recorder.operation(OperationCode::product, std::min(a.value(), b.value()),
                            std::max(a.value(), b.value()));
}

Expression operator/(const Expression& a, const Expression& b) {
  if (b.is_constant()) {
    if (b.constant() == 0) throw Error(ErrorKind::usage, "expression: division by zero");
    return scaled_sum(a, 1 / b.constant(), Expression(), 0);
  }
  if (a.is_constant()) return a * pow(b, Expression(-1));
  const Recorder& recorder = common_recorder(a, b);
  // With an inverse, a quotient with a number is a product with a number.
  if (recorder.is_number(a.value()) != recorder.is_number(b.value())) {
    return a * pow(b, Expression(-1));
  }
  return common_recorder(a, b).operation(OperationCode::quotient, a.value(), b.value());
}

Expression square(const Expression& a) {
  if (a.is_constant()) return Extended(a.constant() * a.constant());
  return a.recorder()->operation(OperationCode::square, a.value());
}

Expression pow(const Expression& a, const Expression& exponent) {
  if (!exponent.is_constant()) {
    throw Error(ErrorKind::usage, "expression: the exponent of pow must be a constant");
  }
  const Extended& e = exponent.constant();
  if (a.is_constant()) return Extended(pow(a.constant(), e));
  if (e == 0) return 1;
  if (e == 1) return a;
  // Small natural powers are recorded as products, which also hold where the base is zero.
  if (e > 1 && e <= 16 && e == floor(e)) {
    const int n = static_cast<int>(e);
    const Expression half = pow(a, Expression(n / 2));
    return n % 2 == 0 ? square(half) : square(half) * a;
  }
  return a.recorder()->operation(OperationCode::power, a.value(), 0, e);
}

Expression sqrt(const Expression& a) { return pow(a, Expression(0.5)); }
Expression exp(const Expression& a) {
  return unary(a, OperationCode::exponential, [](const Extended& x) { return exp(x); });
}
Expression log(const Expression& a) {
  return unary(a, OperationCode::logarithm, [](const Extended& x) { return log(x); });
}
Expression sin(const Expression& a) {
  if (a.is_constant()) return Extended(sin(a.constant()));
  return a.recorder()->sine_cosine(a.value()).first;
}
Expression cos(const Expression& a) {
  if (a.is_constant()) return Extended(cos(a.constant()));
  return a.recorder()->sine_cosine(a.value()).second;
}
Expression sinh(const Expression& a) {
  if (a.is_constant()) return Extended(sinh(a.constant()));
  return a.recorder()->sine_cosine(a.value(), OperationCode::hyperbolic_sine).first;
}
Expression cosh(const Expression& a) {
  if (a.is_constant()) return Extended(cosh(a.constant()));
  return a.recorder()->sine_cosine(a.value(), OperationCode::hyperbolic_sine).second;
}
Expression angle(const Expression& sine, const Expression& cosine) {
  if (sine.is_constant() && cosine.is_constant()) {
    return Extended(atan2(sine.constant(), cosine.constant()));
  }
  Recorder& recorder = common_recorder(sine, cosine);
  const auto value = [&](const Expression& a) {
    return a.is_constant() ? recorder.constant_value(a.constant()) : a.value();
  };
  const std::size_t u = value(sine);
  return recorder.operation(OperationCode::angle, u, value(cosine));
}

Expression tan(const Expression& a) { return sin(a) / cos(a); }
Expression tanh(const Expression& a) { return sinh(a) / cosh(a); }
Expression asin(const Expression& a) { return angle(a, sqrt((1 - a) * (1 + a))); }
Expression acos(const Expression& a) { return angle(sqrt((1 - a) * (1 + a)), a); }
Expression atan(const Expression& a) { return atan2(a, 1); }
Expression atan2(const Expression& y, const Expression& x) {
  const Expression inverse_radius = pow(square(x) + square(y), Expression(-0.5));
  return angle(y * inverse_radius, x * inverse_radius);
}

Expression field_value(const std::shared_ptr<const LocalField>& field,
                       const std::array<Expression, 3>& position,
                       const std::array<int, 3>& orders) {
  Recorder* recorder = nullptr;
  for (const Expression& x : position) {
    if (!x.is_constant()) recorder = x.recorder();
  }
  if (recorder == nullptr) {
    const int degree = orders[0] + orders[1] + orders[2];
    std::vector<Extended> coefficients(local_field_size(degree));
    field->expand(1, &position[0].constant(), &position[1].constant(), &position[2].constant(),
                  degree, coefficients.data());
    Extended value = coefficients[field_monomial(orders[0], orders[1], orders[2])];
    for (const int order : orders) {
      for (int k = 2; k <= order; ++k) value *= k;
    }
    return value;
  }
  FieldPart part;
  part.field = field;
  part.orders = orders;
  Operation o;
  o.code = OperationCode::field;
  for (std::size_t i = 0; i < 3; ++i) {
    const Expression& x = position[i];
    if (!x.is_constant() && x.recorder() != recorder) {
      throw Error(ErrorKind::usage, "expressions of two recordings are combined");
    }
    part.position[i] = x.is_constant() ? recorder->constant_value(x.constant()) : x.value();
  }
  o.parts.push_back(std::move(part));
  return {recorder, recorder->record(std::move(o))};
}

std::vector<Expression> time_values(const std::shared_ptr<const TimeFunction>& function,
                                    const Expression& t) {
  std::vector<Expression> values;
  if (t.is_constant()) {
    std::vector<Extended> numbers(function->components());
    function->expand(t.constant(), 0, numbers.data());
    for (const Extended& x : numbers) values.emplace_back(x);
    return values;
  }
  if (!t.recorder()->is_time(t.value())) {
    throw Error(ErrorKind::usage,
                "expression: the argument of a function of the time must be the time itself");
  }
  for (std::size_t c = 0; c < function->components(); ++c) {
    values.push_back(t.recorder()->time_function(function, c, t.value()));
  }
  return values;
}

Recorder::Recorder(std::size_t inputs, bool has_time) : inputs_(inputs), has_time_(has_time) {
  for (std::size_t i = 0; i < inputs; ++i) {
    Operation o;
    o.code = OperationCode::input;
    o.u = i;
    append(std::move(o));
  }
}

void Recorder::append(Operation operation) {
  bool is_number =
      operation.code != OperationCode::input || (has_time_ && operation.u + 1 == inputs_);
  for_each_operand(operation,
                   [&](std::size_t operand) { is_number = is_number && is_number_[operand]; });
  is_number_.push_back(is_number);
  operations_.push_back(std::move(operation));
}

std::vector<Expression> Recorder::inputs() {
  std::vector<Expression> result;
  for (std::size_t i = 0; i < inputs_; ++i) result.push_back(input(i));
  return result;
}

std::size_t Recorder::record(Operation operation) {
  std::vector<std::pair<std::size_t, Extended>> terms;
  for (const LinearTerm& t : operation.terms) terms.emplace_back(t.value, t.coefficient);
  const void* object = operation.time_function.get();
  std::array<std::size_t, 6> details = {operation.component};
  if (!operation.parts.empty()) {
    const FieldPart& part = operation.parts[0];
    object = part.field.get();
    for (std::size_t i = 0; i < 3; ++i) {
      details[i] = part.position[i];
      details[3 + i] = static_cast<std::size_t>(part.orders[i]);
    }
  }
  const Key key{operation.code,   operation.u, operation.v, operation.constant,
                std::move(terms), object,      details};
  const auto [place, is_new] = known_.try_emplace(key, operations_.size());
  if (is_new) append(std::move(operation));
  return place->second;
}

Expression Recorder::linear(const Extended& constant, const std::vector<LinearTerm>& terms) {
  Extended sum = constant;
  std::map<std::size_t, Extended> collected;
  for (const LinearTerm& term : terms) {
    if (term.coefficient == 0) continue;
    const Operation& o = operations_[term.value];
    if (o.code == OperationCode::linear && o.terms.size() <= longest_flattened_sum) {
      sum += term.coefficient * o.constant;
      for (const LinearTerm& inner : o.terms) {
        collected[inner.value] += term.coefficient * inner.coefficient;
      }
    } else {
      collected[term.value] += term.coefficient;
    }
  }
  Operation result;
  result.constant = sum;
  for (const auto& [value, coefficient] : collected) {
    if (coefficient != 0) result.terms.push_back({value, coefficient});
  }
  if (result.terms.empty()) return sum;
  if (sum == 0 && result.terms.size() == 1 && result.terms[0].coefficient == 1) {
    return {this, result.terms[0].value};
  }
  return {this, record(std::move(result))};
}

Expression Recorder::operation(OperationCode code, std::size_t u, std::size_t v,
                               const Extended& constant) {
  Operation o;
  o.code = code;
  o.u = u;
  o.v = v;
  o.constant = constant;
  return {this, record(std::move(o))};
}

std::size_t Recorder::constant_value(const Extended& constant) {
  Operation o;
  o.constant = constant;
  return record(std::move(o));
}

Expression Recorder::time_function(const std::shared_ptr<const TimeFunction>& function,
                                   std::size_t component, std::size_t time) {
  Operation o;
  o.code = OperationCode::time_function;
  o.u = time;
  o.time_function = function;
  o.component = component;
  return {this, record(std::move(o))};
}

std::pair<Expression, Expression> Recorder::sine_cosine(std::size_t u, OperationCode sine_code) {
  // Sine and cosine are recorded one after the other, so that the number of each follows from the
  // other's.
  const auto cosine_code = static_cast<OperationCode>(static_cast<int>(sine_code) + 1);
  const Key key{sine_code, u, 0, 0, {}, nullptr, {}};
  const auto known = known_.find(key);
  const std::size_t sine = known != known_.end() ? known->second : operations_.size();
  if (known == known_.end()) {
    known_.emplace(key, sine);
    append({sine_code, u, sine + 1});
    append({cosine_code, u, sine});
  }
  return {Expression(this, sine), Expression(this, sine + 1)};
}

OperationList Recorder::finish(std::span<const Expression> outputs) const {
  std::vector<Operation> all = operations_;
  std::vector<std::size_t> roots;
  for (const Expression& e : outputs) {
    if (e.is_constant()) {
      Operation constant;
      constant.constant = e.constant();
      all.push_back(constant);
      roots.push_back(all.size() - 1);
    } else {
      roots.push_back(e.value());
    }
  }
  return needed_operations(inputs_, std::move(all), std::move(roots), has_time_);
}

}  // namespace hamjet
