#include "expression_grammar.hpp"

#include <algorithm>
#include <boost/spirit/home/x3.hpp>
#include <string>
#include <utility>

#include "expression_functions.hpp"

// The grammar of expression_text.hpp. Its actions write tokens in reverse Polish notation;
// operators wait on a stack for their last operand. No rule is tried twice on the same text, so
// that an action is never undone.

namespace hamjet {
namespace {

constexpr std::string_view spaces = " \t\r\n";

namespace grammar {

namespace x3 = boost::spirit::x3;

struct Parsing {
  const char* text = nullptr;
  std::vector<ExpressionToken> tokens = {};
  std::vector<ExpressionToken> operators = {};  ///< operators whose right side is still being read
  std::vector<std::size_t> first_operators = {};  ///< of the factors that are open
  std::vector<ExpressionToken> calls = {};
};

struct ParsingTag;

template <class Context>
Parsing& parsing(const Context& context) {
  return x3::get<ParsingTag>(context);
}

/// The token of the text that a parser has matched.
template <class Context>
ExpressionToken matched(const Context& context, TokenKind kind) {
  const auto& range = x3::_attr(context);
  return {kind, static_cast<std::size_t>(range.begin() - parsing(context).text),
          static_cast<std::size_t>(range.end() - range.begin()), 0};
}

auto emit(TokenKind kind) {
  return [kind](auto& context) { parsing(context).tokens.push_back(matched(context, kind)); };
}

auto hold(TokenKind kind) {
  return [kind](auto& context) { parsing(context).operators.push_back(matched(context, kind)); };
}

const auto emit_operator = [](auto& context) {
  Parsing& p = parsing(context);
  p.tokens.push_back(p.operators.back());
  p.operators.pop_back();
};

const auto open_factor = [](auto& context) {
  parsing(context).first_operators.push_back(parsing(context).operators.size());
};

/// Powers bind to the right, and closer than the signs before their base.
const auto close_factor = [](auto& context) {
  Parsing& p = parsing(context);
  for (; p.operators.size() > p.first_operators.back(); p.operators.pop_back()) {
    p.tokens.push_back(p.operators.back());
  }
  p.first_operators.pop_back();
};

const auto hold_name = [](auto& context) {
  parsing(context).calls.push_back(matched(context, TokenKind::name));
};

const auto emit_name = [](auto& context) {
  Parsing& p = parsing(context);
  p.tokens.push_back(p.calls.back());
  p.calls.pop_back();
};

const auto open_call = [](auto& context) { parsing(context).calls.back().kind = TokenKind::call; };

const auto count_argument = [](auto& context) { ++parsing(context).calls.back().arguments; };

const x3::rule<struct SumTag> sum = "sum";

const auto digit = x3::char_("0-9");
const auto number = x3::raw[x3::lexeme[((+digit >> -('.' >> *digit)) | ('.' >> +digit)) >>
                                       -(x3::char_("eE") >> -x3::char_("+-") >> +digit)]];
const auto name = x3::raw[x3::lexeme[x3::char_("a-zA-Z_") >> *x3::char_("a-zA-Z0-9_")]];

const auto plus = x3::raw[x3::lit('+')];
const auto minus = x3::raw[x3::lit('-')];
const auto times = x3::raw[x3::lexeme[x3::lit('*') >> !x3::lit('*')]];
const auto over = x3::raw[x3::lit('/')];
const auto power = x3::raw[x3::lit('^') | x3::lit("**")];

const auto arguments = sum >> x3::eps[count_argument] >>
                       *(x3::lit(',') > sum > x3::eps[count_argument]);
const auto operand = number[emit(TokenKind::number)] |
                     (name[hold_name] >> -(x3::lit('(')[open_call] > arguments > x3::lit(')')) >>
                      x3::eps[emit_name]) |
                     (x3::lit('(') > sum > x3::lit(')'));
const auto signs = *(minus[hold(TokenKind::negate)] | x3::lit('+'));
const auto factor = x3::eps[open_factor] >> signs > operand >
                    *(power[hold(TokenKind::power)] > signs > operand) > x3::eps[close_factor];
const auto product = factor >> *((times[hold(TokenKind::multiply)] |
                                  over[hold(TokenKind::divide)]) > factor > x3::eps[emit_operator]);
const auto sum_def = product >> *((plus[hold(TokenKind::add)] | minus[hold(TokenKind::subtract)]) >
                                  product > x3::eps[emit_operator]);

BOOST_SPIRIT_DEFINE(sum)

}  // namespace grammar

/// Parentheses are the only recursion of the grammar.
constexpr std::size_t deepest_nesting = 200;
constexpr std::size_t longest_text = 1 << 20;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The length of what stands at a place, for a message: a word, a number, or a character of UTF-8.
std::size_t length_at(std::string_view text, std::size_t place) {
  std::size_t end = place + 1;
  const bool is_word = is_letter(text[place]) || is_digit(text[place]);
  const auto continues = [&](char c) {
    return is_word ? is_letter(c) || is_digit(c)
                   : (static_cast<unsigned char>(text[place]) >= 0xC0 &&
                      (static_cast<unsigned char>(c) & 0xC0) == 0x80);
  };
  while (end < text.size() && continues(text[end])) ++end;
  return end - place;
}

/// The name that ends before a place, or an empty text.
std::string_view word_before(std::string_view text, std::size_t end) {
  std::size_t begin = end;
  while (begin > 0 && (is_letter(text[begin - 1]) || is_digit(text[begin - 1]))) --begin;
  return text.substr(begin, end - begin);
}

/// What is missing where nothing that can stand there begins.
constexpr std::string_view an_operand = "a number, a name, a function or \"(\"";

/// What is known of other programs' notation.
struct Foreign {
  std::string_view text;
  std::string_view what;
  std::string_view right;
};

constexpr Foreign foreign[] = {
    {"=", "an equation", "an expression alone: what stands before \"=\" is the key"},
    {"[", "a bracket", "(, the only kind of brackets"},
    {"]", "a bracket", "), the only kind of brackets"},
    {"{", "a brace", "(, the only kind of brackets"},
    {"}", "a brace", "), the only kind of brackets"},
    {"<", "a comparison", "a smooth function: branches have no Taylor series"},
    {">", "a comparison", "a smooth function: branches have no Taylor series"},
    {"?", "a branch", "a smooth function: branches have no Taylor series"},
    {"|", "a magnitude", "sqrt(x^2 + y^2) of a vector; a number's has no Taylor series at 0"},
    {"'", "a derivative", "an expression in coordinates and momenta alone"},
    {"!", "a factorial", "the number itself"},
    {"%", "a remainder", "a smooth function: a remainder has no Taylor series where it jumps"},
    {"\\", "a command of TeX", "the plain name, such as sqrt(x)"},
    {"\u2212", "a minus sign of typography", "-"},
    {"\u2013", "a dash", "-"},
    {"\u00B7", "a raised dot", "*"},
    {"\u22C5", "a raised dot", "*"},
    {"\u00D7", "a cross", "*"},
    {"\u00B2", "a raised digit", "^2"},
    {"\u00B3", "a raised digit", "^3"},
    {"\u221A", "a root sign", "sqrt( )"},
    {"\u03C0", "a Greek letter", "pi"},
};

SyntaxProblem problem_at(std::string_view text, std::size_t place) {
  place = std::min(text.find_first_not_of(spaces, place), text.size());
  const std::size_t last = place == 0 ? text.npos : text.find_last_not_of(spaces, place - 1);
  const bool is_after_operand =
      last != text.npos && (is_letter(text[last]) || is_digit(text[last]) || text[last] == ')' ||
                            (text[last] == '.' && last > 0 && is_digit(text[last - 1])));
  if (place == text.size()) {
    if (last == text.npos) return {place, 0, "empty", "an expression"};
    if (is_after_operand) return {place, 0, "\"(\" that is not closed", "\")\""};
    return {place, 0, "cut off", an_operand};
  }
  const std::size_t length = length_at(text, place);
  const char c = text[place];
  for (const Foreign& other : foreign) {
    if (text.substr(place).starts_with(other.text)) return {place, length, other.what, other.right};
  }
  if (c == ')' && is_after_operand) return {place, length, "\")\" without \"(\"", "left out"};
  if (c == ')' && last != text.npos && text[last] == '(') {
    return {place, length, "nothing between parentheses", an_operand};
  }
  if (c == ',' && is_after_operand) {
    return {place, length, "a comma outside the arguments of a function",
            "an operator, or \".\" in a number"};
  }
  if (is_after_operand && c == '.') return {place, length, "a second point", "one in a number"};
  if (is_after_operand && is_function(word_before(text, last + 1)) && c != '(') {
    return {place, length, "a function without parentheses", "( behind its name, such as sin(x)"};
  }
  if (is_after_operand && (is_letter(c) || is_digit(c) || c == '(')) {
    return {place, length, "no operator", "an operator before it, such as * of a product"};
  }
  if (std::string_view("+-*/^,)").find(c) != std::string_view::npos) {
    return {place, length, "an operand is missing", an_operand};
  }
  return {place, length, "no character of expressions",
          is_after_operand ? std::string_view("an operator") : an_operand};
}

/// Throws at the parenthesis that is nested too deep.
void require_shallow(std::string_view text) {
  if (text.size() > longest_text) {
    throw SyntaxProblem{longest_text, 0, "too long", "at most 1048576 characters"};
  }
  std::size_t depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(' && ++depth > deepest_nesting) {
      throw SyntaxProblem{i, 1, "nested too deep",
                          "at most 200 open parentheses; definitions help"};
    }
    if (text[i] == ')' && depth > 0) --depth;
  }
}

}  // namespace

std::vector<ExpressionToken> parse_expression(std::string_view text) {
  require_shallow(text);
  namespace x3 = boost::spirit::x3;
  grammar::Parsing state{.text = text.data()};
  const char* place = text.data();
  const char* const end = text.data() + text.size();
  try {
    const bool is_begun =
        x3::phrase_parse(place, end, x3::with<grammar::ParsingTag>(state)[grammar::sum],
                         x3::char_(std::string(spaces)));
    if (is_begun && place == end) return std::move(state.tokens);
  } catch (const x3::expectation_failure<const char*>& failure) {
    place = failure.where();
  }
  throw problem_at(text, static_cast<std::size_t>(place - text.data()));
}

}  // namespace hamjet
