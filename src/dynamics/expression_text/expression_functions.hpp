#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"

namespace hamjet {

/// A function that expressions may call: of one argument or of two.
struct ExpressionFunction {
  std::string_view name;
  Expression (*of_one)(const Expression&) = nullptr;
  Expression (*of_two)(const Expression&, const Expression&) = nullptr;

  std::size_t arguments() const { return of_one != nullptr ? 1 : 2; }
};

/// The functions of the grammar, in the order in which messages list them.
const std::vector<ExpressionFunction>& expression_functions();

/// The function of this name; null if there is none.
const ExpressionFunction* find_function(std::string_view name);

inline bool is_function(std::string_view name) { return find_function(name) != nullptr; }

/// Why a function that other programs have is none here, and what to write in its place; empty for
/// any other name.
struct RefusedFunction {
  std::string_view name;
  std::string_view reason;
  std::string_view right;
};
const RefusedFunction* find_refused_function(std::string_view name);

// Products, quotients and powers in which powers of one value with exponents n/2 are merged, as
// 1/r^3 with r = sqrt(u) is u^(-3/2), and (z/r)^2 is z^2/u; a sum of such is multiplied term by
// term. A field derived from them needs few series.

/// a^b: of a constant exponent as recorded powers, otherwise exp(b log a).
Expression merged_power(const Expression& a, const Expression& b);
Expression merged_product(const Expression& a, const Expression& b);
/// a/b; b must not be the constant 0.
Expression merged_quotient(const Expression& a, const Expression& b);

}  // namespace hamjet
