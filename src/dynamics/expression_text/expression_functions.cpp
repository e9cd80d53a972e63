#include "expression_functions.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

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

/// A value that is factor base^exponent with twice the exponent a whole number.
struct HalfPower {
  Extended factor;
  Expression base;
  Extended exponent;

  Expression value() const { return factor * pow(base, Expression(exponent)); }
};

bool is_half_integer(const Extended& x) { return 2 * x == floor(2 * x); }

std::optional<HalfPower> half_power(const Expression& e) {
  if (e.is_constant()) return std::nullopt;
  Recorder& recorder = *e.recorder();
  const Operation* o = &recorder.operation_of(e.value());
  Extended factor = 1;
  if (o->code == OperationCode::linear && o->constant == 0 && o->terms.size() == 1) {
    factor = o->terms[0].coefficient;
    o = &recorder.operation_of(o->terms[0].value);
  }
  if (o->code != OperationCode::power || !is_half_integer(o->constant)) return std::nullopt;
  return HalfPower{factor, recorder.value(o->u), o->constant};
}

}  // namespace

Expression merged_power(const Expression& a, const Expression& b) {
  if (!b.is_constant()) return exp(b * log(a));
  const Extended& e = b.constant();
  const auto power = half_power(a);
  if (power && is_half_integer(e) && (power->factor > 0 || e == floor(e)) &&
      is_half_integer(e * power->exponent)) {
    return HalfPower{pow(power->factor, e), power->base, e * power->exponent}.value();
  }
  return pow(a, b);
}

Expression merged_product(const Expression& a, const Expression& b) {
  const auto first = half_power(a);
  const auto second = half_power(b);
  const bool is_one_base = first && second && first->base.value() == second->base.value();
  if (!is_one_base) return a * b;
  return HalfPower{first->factor * second->factor, first->base, first->exponent + second->exponent}
      .value();
}

Expression merged_quotient(const Expression& a, const Expression& b) {
  const bool is_power = half_power(b).has_value() || (a.is_constant() && !b.is_constant());
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
