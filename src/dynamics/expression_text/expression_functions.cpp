#include "expression_functions.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace hamjet {
namespace {

constexpr std::string_view has_corner =
    "a function with a corner, which has no Taylor series there";
constexpr std::string_view has_jump = "a function with jumps, which has no Taylor series there";
constexpr std::string_view a_smooth_one =
    "a smooth function, such as sqrt(x^2 + d^2), or x or -x where x keeps its sign";
constexpr std::string_view a_smooth_step = "a smooth function, such as (1 + tanh(x/d))/2";

constexpr RefusedFunction refused_functions[] = {
    {"abs", has_corner, a_smooth_one},
    {"fabs", has_corner, a_smooth_one},
    {"Abs", has_corner, a_smooth_one},
    {"min", has_corner, a_smooth_one},
    {"max", has_corner, a_smooth_one},
    {"sign", has_jump, a_smooth_step},
    {"sgn", has_jump, a_smooth_step},
    {"heaviside", has_jump, a_smooth_step},
    {"Heaviside", has_jump, a_smooth_step},
    {"step", has_jump, a_smooth_step},
    {"floor", has_jump, a_smooth_step},
    {"ceil", has_jump, a_smooth_step},
    {"round", has_jump, a_smooth_step},
    {"mod", has_jump, "a smooth function; angles need no reduction"},
    {"fmod", has_jump, "a smooth function; angles need no reduction"},
    {"if", "a branch, which has no Taylor series where it changes", a_smooth_step},
    {"Piecewise", "a branch, which has no Taylor series where it changes", a_smooth_step},
    {"ln", "the logarithm by another name", "log(x)"},
    {"log10", "another logarithm", "log(x)/log(10)"},
    {"log2", "another logarithm", "log(x)/log(2)"},
    {"arcsin", "a function by another name", "asin(x)"},
    {"arccos", "a function by another name", "acos(x)"},
    {"arctan", "a function by another name", "atan(x)"},
    {"arctan2", "a function by another name", "atan2(y, x)"},
    {"sec", "a function made of others", "1/cos(x)"},
    {"csc", "a function made of others", "1/sin(x)"},
    {"cot", "a function made of others", "cos(x)/sin(x)"},
    {"cbrt", "a function made of others", "x^(1/3), where x is above 0"},
    {"hypot", "a function made of others", "sqrt(x^2 + y^2)"},
    {"asinh", "a function made of others", "log(x + sqrt(x^2 + 1))"},
    {"acosh", "a function made of others", "log(x + sqrt(x^2 - 1))"},
    {"atanh", "a function made of others", "log((1 + x)/(1 - x))/2"},
};

bool is_half_integer(const Extended& x) { return 2 * x == floor(2 * x); }

/// A value factor rest base^exponent, with twice the exponent a whole number; the rest may be
/// absent.
struct PowerProduct {
  Extended factor;
  std::optional<Expression> rest;
  Expression base;
  Extended exponent;

  bool is_of_base(const PowerProduct& other) const { return base.value() == other.base.value(); }
  Expression value() const {
    const Expression power = pow(base, Expression(exponent));
    return factor * (rest ? *rest * power : power);
  }
};

const Operation& operation_of(const Expression& e) { return e.recorder()->operation_of(e.value()); }

std::optional<PowerProduct> power_product(Expression e) {
  if (e.is_constant()) return std::nullopt;
  Recorder& recorder = *e.recorder();
  Extended factor = 1;
  if (const Operation& o = operation_of(e);
      o.code == OperationCode::linear && o.constant == 0 && o.terms.size() == 1) {
    factor = o.terms[0].coefficient;
    e = recorder.value(o.terms[0].value);
  }
  const auto is_power = [](const Operation& o) {
    return o.code == OperationCode::power && is_half_integer(o.constant);
  };
  const Operation& o = operation_of(e);
  if (is_power(o)) return PowerProduct{factor, std::nullopt, recorder.value(o.u), o.constant};
  if (o.code != OperationCode::product) return std::nullopt;
  for (const auto& [place, other] : {std::pair{o.u, o.v}, std::pair{o.v, o.u}}) {
    const Operation& power = recorder.operation_of(place);
    if (!is_power(power)) continue;
    return PowerProduct{factor, recorder.value(other), recorder.value(power.u), power.constant};
  }
  return std::nullopt;
}

/// The product of a sum, all of whose terms have powers of this one's base, with this power, term
/// by term; no value for other sums.
std::optional<Expression> distributed(const Expression& sum, const PowerProduct& power) {
  if (power.rest || sum.is_constant()) return std::nullopt;
  const Operation o = operation_of(sum);  // recording moves operations
  if (o.code != OperationCode::linear) return std::nullopt;
  std::vector<PowerProduct> terms;
  for (const LinearTerm& term : o.terms) {
    const auto of_term = power_product(sum.recorder()->value(term.value));
    if (!of_term || !of_term->is_of_base(power)) return std::nullopt;
    terms.push_back({of_term->factor * term.coefficient * power.factor, of_term->rest, power.base,
                     of_term->exponent + power.exponent});
  }
  Expression result = o.constant * power.value();
  for (const PowerProduct& term : terms) result += term.value();
  return result;
}

}  // namespace

Expression merged_power(const Expression& a, const Expression& b) {
  if (!b.is_constant()) return exp(b * log(a));
  const Extended& e = b.constant();
  const bool is_whole = e == floor(e);
  const auto power = power_product(a);
  const bool is_merged = power && is_half_integer(e) && is_half_integer(e * power->exponent) &&
                         (power->factor > 0 || is_whole) && (!power->rest || (is_whole && e > 0));
  if (!is_merged) return pow(a, b);
  std::optional<Expression> rest;
  if (power->rest) rest = pow(*power->rest, b);
  return PowerProduct{pow(power->factor, e), rest, power->base, e * power->exponent}.value();
}

Expression merged_product(const Expression& a, const Expression& b) {
  const auto first = power_product(a);
  const auto second = power_product(b);
  if (first && second && first->is_of_base(*second)) {
    std::optional<Expression> rest = first->rest ? first->rest : second->rest;
    if (first->rest && second->rest) rest = *first->rest * *second->rest;
    return PowerProduct{first->factor * second->factor, rest, first->base,
                        first->exponent + second->exponent}
        .value();
  }
  if (second) {
    if (const auto sum = distributed(a, *second)) return *sum;
  }
  if (first) {
    if (const auto sum = distributed(b, *first)) return *sum;
  }
  return a * b;
}

Expression merged_quotient(const Expression& a, const Expression& b) {
  const auto divisor = power_product(b);
  const bool is_power = (divisor && !divisor->rest) || (a.is_constant() && !b.is_constant());
  if (is_power) return merged_product(a, merged_power(b, Expression(-1)));
  return a / b;
}

const std::vector<ExpressionFunction>& expression_functions() {
  static const std::vector<ExpressionFunction> functions = {
      {.name = "sqrt",
       .of_one = [](const Expression& a) { return merged_power(a, Expression(0.5)); }},
      {.name = "exp", .of_one = [](const Expression& a) { return exp(a); }},
      {.name = "log", .of_one = [](const Expression& a) { return log(a); }},
      {.name = "sin", .of_one = [](const Expression& a) { return sin(a); }},
      {.name = "cos", .of_one = [](const Expression& a) { return cos(a); }},
      {.name = "tan", .of_one = tan},
      {.name = "asin", .of_one = asin},
      {.name = "acos", .of_one = acos},
      {.name = "atan", .of_one = atan},
      {.name = "atan2", .of_two = atan2},
      {.name = "sinh", .of_one = [](const Expression& a) { return sinh(a); }},
      {.name = "cosh", .of_one = [](const Expression& a) { return cosh(a); }},
      {.name = "tanh", .of_one = tanh},
      {.name = "pow", .of_two = merged_power},
      // The angle of a sine and a cosine that are known to be of one angle.
      {.name = "unit_angle",
       .of_two = [](const Expression& s, const Expression& c) { return angle(s, c); }},
  };
  return functions;
}

const ExpressionFunction* find_function(std::string_view name) {
  const auto& all = expression_functions();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const ExpressionFunction& f) { return f.name == name; });
  return found == all.end() ? nullptr : &*found;
}

const RefusedFunction* find_refused_function(std::string_view name) {
  const auto* found = std::find_if(std::begin(refused_functions), std::end(refused_functions),
                                   [&](const RefusedFunction& f) { return f.name == name; });
  return found == std::end(refused_functions) ? nullptr : found;
}

}  // namespace hamjet
