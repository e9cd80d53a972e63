#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "expression_grammar.hpp"
#include "hamjet/detail/dynamics/expression.hpp"

namespace hamjet {

/// A text of a function and what it stands for.
struct ExpressionPart {
  enum class Kind { variable, varied, parameter, definition, output };
  Kind kind = Kind::variable;
  std::string path;            ///< for messages
  std::string_view text = {};  ///< empty for an input
  std::vector<ExpressionToken> tokens = {};
  std::optional<Expression> value = {};

  bool is_input() const { return kind == Kind::variable || kind == Kind::varied; }
  std::string_view text_of(const ExpressionToken& token) const {
    return text.substr(token.begin, token.length);
  }
  /// Where a place of the text is, in words: line (of texts of several), column, and what stands
  /// before.
  std::string words_of_place(std::size_t place) const;
  /// Throws ExpressionTextError about a token: what is wrong with it, and what would be right.
  [[noreturn]] void fail(const ExpressionToken& token, std::string_view what,
                         std::string_view right) const;
};

/// The path of a part of this kind and name.
std::string part_path(ExpressionPart::Kind kind, const std::string& name);

}  // namespace hamjet
