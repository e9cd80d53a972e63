#include "hamjet/dynamics/expression_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

const std::vector<std::string> variables = {"x", "y", "px"};

FunctionText function_of(const std::string& text) {
  FunctionText function;
  function.variables = variables;
  function.parameters = {{"mu", "1/4"}};
  function.outputs = {{"hamiltonian", text}};
  return function;
}

double value_of(const std::string& text, std::vector<Extended> point = {0.5, -2, 3}) {
  return static_cast<double>(evaluate_function(function_of(text), point)[0]);
}

TEST(ExpressionText, HasThePrecedenceOfPython) {
  // Values by hand at x = 1/2, y = -2, px = 3.
  EXPECT_EQ(value_of("1 + 2*3"), 7);
  EXPECT_EQ(value_of("8/4/2"), 1);
  EXPECT_EQ(value_of("8 - 4 - 2"), 2);
  EXPECT_EQ(value_of("-x^2"), -0.25);
  EXPECT_EQ(value_of("-x**2"), -0.25);
  EXPECT_EQ(value_of("2^3^2"), 512);
  EXPECT_DOUBLE_EQ(value_of("2^-x^2"), std::pow(2, -0.25));
  EXPECT_EQ(value_of("(-x)^2"), 0.25);
  EXPECT_EQ(value_of("--x - -+x"), 1);
  EXPECT_EQ(value_of("2*-y"), 4);
  EXPECT_EQ(value_of("x*-y^3"), 4);
  EXPECT_EQ(value_of("1/2*px"), 1.5);
  EXPECT_EQ(value_of("mu*px - (x - y)*(x + y)"), 0.75 - 2.5 * -1.5);
  EXPECT_EQ(value_of(" 1.5e1 + .5\n\t+ 2.e-1*10"), 17.5);
  EXPECT_EQ(value_of("pow(px, 2) + px^mu^0"), 12);
}

TEST(ExpressionText, HasTheFunctionsOfTheLibrary) {
  const double x = 0.5, y = -2;
  EXPECT_DOUBLE_EQ(value_of("sqrt(px)"), std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(value_of("exp(x) + log(px)"), std::exp(x) + std::log(3.0));
  EXPECT_DOUBLE_EQ(value_of("sin(x)*cos(y) + tan(x)"), std::sin(x) * std::cos(y) + std::tan(x));
  EXPECT_DOUBLE_EQ(value_of("asin(x) - acos(-x)"), std::asin(x) - std::acos(-x));
  EXPECT_DOUBLE_EQ(value_of("atan(px)"), std::atan(3.0));
  EXPECT_DOUBLE_EQ(value_of("atan2(y, -x)"), std::atan2(y, -x));
  EXPECT_DOUBLE_EQ(value_of("sinh(x) + cosh(y) + tanh(x)"),
                   std::sinh(x) + std::cosh(y) + std::tanh(x));
  EXPECT_DOUBLE_EQ(value_of("px^x + px^y"), std::sqrt(3.0) + 1 / 9.0);
  EXPECT_DOUBLE_EQ(value_of("pi"), std::acos(-1.0));
  // Near 0 no digit is lost: sinh(1e-20) = 1e-20 (1 + 1e-40/6).
  EXPECT_DOUBLE_EQ(value_of("sinh(x)*1e20", {Extended("1e-20"), 1, 1}), 1);
}

// Powers of one value are merged: the Hamiltonian of Kepler's problem needs one, and so does its
// force.
TEST(ExpressionText, MergesPowersOfOneValue) {
  FunctionText function = function_of("1/r + 3*x/r^3 + (2/r)^2*r");
  function.definitions = {{"r", "sqrt(x^2 + y^2)"}};
  const OperationList list = record_function(function);
  std::vector<double> exponents;
  for (const Operation& o : list.operations()) {
    EXPECT_NE(o.code, OperationCode::quotient);
    if (o.code == OperationCode::power) exponents.push_back(static_cast<double>(o.constant));
  }
  EXPECT_EQ(exponents, (std::vector<double>{-0.5, -1.5}));
  EXPECT_DOUBLE_EQ(value_of("sqrt(px)^3*sqrt(px)/px", {1, 1, 7}), 7);
  function.is_literal = true;
  EXPECT_GT(record_function(function).nonlinear_operations(), list.nonlinear_operations());
}

TEST(ExpressionText, TakesDefinitionsInAnyOrderAndTheTime) {
  FunctionText function = function_of("b - t");
  function.definitions = {{"b", "2*a"}, {"a", "x*mu"}};
  const OperationList list = record_function(function);
  EXPECT_EQ(list.inputs(), 4U);
  EXPECT_EQ(evaluate_function(function, std::vector<Extended>{8, 0, 0}, 1)[0], 3);
  // What is written twice is computed once, by name or not.
  function.outputs[0].text = "a*a + (mu*x)^2";
  EXPECT_EQ(record_function(function).nonlinear_operations(), 1U);
}

// By these identities the function is x at every time, so that its list has no time.
TEST(ExpressionText, HasNoTimeOnWhichNothingDepends) {
  const OperationList x = record_function(function_of("x"));
  for (const char* text : {"x + 0*t", "x*t^0", "x + t - t", "x + sin(0*pi*t)", "x + 0*log(t)"}) {
    const OperationList list = record_function(function_of(text));
    EXPECT_TRUE(is_same_list(list, x)) << text;
    EXPECT_EQ(evaluate_function(function_of(text), std::vector<Extended>{8, 0, 0}, 2)[0], 8);
  }
  const FunctionText printed = print_list(with_time(x), variables, {"hamiltonian"});
  EXPECT_TRUE(is_same_list(record_function(printed), x));
  EXPECT_TRUE(record_function(function_of("x + t*0.5")).has_time());
}

/// A random expression: its text with as few parentheses as precedence allows, some needless ones
/// and spaces, and its value by Boost's own functions.
struct Sample {
  using Value = std::function<Extended(const std::vector<Extended>&)>;
  std::string text;
  int binding = 3;  ///< of a sum 0, a product 1, a power 2, anything else 3
  Value value;
};

class SampleMaker {
 public:
  explicit SampleMaker(unsigned seed) : random_(seed) {}

  Sample make(int depth) {
    if (depth == 0) return leaf();
    const Sample a = make(depth - 1 - below(2) * (depth > 1));
    const Sample b = make(depth - 1 - below(2) * (depth > 1));
    const auto u = a.value, v = b.value;
    using Point = const std::vector<Extended>&;
    switch (below(18)) {
      case 0:
        return {at(a, 0) + " +" + space() + at(b, 0), 0, [=](Point p) { return u(p) + v(p); }};
      case 1:
        return {at(a, 0) + space() + "- " + at(b, 1), 0, [=](Point p) { return u(p) - v(p); }};
      case 2:
      case 3:
        return {at(a, 1) + "*" + space() + at(b, 2), 1, [=](Point p) { return u(p) * v(p); }};
      case 4:
        return {at(a, 1) + "/(2 + sin(" + b.text + "))", 1,
                [=](Point p) { return u(p) / (2 + sin(v(p))); }};
      case 5:
        return {"-" + at(a, 1), 0, [=](Point p) { return -u(p); }};
      case 6:
        return {at(a, 3) + (below(2) == 0 ? "^" : "**") + "2", 2,
                [=](Point p) { return u(p) * u(p); }};
      case 7:
        return {"(1 + " + at(a, 3) + "^2)^-1.5", 2,
                [=](Point p) { return pow(1 + u(p) * u(p), Extended(-1.5)); }};
      case 8:
        return {"sqrt(" + at(a, 3) + "^2 + 0.5)", 3,
                [=](Point p) { return sqrt(u(p) * u(p) + Extended(0.5)); }};
      case 9:
        return {"exp(sin(" + a.text + "))", 3, [=](Point p) { return exp(sin(u(p))); }};
      case 10:
        return {"log(2 + cos(" + a.text + "))", 3, [=](Point p) { return log(2 + cos(u(p))); }};
      case 11:
        return {"cos(" + a.text + space() + ")", 3, [=](Point p) { return cos(u(p)); }};
      case 12:
        return {"sinh(sin(" + a.text + "))", 3, [=](Point p) { return sinh(sin(u(p))); }};
      case 13:
        return {"cosh(cos(" + a.text + ")) + tanh(" + b.text + ")", 0,
                [=](Point p) { return cosh(cos(u(p))) + tanh(v(p)); }};
      case 14:
        return {"asin(sin(" + a.text + ")/2)", 3, [=](Point p) { return asin(sin(u(p)) / 2); }};
      case 15:
        return {"acos(tanh(" + a.text + ")/1.5)", 3,
                [=](Point p) { return acos(tanh(u(p)) / Extended(1.5)); }};
      case 16:
        return {"atan2(" + a.text + "," + space() + "-1 - " + at(b, 3) + "^2)", 3,
                [=](Point p) { return atan2(u(p), -1 - v(p) * v(p)); }};
      default:
        return {"(2 + sin(" + a.text + "))^cos(" + b.text + ")", 2,
                [=](Point p) { return pow(2 + sin(u(p)), cos(v(p))); }};
    }
  }

 private:
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  std::string space() { return std::string(static_cast<std::size_t>(below(3)), ' '); }

  std::string at(const Sample& of, int binding) {
    return of.binding < binding || below(8) == 0 ? "(" + of.text + ")" : of.text;
  }

  Sample leaf() {
    static constexpr const char* numbers[] = {"2", "0.3", ".75", "1.25e-1", "3", "mu"};
    if (below(3) == 0) {
      const std::string text = numbers[below(6)];
      const Extended number = text == "mu" ? Extended(0.25) : Extended(text);
      return {text, 3, [=](const std::vector<Extended>&) { return number; }};
    }
    const auto i = static_cast<std::size_t>(below(3));
    return {variables[i], 3, [=](const std::vector<Extended>& point) { return point[i]; }};
  }

  std::mt19937 random_;
};

// Values and jets of 200 expressions, against the same by Boost's functions, without recorder and
// parser: the Taylor polynomial of order 5 at a small distance is the value there.
TEST(ExpressionText, RandomExpressionsHaveTheirValuesJetsAndTexts) {
  SampleMaker maker(48);
  const auto space = SeriesSpace::create(3, 5);
  const std::vector<Extended> point = {Extended(0.3), Extended(-0.7), Extended(0.45)};
  const Extended step = Extended(1) / (1 << 20);
  for (int trial = 0; trial < 200; ++trial) {
    const Sample sample = maker.make(4);
    const FunctionText function = function_of(sample.text);
    OperationList list;
    ASSERT_NO_THROW(list = record_function(function)) << sample.text;
    const Extended expected = sample.value(point);
    const double scale = 1 + std::abs(static_cast<double>(expected));
    const Extended value = test::evaluate_list(list, point)[0];
    EXPECT_LE(std::abs(static_cast<double>(Extended(value - expected))), 1e-27 * scale)
        << sample.text;
    std::vector<Series<Extended>> inputs;
    std::vector<Extended> there = point;
    for (std::size_t i = 0; i < 3; ++i) {
      inputs.push_back(Series<Extended>::variable(space, i, point[i]));
      there[i] += step;
    }
    const Series<Extended> jet = evaluate_on_series(list, inputs)[0];
    Extended sum = 0;
    for (std::size_t k = jet.size(); k-- > 0;) {
      Extended monomial = jet[k];
      int degree = 0;
      while (k >= space->first(degree + 1)) ++degree;
      for (int d = 0; d < degree; ++d) monomial *= step;
      sum += monomial;
    }
    // The remainder is about a coefficient of degree 6 times 1e-36.
    const double largest = test::largest_coefficient(jet);
    EXPECT_LE(std::abs(static_cast<double>(Extended(sum - sample.value(there)))),
              1e-27 * (scale + largest))
        << sample.text;
    const FunctionText printed = print_list(list, variables, {"hamiltonian"});
    EXPECT_TRUE(is_same_list(record_function(printed), list)) << sample.text;
  }
}

TEST(ExpressionText, PrintsDerivedListsAndLongSums) {
  // Its constant 0, the cosine of an angle, stands before the powers.
  FunctionText angle;
  angle.variables = {"x", "y"};
  angle.outputs = {{"hamiltonian", "exp(-atan2(y, 0))*atan2(y, 0) - cos(x - t)*t^3/3^-x"}};
  const OperationList with_angle = record_function(angle);
  EXPECT_TRUE(is_same_list(record_function(print_list(with_angle, {"x", "y"}, {"hamiltonian"})),
                           with_angle));
  const std::vector<std::string> names = {"x", "y", "z", "px", "py", "pz"};
  const DynamicalSystem system =
      zonal_gravity({1, 0.9, {{2, 1e-3}, {3, -2.5e-6}, {5, 1e-7}, {12, 3e-8}}});
  const OperationList& field = system.vector_field;
  EXPECT_TRUE(is_same_list(record_function(print_list(field, names, names)), field));
  const OperationList slopes = jacobian(field);
  std::vector<std::string> outputs;
  for (std::size_t i = 0; i < slopes.outputs().size(); ++i)
    outputs.push_back(fmt::format("o{}", i));
  EXPECT_TRUE(is_same_list(record_function(print_list(slopes, names, outputs)), slopes));
  // The beginning of the first sum is an operation of its own, later.
  const OperationList sums = record_function(function_of("1/asin(x + y^2) - 1/(y^2 + (x + 1)^2)"));
  EXPECT_TRUE(is_same_list(record_function(print_list(sums, variables, {"hamiltonian"})), sums));
  const OperationList list = record(6, [](std::span<const Expression> z) {
    Expression sum(0.1), other(-1);
    for (int i = 0; i < 6; ++i) {
      sum += -0.3 * z[static_cast<std::size_t>(i)];
      other -= square(z[static_cast<std::size_t>(i)]);
    }
    return std::vector<Expression>{sum + other, Expression(-0.1), z[2], -z[3], 0.5 * z[1] + 1};
  });
  const FunctionText text = print_list(list, names, {"a", "b", "c", "d", "e"});
  EXPECT_TRUE(is_same_list(record_function(text), list));
  test::expect_error(ErrorKind::usage, "2 outputs", [&] { print_list(list, names, {"a", "b"}); });
}

/// A text, and words of the message that refuses it.
struct Mistake {
  const char* text;
  std::vector<std::string> words;
};

TEST(ExpressionText, TellsMistakesWithTheirPlace) {
  const std::vector<Mistake> mistakes = {
      {"", {"empty", "an expression"}},
      {"  ", {"empty"}},
      {"x +", {"cut off", "the end of the text", "column 4"}},
      {"-", {"cut off", "column 2"}},
      {"(x + y", {"\"(\" that is not closed", "must be \")\""}},
      {"x + y)", {"\")\" without \"(\"", "column 6"}},
      {"()", {"nothing between parentheses"}},
      {"x*)", {"an operand is missing", "got \")\" at column 3"}},
      {")x", {"an operand is missing", "got \")\" at column 1"}},
      {"2x", {"no operator", "got \"x\" at column 2", "* of a product"}},
      {"x y", {"no operator", "got \"y\" at column 3"}},
      {"x (y)", {"no function", "got \"x\" at column 1", "x*( )"}},
      {"2(y)", {"no operator", "got \"(\""}},
      {"x + * y", {"an operand is missing", "got \"*\" at column 5"}},
      {"x ^^ 2", {"an operand is missing", "column 4"}},
      {"x * * y", {"an operand is missing", "column 5"}},
      {"1.2.3", {"a second point", "column 4"}},
      {"x, y", {"a comma outside the arguments"}},
      {"sin x", {"a function without parentheses", "sin(x)"}},
      {"sin", {"a function without arguments"}},
      {"sin()", {"nothing between parentheses", "column 5"}},
      {"sin(x, y)", {"a function of 2 arguments", "must have 1"}},
      {"atan2(x)", {"a function of 1 argument", "atan2(y, x)"}},
      {"pz + x", {"unknown name", "got \"pz\" at column 1", "mu, px, x, y, pi"}},
      {"foo(x)", {"unknown function", "sqrt, exp, log"}},
      {"sinn(x)", {"unknown function", "sin"}},
      {"abs(x)", {"a corner", "no Taylor series", "sqrt(x^2 + d^2)"}},
      {"max(x, y)", {"a corner", "must be a smooth function"}},
      {"sign(x)", {"jumps", "tanh(x/d)"}},
      {"ln(x)", {"must be log(x)"}},
      {"arctan2(y, x)", {"must be atan2(y, x)"}},
      {"mu(x)", {"no function", "mu*( )"}},
      {"H = x", {"an equation", "column 3"}},
      {"x[0]", {"a bracket", "must be ("}},
      {"x < y", {"a comparison", "no Taylor series"}},
      {"|x|", {"a magnitude"}},
      {"x\u00B2", {"a raised digit", "must be ^2"}},
      {"x \u2212 y", {"a minus sign of typography", "must be -"}},
      {"x @ y", {"no character of expressions", "got \"@\" at column 3"}},
      {"x/0", {"division by zero", "got \"/\" at column 2"}},
      {"x/(mu - 1/4)", {"division by zero"}},
      {"sqrt(-2)*x", {"no finite real value", "it is given -2"}},
      {"log(0)", {"no finite real value"}},
      {"(-2)^x", {"a complex power", "base above 0"}},
      {"0^-1", {"division by zero: a negative power of 0"}},
      {"1e400*x", {"out of range", "binary64"}},
      {"1e-400*x", {"out of range", "binary64"}},
      {"x\n  + foo", {"unknown name", "line 2, column 5"}}};
  EXPECT_GE(mistakes.size(), 40U);
  for (const Mistake& mistake : mistakes) {
    test::expect_error([&] { record_function(function_of(mistake.text)); }, ErrorKind::usage,
                       mistake.words, mistake.text);
  }
}

TEST(ExpressionText, TellsMistakesOfNames) {
  const auto refuse = [](const std::vector<std::string>& words, const auto& change) {
    FunctionText function = function_of("x");
    change(function);
    test::expect_error([&] { record_function(function); }, ErrorKind::usage, words, "");
  };
  refuse({"parameters.x", "a name given twice", "a variable"}, [](FunctionText& f) {
    f.parameters = {{"x", "1"}};
  });
  refuse({"definitions.mu", "a name given twice", "parameters.mu"}, [](FunctionText& f) {
    f.definitions = {{"mu", "1"}};
  });
  refuse({"parameters.sin", "the function sin"}, [](FunctionText& f) {
    f.parameters = {{"sin", "1"}};
  });
  refuse({"parameters.pi", "the number pi"}, [](FunctionText& f) { f.parameters = {{"pi", "3"}}; });
  refuse({"parameters.t", "t is the time"}, [](FunctionText& f) { f.parameters = {{"t", "3"}}; });
  refuse({"no name", "must be a letter"}, [](FunctionText& f) { f.variables[0] = "2x"; });
  refuse({"parameters.mu", "not constant", "got \"x\""}, [](FunctionText& f) {
    f.parameters = {{"mu", "2*x"}};
  });
  refuse({"parameters.mu", "not constant", "got \"t\""}, [](FunctionText& f) {
    f.parameters = {{"mu", "2*t"}};
  });
  refuse({"definitions.b", "defined by itself", "definitions.a"}, [](FunctionText& f) {
    f.definitions = {{"a", "b + x"}, {"b", "2*a"}};
  });
  // A mistake is told where no output needs the definition, too.
  refuse({"definitions.a", "unknown name"}, [](FunctionText& f) {
    f.definitions = {{"a", "nobody"}};
  });
}

TEST(ExpressionText, TellsWhereAPointHasNoValue) {
  test::expect_error([] { value_of("x + 1/(px - 3)"); }, ErrorKind::usage,
                     {"division by zero", "got \"/\" at column 6"}, "");
  test::expect_error([] { value_of("log(x - px)"); }, ErrorKind::usage,
                     {"no finite real value", "it is given -2.5"}, "");
}

TEST(ExpressionText, FindsNamesThatNothingUses) {
  FunctionText function = function_of("x*a");
  function.definitions = {{"a", "y"}, {"b", "c"}, {"c", "y^2"}};
  EXPECT_EQ(unused_names(function),
            (std::vector<std::string>{"parameters.mu", "definitions.b", "definitions.c"}));
}

// A long chain of definitions, and deep parentheses, use no stack without bound.
TEST(ExpressionText, KeepsItsStackSmall) {
  FunctionText function = function_of("d9999");
  for (int i = 0; i < 10000; ++i) {
    const int next = i == 0 ? 0 : i - 1;
    function.definitions.push_back(
        {fmt::format("d{}", i), i == 0 ? "x" : fmt::format("d{} + 1", next)});
  }
  std::reverse(function.definitions.begin(), function.definitions.end());
  EXPECT_EQ(evaluate_function(function, std::vector<Extended>{1, 0, 0})[0], 10000);
  const std::string deep(150, '(');
  EXPECT_EQ(value_of(deep + "x" + std::string(150, ')')), 0.5);
  test::expect_error([&] { record_function(function_of(std::string(100000, '(') + "x")); },
                     ErrorKind::usage, {"nested too deep"}, "");
  EXPECT_EQ(value_of(std::string(100000, '-') + "x"), 0.5);
}

}  // namespace
}  // namespace hamjet
