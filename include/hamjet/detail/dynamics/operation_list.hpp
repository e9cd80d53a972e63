#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// What an operation does; u and v are its operands.
enum class OperationCode : std::uint8_t {
  input,        ///< the i-th input
  linear,       ///< constant + sum of coefficient_k u_k (no terms: a constant)
  product,      ///< u v
  square,       ///< u^2
  quotient,     ///< u / v
  power,        ///< u^constant
  exponential,  ///< exp u
  logarithm,    ///< log u
  sine,         ///< sin u; v is the cosine of the same u
  cosine,       ///< cos u; v is the sine of the same u, and stands just before
  hyperbolic_sine,    ///< sinh u; v is the hyperbolic cosine of the same u
  hyperbolic_cosine,  ///< cosh u; v is the hyperbolic sine of the same u, and stands just before
  angle,              ///< atan2(u, v) of a sine u and a cosine v, where u^2 + v^2 = 1
};

/// Whether an operation computes its value from two operands, u and v.
constexpr bool has_two_operands(OperationCode code) {
  return code == OperationCode::product || code == OperationCode::quotient ||
         code == OperationCode::angle;
}

/// Whether an operation is one of a sine and a cosine, whose series need each other.
constexpr bool is_of_pair(OperationCode code) {
  return code >= OperationCode::sine && code <= OperationCode::hyperbolic_cosine;
}

/// One term of a linear operation.
struct LinearTerm {
  std::size_t value;
  Extended coefficient;
};

/// One operation. Its operands are numbers of earlier operations, except that a sine names its
/// cosine, which follows.
struct Operation {
  OperationCode code = OperationCode::linear;
  std::size_t u = 0;
  std::size_t v = 0;
  Extended constant = 0;
  std::vector<LinearTerm> terms;
};

/// A function R^inputs -> R^outputs as a straight list of operations on numbered values. Every
/// integrator runs an operation list, on plain numbers, packs, series or extended precision. Lists
/// are made by recording (see expression.hpp) and are immutable; constants carry extended
/// precision.
class OperationList {
 public:
  OperationList() = default;
  OperationList(std::size_t inputs, std::vector<Operation> operations,
                std::vector<std::size_t> outputs);

  std::size_t inputs() const noexcept { return inputs_; }
  std::span<const Operation> operations() const noexcept { return operations_; }
  std::span<const std::size_t> outputs() const noexcept { return outputs_; }

  /// Which inputs a value depends on, with one bit for each input.
  std::uint64_t dependencies(std::size_t value) const { return dependencies_[value]; }
  /// Whether a value is an affine function of the inputs.
  bool is_affine(std::size_t value) const { return affine_[value]; }
  /// Whether all outputs are affine functions of the inputs. A flow then has no terms above degree
  /// 1.
  bool is_linear_system() const;
  /// Number of nonlinear operations, each of which costs about one product of series.
  std::size_t nonlinear_operations() const;

 private:
  std::size_t inputs_ = 0;
  std::vector<Operation> operations_;
  std::vector<std::size_t> outputs_;
  std::vector<std::uint64_t> dependencies_;
  std::vector<bool> affine_;
};

}  // namespace hamjet
