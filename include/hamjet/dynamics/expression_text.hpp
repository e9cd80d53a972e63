#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"
#include "hamjet/error.hpp"

// Functions written as text, and operation lists as such text.
//
//   sum     = product, { ("+" | "-"), product } ;
//   product = factor, { ("*" | "/"), factor } ;
//   factor  = { "+" | "-" }, operand, { ("^" | "**"), { "+" | "-" }, operand } ;
//   operand = number | name | function, "(", sum, { ",", sum }, ")" | "(", sum, ")" ;
//
// Powers bind closer than signs and to the right: -x^2 is -(x^2), and 2^3^2 is 2^9. Numbers are
// decimal and are taken in extended precision.

namespace hamjet {

/// A name, and the text of what it stands for.
struct NamedText {
  std::string name;
  std::string text;

  bool operator==(const NamedText&) const = default;
};

/// A function of real variables as text.
struct FunctionText {
  std::vector<std::string> variables;  ///< names of the inputs, in their order
  /// Names of further inputs behind them, to which parameters may refer as to one another: those
  /// of parameters that are not constant.
  std::vector<std::string> varied;
  std::vector<NamedText> parameters;   ///< constants, which may refer to one another
  std::vector<NamedText> definitions;  ///< expressions, which may refer to one another
  std::vector<NamedText> outputs;      ///< expressions; their names are for messages alone
  /// Whether operations are recorded one by one as they are written, as `print_list` writes them.
  /// Otherwise powers of one value with exponents n/2 are merged, so that 1/r^3 with r = sqrt(u) is
  /// u^(-3/2): a field derived from them needs fewer series.
  bool is_literal = false;
};

/// A mistake in a text: the part that it is in, and what is wrong there.
class ExpressionTextError : public Error {
 public:
  ExpressionTextError(std::string part, std::string problem)
      : Error(ErrorKind::usage, part + ": " + problem),
        part_(std::move(part)),
        problem_(std::move(problem)) {}

  /// "parameters.<name>", "definitions.<name>", or the name of a variable's list or of an output.
  const std::string& part() const noexcept { return part_; }
  /// What is wrong, where (line and column from 1), and what would be right.
  const std::string& problem() const noexcept { return problem_; }

 private:
  std::string part_;
  std::string problem_;
};

/// The name of the time, which texts may use as they use a variable.
inline constexpr std::string_view time_variable = "t";

/// Names that variables, parameters and definitions cannot have: of functions, of pi and of the
/// time.
bool is_reserved_name(std::string_view name);

/// Whether a text can name a variable: a letter or "_", and then letters, digits and "_".
bool is_expression_name(std::string_view name);

/// The list that computes the outputs. Its inputs are the variables, those of parameters that are
/// not constant and, behind them, the time if an output depends on it, as none does by 0*t. Throws
/// ExpressionTextError for whatever is wrong in the text, also where no output needs it.
OperationList record_function(const FunctionText& function);

/// The values of the outputs in extended precision, for values of the inputs and a time. Throws
/// ExpressionTextError at the first operation of the text that has no finite value there, and
/// Error(usage) for another number of variables.
std::vector<Extended> evaluate_function(const FunctionText& function,
                                        std::span<const Extended> point, const Extended& time = 0);

/// Names of parameters and definitions that no output needs, as "parameters.<name>" and
/// "definitions.<name>".
std::vector<std::string> unused_names(const FunctionText& function);

/// A list as text, whose `record_function` gives the same list, operation by operation; a time on
/// which no output depends is left out. `variables` and `outputs` are names for its inputs without
/// the time, and for its outputs. Throws Error(usage) for other numbers of names, and for lists
/// with fields or functions of the time.
FunctionText print_list(const OperationList& list, const std::vector<std::string>& variables,
                        const std::vector<std::string>& outputs);

/// Whether two lists are the same, operation by operation.
bool is_same_list(const OperationList& a, const OperationList& b);

}  // namespace hamjet
