#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"

namespace hamjet {

using ExpressionVector = std::array<Expression, 3>;

/// The product of a matrix, row after row, and a vector.
inline ExpressionVector turned(const std::vector<Expression>& matrix,
                               std::span<const Expression> v) {
  ExpressionVector result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = matrix[3 * i] * v[0] + matrix[3 * i + 1] * v[1] + matrix[3 * i + 2] * v[2];
  }
  return result;
}

inline Expression dot(std::span<const Expression> a, std::span<const Expression> b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace hamjet
