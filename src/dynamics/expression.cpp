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
    return a.is_constant() ? recorder.constant_value(a.constant()).value() : a.value();
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

Recorder::Recorder(std::size_t inputs) : inputs_(inputs) {
  for (std::size_t i = 0; i < inputs; ++i) {
    Operation o;
    o.code = OperationCode::input;
    o.u = i;
    operations_.push_back(o);
  }
}

std::vector<Expression> Recorder::inputs() {
  std::vector<Expression> result;
  for (std::size_t i = 0; i < inputs_; ++i) result.push_back(input(i));
  return result;
}

std::size_t Recorder::record(Operation operation) {
  std::vector<std::pair<std::size_t, Extended>> terms;
  for (const LinearTerm& t : operation.terms) terms.emplace_back(t.value, t.coefficient);
  const Key key{operation.code, operation.u, operation.v, operation.constant, std::move(terms)};
  const auto [place, is_new] = known_.try_emplace(key, operations_.size());
  if (is_new) operations_.push_back(std::move(operation));
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

Expression Recorder::constant_value(const Extended& constant) {
  Operation o;
  o.constant = constant;
  return {this, record(std::move(o))};
}

std::pair<Expression, Expression> Recorder::sine_cosine(std::size_t u, OperationCode sine_code) {
  // Sine and cosine are recorded one after the other, so that the number of each follows from the
  // other's.
  const auto cosine_code = static_cast<OperationCode>(static_cast<int>(sine_code) + 1);
  const Key key{sine_code, u, 0, 0, {}};
  const auto known = known_.find(key);
  const std::size_t sine = known != known_.end() ? known->second : operations_.size();
  if (known == known_.end()) {
    known_.emplace(key, sine);
    operations_.push_back({sine_code, u, sine + 1, 0, {}});
    operations_.push_back({cosine_code, u, sine, 0, {}});
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
  std::vector<bool> needed(all.size(), false);
  for (std::size_t i = 0; i < inputs_; ++i) needed[i] = true;
  for (const std::size_t root : roots) needed[root] = true;
  for (std::size_t i = all.size(); i-- > inputs_;) {
    if (!needed[i]) continue;
    const Operation& o = all[i];
    for (const LinearTerm& term : o.terms) needed[term.value] = true;
    if (o.code == OperationCode::linear) continue;
    needed[o.u] = true;
    if (is_of_pair(o.code) || has_two_operands(o.code)) needed[o.v] = true;
  }
  std::vector<std::size_t> number(all.size(), 0);
  std::vector<Operation> kept;
  std::size_t next = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (needed[i]) number[i] = next++;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!needed[i]) continue;
    Operation o = all[i];
    if (o.code != OperationCode::input && o.code != OperationCode::linear) {
      o.u = number[o.u];
      o.v = number[o.v];
    }
    for (LinearTerm& term : o.terms) term.value = number[term.value];
    kept.push_back(std::move(o));
  }
  for (std::size_t& root : roots) root = number[root];
  return {inputs_, std::move(kept), std::move(roots)};
}

}  // namespace hamjet
