#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/dynamics/expression_text.hpp"

// Lists are read again by the same recorder, which folds, orders and shares operations as it did
// when the list was made. Written one after the other, each as a definition, they are recorded in
// their order and thus as the same list. A text without most of these names is shorter; where it is
// read as the same list, it is preferred.

namespace hamjet {
namespace {

/// How closely a text binds: what stands beside an operator may have to be put in parentheses.
enum class Binding { sum, product, power, whole };

struct Printed {
  std::string text;
  Binding binding = Binding::whole;
};

/// Sums with more terms than this are not copied into others by the recorder.
constexpr std::size_t terms_together = 8;

/// A text of this length gets a name of its own.
constexpr std::size_t longest_without_name = 60;

/// The shortest text from which the number is read again.
std::string number_text(const Extended& value) {
  for (const std::streamsize digits : {6, 17, 26}) {
    std::string text = value.str(digits);
    if (Extended(text) == value) return text;
  }
  return value.str(std::numeric_limits<Extended>::max_digits10);
}

bool is_same(const Operation& a, const Operation& b) {
  const auto is_same_term = [](const LinearTerm& x, const LinearTerm& y) {
    return x.value == y.value && x.coefficient == y.coefficient;
  };
  return a.code == b.code && a.u == b.u && a.v == b.v && a.constant == b.constant &&
         std::equal(a.terms.begin(), a.terms.end(), b.terms.begin(), b.terms.end(), is_same_term);
}

class ListPrinter {
 public:
  ListPrinter(const OperationList& list, const std::vector<std::string>& variables,
              bool names_everything)
      : list_(list), variables_(variables), names_everything_(names_everything) {
    uses_.assign(list.operations().size(), 0);
    for (const Operation& o : list.operations()) {
      if (o.code == OperationCode::input) continue;
      for (const LinearTerm& term : o.terms) ++uses_[term.value];
      if (o.code != OperationCode::linear) ++uses_[o.u];
      if (has_two_operands(o.code)) ++uses_[o.v];
    }
    for (const std::size_t o : list.outputs()) ++uses_[o];
    const auto is_taken = [&](const std::string& variable) {
      return variable.starts_with(prefix_);
    };
    while (std::any_of(variables.begin(), variables.end(), is_taken)) prefix_ += "_";
  }

  FunctionText print(const std::vector<std::string>& outputs) {
    FunctionText function;
    function.variables = variables_;
    function.is_literal = true;
    if (list_.has_time()) variables_.emplace_back(time_variable);
    for (std::size_t i = 0; i < list_.operations().size(); ++i) {
      values_.push_back(printed(i));
      const bool is_input = i < list_.inputs();
      const bool has_name =
          names_everything_ || uses_[i] > 1 || values_[i].text.size() > longest_without_name;
      if (is_input || !has_name || uses_[i] == 0) continue;
      std::string name = fmt::format("{}{}", prefix_, function.definitions.size() + 1);
      function.definitions.push_back({name, std::move(values_[i].text)});
      values_[i] = {std::move(name)};
    }
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      function.outputs.push_back({outputs[o], values_[list_.outputs()[o]].text});
    }
    return function;
  }

 private:
  /// The text of a value, in parentheses unless it binds as closely as this.
  std::string operand(std::size_t value, Binding least) const {
    const Printed& p = values_[value];
    return p.binding >= least ? p.text : fmt::format("({})", p.text);
  }

  std::string call(std::string_view function, std::size_t u) const {
    return fmt::format("{}({})", function, values_[u].text);
  }

  Printed printed(std::size_t i) const {
    const Operation& o = list_.operations()[i];
    switch (o.code) {
      case OperationCode::input:
        return {variables_[o.u]};
      case OperationCode::linear:
        return linear(o);
      case OperationCode::product:
        return {operand(o.u, Binding::product) + "*" + operand(o.v, Binding::power),
                Binding::product};
      case OperationCode::square:
        return {operand(o.u, Binding::whole) + "^2", Binding::power};
      case OperationCode::quotient:
        return {operand(o.u, Binding::product) + "/" + operand(o.v, Binding::power),
                Binding::product};
      case OperationCode::power:
        if (o.constant == Extended(-1)) {
          return {"1/" + operand(o.u, Binding::power), Binding::product};
        }
        if (o.constant == Extended(0.5)) return {call("sqrt", o.u)};
        return {fmt::format("{}^({})", operand(o.u, Binding::whole), number_text(o.constant)),
                Binding::power};
      case OperationCode::exponential:
        return {call("exp", o.u)};
      case OperationCode::logarithm:
        return {call("log", o.u)};
      case OperationCode::sine:
        return {call("sin", o.u)};
      case OperationCode::cosine:
        return {call("cos", o.u)};
      case OperationCode::hyperbolic_sine:
        return {call("sinh", o.u)};
      case OperationCode::hyperbolic_cosine:
        return {call("cosh", o.u)};
      case OperationCode::angle:
        return {fmt::format("unit_angle({}, {})", values_[o.u].text, values_[o.v].text)};
      case OperationCode::time_function:
      case OperationCode::field:
      case OperationCode::deviation_product:
        break;  // print_list refuses them
    }
    return {};
  }

  Printed linear(const Operation& o) const {
    std::string text;
    if (o.constant != 0 || o.terms.empty()) text = number_text(o.constant);
    std::string group;
    for (std::size_t k = 0; k < o.terms.size(); ++k) {
      const LinearTerm& term = o.terms[k];
      const bool is_first = group.empty() && text.empty();
      const bool is_negative = term.coefficient < 0;
      const Extended size = abs(term.coefficient);
      const bool is_one = size == 1;
      const std::string factor = is_one ? "" : number_text(size) + "*";
      const std::string value = operand(term.value, is_one ? Binding::product : Binding::power);
      const bool begins = is_first || (group.empty() && o.terms.size() > terms_together);
      const std::string_view sign = begins ? (is_negative ? "-" : "") : is_negative ? " - " : " + ";
      group += fmt::format("{}{}{}", sign, factor, value);
      const bool is_full = (k + 1) % terms_together == 0 || k + 1 == o.terms.size();
      if (!is_full) continue;
      if (o.terms.size() > terms_together) {
        text += fmt::format("{}({})", text.empty() ? "" : " + ", group);
      } else {
        text += group;
      }
      group.clear();
    }
    const bool is_one_term = o.terms.size() == 1 && o.constant == 0;
    const bool is_negative = is_one_term ? o.terms[0].coefficient < 0 : o.constant < 0;
    if (is_negative || !(is_one_term || o.terms.empty())) return {std::move(text), Binding::sum};
    return {std::move(text), o.terms.empty() ? Binding::whole : Binding::product};
  }

  const OperationList& list_;
  std::vector<std::string> variables_;
  bool names_everything_;
  std::string prefix_ = "w";
  std::vector<int> uses_;
  std::vector<Printed> values_;
};

}  // namespace

bool is_same_list(const OperationList& a, const OperationList& b) {
  return a.inputs() == b.inputs() && a.has_time() == b.has_time() &&
         std::equal(a.operations().begin(), a.operations().end(), b.operations().begin(),
                    b.operations().end(), is_same) &&
         std::equal(a.outputs().begin(), a.outputs().end(), b.outputs().begin(), b.outputs().end());
}

FunctionText print_list(const OperationList& given, const std::vector<std::string>& variables,
                        const std::vector<std::string>& outputs) {
  for (const Operation& o : given.operations()) {
    if (o.code < OperationCode::time_function) continue;
    throw Error(ErrorKind::usage,
                "text of a list: it has fields or functions of the time, which have no text");
  }
  // A text says nothing of a time that it does not use.
  const OperationList list = given.depends_on_time() ? given : at_time(given, 0);
  if (list.variables() != variables.size() || list.outputs().size() != outputs.size()) {
    throw Error(
        ErrorKind::usage,
        fmt::format("text of a list: names of {} variables and {} outputs, must be {} and "
                    "{}",
                    variables.size(), outputs.size(), list.variables(), list.outputs().size()));
  }
  FunctionText brief = ListPrinter(list, variables, false).print(outputs);
  if (is_same_list(record_function(brief), list)) return brief;
  return ListPrinter(list, variables, true).print(outputs);
}

}  // namespace hamjet
