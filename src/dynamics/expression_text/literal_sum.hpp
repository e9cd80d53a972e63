#pragma once

#include <optional>
#include <span>
#include <vector>

#include "expression_grammar.hpp"
#include "hamjet/detail/dynamics/expression.hpp"

namespace hamjet {

/// A sum that is recorded when it is whole. The beginning of a printed sum is no operation of its
/// list; recorded as it is read, it may be another operation of the list in a place too early.
class LiteralSum {
 public:
  LiteralSum(const Expression& value) {  // NOLINT: a value is a sum of one term
    if (value.is_constant()) {
      constant_ = value.constant();
    } else {
      recorder_ = value.recorder();
      terms_.push_back({value.value(), 1});
    }
  }

  bool is_constant() const noexcept { return terms_.empty(); }
  const Extended& constant() const noexcept { return constant_; }

  LiteralSum& operator*=(const Extended& factor) {
    constant_ *= factor;
    for (LinearTerm& term : terms_) term.coefficient *= factor;
    return *this;
  }
  LiteralSum& operator+=(const LiteralSum& other) {
    constant_ += other.constant_;
    terms_.insert(terms_.end(), other.terms_.begin(), other.terms_.end());
    if (other.recorder_ != nullptr) recorder_ = other.recorder_;
    return *this;
  }

  Expression recorded() const {
    return is_constant() ? Expression(constant_) : recorder_->linear(constant_, terms_);
  }

 private:
  Extended constant_ = 0;
  std::vector<LinearTerm> terms_;
  Recorder* recorder_ = nullptr;
};

/// The number of values that a token takes.
inline std::size_t operands_of(const ExpressionToken& token) {
  switch (token.kind) {
    case TokenKind::number:
    case TokenKind::name:
      return 0;
    case TokenKind::negate:
      return 1;
    case TokenKind::call:
      return token.arguments;
    default:
      return 2;
  }
}

/// For each token, in the order in which they are computed, whether its value goes on as a term of
/// a sum.
inline std::vector<bool> terms_of_sums(std::span<const ExpressionToken> tokens) {
  std::vector<bool> result(tokens.size(), false);
  std::vector<std::size_t> open;  // values that no token has taken yet
  for (std::size_t k = 0; k < tokens.size(); ++k) {
    const TokenKind kind = tokens[k].kind;
    const bool is_sum =
        kind == TokenKind::add || kind == TokenKind::subtract || kind == TokenKind::negate;
    for (std::size_t taken = operands_of(tokens[k]); taken > 0; --taken) {
      result[open.back()] = is_sum;
      open.pop_back();
    }
    open.push_back(k);
  }
  return result;
}

/// The sum that a token of a printed sum makes of its operands; no value for other operations.
inline std::optional<LiteralSum> literal_sum(TokenKind kind, std::span<const LiteralSum> x) {
  if (x.empty() || (x[0].is_constant() && x.back().is_constant())) return std::nullopt;
  LiteralSum sum = x[0];
  switch (kind) {
    case TokenKind::negate:
      return sum *= -1;
    case TokenKind::add:
      return sum += x[1];
    case TokenKind::subtract: {
      LiteralSum other = x[1];
      return sum += (other *= -1);
    }
    case TokenKind::multiply:
      if (x[1].is_constant()) return sum *= x[1].constant();
      if (!x[0].is_constant()) return std::nullopt;
      sum = x[1];
      return sum *= x[0].constant();
    default:
      return std::nullopt;
  }
}

}  // namespace hamjet
