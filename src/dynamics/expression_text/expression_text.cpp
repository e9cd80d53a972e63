#include "hamjet/dynamics/expression_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <utility>

#include "../../text/printable_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/scene_message.hpp"
#include "expression_functions.hpp"
#include "expression_part.hpp"
#include "literal_sum.hpp"

namespace hamjet {
namespace {

using io::in_quotes;

constexpr std::string_view pi_name = "pi";

using Part = ExpressionPart;

/// All texts of a function, parsed, in an order in which each needs only earlier ones.
class ParsedFunction {
 public:
  explicit ParsedFunction(const FunctionText& function) : is_literal_(function.is_literal) {
    const std::size_t count = function.variables.size() + function.varied.size() +
                              function.parameters.size() + function.definitions.size() +
                              function.outputs.size();
    parts_.reserve(count);  // names point to parts
    for (const std::string& name : function.variables) {
      parts_.push_back({.kind = Part::Kind::variable, .path = io::printable(name)});
      name_part(name, "variables");
    }
    for (const std::string& name : function.varied) {
      parts_.push_back({.kind = Part::Kind::varied, .path = part_path(Part::Kind::varied, name)});
      name_part(name, parts_.back().path);
    }
    for (const NamedText& text : function.parameters) add(Part::Kind::parameter, text);
    for (const NamedText& text : function.definitions) add(Part::Kind::definition, text);
    for (const NamedText& text : function.outputs) add(Part::Kind::output, text);
    for (Part& part : parts_) set_order(part);
  }

  bool uses_time() const { return uses_time_; }

  /// The values of the outputs for these inputs, the time last if it is used.
  std::vector<Expression> outputs(std::span<const Expression> inputs) {
    std::size_t next = 0;
    for (Part& part : parts_) {
      if (part.is_input()) part.value = inputs[next++];
    }
    if (uses_time_) time_ = inputs[next];
    for (Part* part : order_) {
      part->value = value_of(*part);
      // A constant that has a name in such a text is an operation at this place, so that the text of
      // a list is read as the same list.
      const bool is_operation = is_literal_ && part->kind == Part::Kind::definition;
      if (is_operation && part->value->is_constant() && !inputs.empty()) {
        inputs.front().recorder()->constant_value(part->value->constant());
      }
    }
    std::vector<Expression> result;
    for (const Part& part : parts_) {
      if (part.kind == Part::Kind::output) result.push_back(*part.value);
    }
    return result;
  }

  std::vector<std::string> unused() const {
    std::vector<const Part*> needed;
    for (auto part = order_.rbegin(); part != order_.rend(); ++part) {
      const bool is_needed = (*part)->kind == Part::Kind::output ||
                             std::find(needed.begin(), needed.end(), *part) != needed.end();
      if (!is_needed) continue;
      needed.push_back(*part);
      for (const ExpressionToken& token : (*part)->tokens) {
        if (const Part* of = named(**part, token)) needed.push_back(of);
      }
    }
    std::vector<std::string> result;
    for (const Part& part : parts_) {
      if (part.kind == Part::Kind::variable) continue;
      if (std::find(needed.begin(), needed.end(), &part) == needed.end()) {
        result.push_back(part.path);
      }
    }
    return result;
  }

 private:
  void add(Part::Kind kind, const NamedText& text) {
    Part& part = parts_.emplace_back();
    part = {.kind = kind, .path = part_path(kind, text.name), .text = text.text};
    if (kind != Part::Kind::output) name_part(text.name, part.path);
    try {
      part.tokens = parse_expression(part.text);
    } catch (const SyntaxProblem& p) {
      const std::string got =
          p.length == 0 ? "the end of the text" : in_quotes(part.text.substr(p.place, p.length));
      throw ExpressionTextError(part.path, fmt::format("{}, got {} at {}, must be {}", p.what, got,
                                                       part.words_of_place(p.place), p.right));
    }
    for (const ExpressionToken& token : part.tokens) {
      uses_time_ =
          uses_time_ || (token.kind == TokenKind::name && part.text_of(token) == time_variable);
    }
  }

  /// Gives the last part its name.
  void name_part(const std::string& name, const std::string& path) {
    if (!is_expression_name(name)) {
      throw ExpressionTextError(
          path, fmt::format("no name, got {}, must be a letter, and then letters, digits and _",
                            in_quotes(name)));
    }
    if (name == time_variable) {
      throw ExpressionTextError(path,
                                "a name that is taken, got t, must be another one: t is the "
                                "time in every expression");
    }
    if (is_reserved_name(name)) {
      throw ExpressionTextError(
          path,
          fmt::format("a name that is taken, got {}, must be another one: {} {} has this name",
                      io::printable(name), name == pi_name ? "the number" : "the function", name));
    }
    const auto [place, is_new] = names_.try_emplace(name, &parts_.back());
    if (is_new) return;
    throw ExpressionTextError(
        path, fmt::format("a name given twice, got {}, must be another one: {} has this name",
                          io::printable(name),
                          place->second->kind == Part::Kind::variable ? "a variable"
                                                                      : place->second->path));
  }

  /// The part that a token names; null if it names none.
  Part* named(const Part& part, const ExpressionToken& token) const {
    if (token.kind != TokenKind::name) return nullptr;
    const auto found = names_.find(part.text_of(token));
    return found == names_.end() ? nullptr : found->second;
  }

  /// Puts a part into the order, behind those that it names.
  void set_order(Part& root) {
    enum : char { unseen, open, done };
    struct Visit {
      Part* part;
      std::size_t next = 0;
    };
    if (states_.empty()) states_.assign(parts_.size(), unseen);
    const auto state = [&](const Part& part) -> char& {
      return states_[static_cast<std::size_t>(&part - parts_.data())];
    };
    if (root.is_input() || state(root) == done) return;
    std::vector<Visit> visits{{&root}};
    state(root) = open;
    while (!visits.empty()) {
      Visit& visit = visits.back();
      Part& part = *visit.part;
      if (visit.next == part.tokens.size()) {
        state(part) = done;
        order_.push_back(&part);
        visits.pop_back();
        continue;
      }
      const ExpressionToken& token = part.tokens[visit.next++];
      Part* const of = named(part, token);
      if (of == nullptr || of->is_input() || state(*of) == done) continue;
      if (state(*of) == open) {
        part.fail(token, "defined by itself", fmt::format("must not lead back to {}", of->path));
      }
      state(*of) = open;
      visits.push_back({of});
    }
  }

  Expression value_of(const Part& part) const {
    const std::vector<bool> goes_on = terms_of_sums(part.tokens);
    std::vector<LiteralSum> stack;
    for (std::size_t k = 0; k < part.tokens.size(); ++k) {
      const ExpressionToken& token = part.tokens[k];
      const std::size_t count = operands_of(token);
      const std::span<const LiteralSum> operands(stack.data() + stack.size() - count, count);
      const LiteralSum value = value_of(part, token, operands);
      stack.erase(stack.end() - static_cast<std::ptrdiff_t>(count), stack.end());
      stack.push_back(goes_on[k] ? value : value.recorded());
    }
    return stack.back().recorded();
  }

  LiteralSum value_of(const Part& part, const ExpressionToken& token,
                      std::span<const LiteralSum> operands) const {
    const auto sum = is_literal_ ? literal_sum(token.kind, operands) : std::nullopt;
    if (sum) return *sum;
    std::vector<Expression> given;
    for (const LiteralSum& operand : operands) given.push_back(operand.recorded());
    const Expression value = apply(part, token, given);
    if (value.is_constant() && !isfinite(value.constant())) fail_not_finite(part, token, given);
    return value;
  }

  Expression apply(const Part& part, const ExpressionToken& token,
                   std::span<const Expression> x) const {
    switch (token.kind) {
      case TokenKind::number:
        return number(part, token);
      case TokenKind::name:
        return name(part, token);
      case TokenKind::call:
        return call(part, token, x);
      case TokenKind::negate:
        return -x[0];
      case TokenKind::add:
        return x[0] + x[1];
      case TokenKind::subtract:
        return x[0] - x[1];
      case TokenKind::multiply:
        return is_literal_ ? x[0] * x[1] : merged_product(x[0], x[1]);
      case TokenKind::divide:
        if (x[1].is_constant() && x[1].constant() == 0) {
          part.fail(token, "division by zero", "must be a divisor other than 0");
        }
        return is_literal_ ? x[0] / x[1] : merged_quotient(x[0], x[1]);
      case TokenKind::power:
        return power(part, token, x[0], x[1]);
    }
    return 0;
  }

  Expression power(const Part& part, const ExpressionToken& token, const Expression& a,
                   const Expression& b) const {
    if (a.is_constant() && a.constant() <= 0 && !b.is_constant()) {
      part.fail(token, "a complex power",
                "must be of a base above 0 where the exponent is not constant");
    }
    if (a.is_constant() && a.constant() == 0 && b.is_constant() && b.constant() < 0) {
      part.fail(token, "division by zero: a negative power of 0", "must be of another base");
    }
    return is_literal_ && b.is_constant() ? pow(a, b) : merged_power(a, b);
  }

  static Expression number(const Part& part, const ExpressionToken& token) {
    const std::string digits(part.text_of(token));
    constexpr std::size_t longest = 400;
    if (digits.size() > longest) {
      part.fail(token, "too long a number", fmt::format("must have at most {} digits", longest));
    }
    if (digits.substr(0, digits.find_first_of("eE")).find_first_of("123456789") == digits.npos) {
      return 0;
    }
    // The exponent is judged before powers of ten are formed in full.
    double rounded = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), rounded);
    if (read.ec != std::errc()) {
      part.fail(token, "out of range", "must be a number that binary64 can hold");
    }
    return Extended(digits);
  }

  Expression name(const Part& part, const ExpressionToken& token) const {
    const std::string_view text = part.text_of(token);
    if (const Part* of = named(part, token)) {
      if (part.kind == Part::Kind::parameter && of->kind != Part::Kind::parameter &&
          of->kind != Part::Kind::varied) {
        part.fail(token, "not constant", "must be made of numbers and parameters alone");
      }
      return *of->value;
    }
    if (text == time_variable && part.kind != Part::Kind::parameter) return *time_;
    if (text == time_variable) {
      part.fail(token, "not constant", "must be made of numbers and parameters alone");
    }
    if (text == pi_name) return acos(Expression(-1));
    if (is_function(text)) {
      part.fail(token, "a function without arguments", "must have them in parentheses behind it");
    }
    std::vector<std::string_view> candidates = all_names();
    candidates.push_back(pi_name);
    constexpr std::size_t most_named = 12;
    const bool is_short = candidates.size() <= most_named || io::nearest(text, candidates);
    part.fail(token, "unknown name",
              is_short
                  ? io::suggestion(text, candidates)
                  : fmt::format("must be one of the {} names of the system", candidates.size()));
  }

  std::vector<std::string_view> all_names() const {
    std::vector<std::string_view> result;
    for (const auto& [name, part] : names_) result.push_back(name);
    return result;
  }

  Expression call(const Part& part, const ExpressionToken& token,
                  std::span<const Expression> x) const {
    const std::string_view text = part.text_of(token);
    const ExpressionFunction* const function = find_function(text);
    if (function == nullptr) fail_call(part, token);
    if (function->arguments() != x.size()) {
      part.fail(token, fmt::format("a function of {}", counted(x.size(), "argument")),
                fmt::format("must have {}{}", function->arguments(),
                            text == "atan2" ? ", as atan2(y, x)" : ""));
    }
    if (is_literal_ && text == "sqrt") return sqrt(x[0]);
    try {
      return x.size() == 1 ? function->of_one(x[0]) : function->of_two(x[0], x[1]);
    } catch (const Error&) {
      // tan(pi/2) is a quotient inside, which has no place in the text.
      const bool is_constant =
          std::all_of(x.begin(), x.end(), [](const Expression& e) { return e.is_constant(); });
      if (!is_constant) throw;
      fail_not_finite(part, token, x);
    }
  }

  [[noreturn]] void fail_call(const Part& part, const ExpressionToken& token) const {
    const std::string_view text = part.text_of(token);
    if (const RefusedFunction* refused = find_refused_function(text)) {
      part.fail(token, refused->reason, fmt::format("must be {}", refused->right));
    }
    const bool is_name =
        names_.contains(std::string(text)) || text == pi_name || text == time_variable;
    if (is_name) {
      part.fail(token, "no function",
                fmt::format("must be {0}*( ) of a product: {0} is no function", text));
    }
    std::vector<std::string_view> candidates;
    for (const ExpressionFunction& f : expression_functions()) candidates.push_back(f.name);
    part.fail(token, "unknown function", io::suggestion(text, candidates));
  }

  [[noreturn]] static void fail_not_finite(const Part& part, const ExpressionToken& token,
                                           std::span<const Expression> given) {
    std::vector<double> values;
    for (const Expression& e : given) values.push_back(static_cast<double>(e.constant()));
    part.fail(
        token, "no finite real value",
        fmt::format("must be real and finite; it is given {:.6g}", fmt::join(values, " and ")));
  }

  std::vector<Part> parts_;
  std::map<std::string, Part*, std::less<>> names_;
  std::vector<Part*> order_;
  std::vector<char> states_;  ///< by part, while the order is made
  bool uses_time_ = false;
  bool is_literal_;
  std::optional<Expression> time_;
};

}  // namespace

bool is_reserved_name(std::string_view name) {
  return name == time_variable || name == pi_name || is_function(name);
}

bool is_expression_name(std::string_view name) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return is_letter(c) || is_digit(c); });
}

OperationList record_function(const FunctionText& function) {
  ParsedFunction parsed(function);
  const bool has_time = parsed.uses_time();
  const OperationList list = record(
      function.variables.size() + function.varied.size() + (has_time ? 1 : 0),
      [&](std::span<const Expression> inputs) { return parsed.outputs(inputs); }, has_time);
  return list.depends_on_time() ? list : at_time(list, 0);
}

std::vector<Extended> evaluate_function(const FunctionText& function,
                                        std::span<const Extended> point, const Extended& time) {
  ParsedFunction parsed(function);
  const std::size_t variables = function.variables.size() + function.varied.size();
  if (point.size() != variables) {
    throw Error(ErrorKind::usage,
                fmt::format("function of a text: {} numbers, must be {}", point.size(), variables));
  }
  std::vector<Expression> values(point.begin(), point.end());
  if (parsed.uses_time()) values.emplace_back(time);
  std::vector<Extended> result;
  for (const Expression& e : parsed.outputs(values)) result.push_back(e.constant());
  return result;
}

std::vector<std::string> unused_names(const FunctionText& function) {
  return ParsedFunction(function).unused();
}

}  // namespace hamjet
