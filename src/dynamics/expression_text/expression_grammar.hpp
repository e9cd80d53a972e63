#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace hamjet {

/// What a token of an expression does in reverse Polish notation.
enum class TokenKind { number, name, call, negate, add, subtract, multiply, divide, power };

/// A token, and where its text stands.
struct ExpressionToken {
  TokenKind kind = TokenKind::number;
  std::size_t begin = 0;
  std::size_t length = 0;
  std::size_t arguments = 0;  ///< the number of arguments of a call
};

/// Where a text stops being an expression, what is wrong there, and what would be right.
struct SyntaxProblem {
  std::size_t place = 0;
  std::size_t length = 0;  ///< the length of what is wrong; 0 for the end of the text
  std::string_view what;
  std::string_view right;
};

/// The tokens of an expression in reverse Polish notation. Throws SyntaxProblem.
std::vector<ExpressionToken> parse_expression(std::string_view text);

}  // namespace hamjet
