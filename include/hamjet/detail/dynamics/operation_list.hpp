#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/dynamics/local_field.hpp"
#include "hamjet/detail/dynamics/time_function.hpp"

namespace hamjet {

/// What an operation does; u and v are its operands.
enum class OperationCode : std::uint8_t {
  input,              ///< the i-th input
  linear,             ///< constant + sum of coefficient_k u_k (no terms: a constant)
  product,            ///< u v
  square,             ///< u^2
  quotient,           ///< u / v
  power,              ///< u^constant
  exponential,        ///< exp u
  logarithm,          ///< log u
  sine,               ///< sin u; v is the cosine of the same u
  cosine,             ///< cos u; v is the sine of the same u, and stands just before
  hyperbolic_sine,    ///< sinh u; v is the hyperbolic cosine of the same u
  hyperbolic_cosine,  ///< cosh u; v is the hyperbolic sine of the same u, and stands just before
  angle,              ///< atan2(u, v) of a sine u and a cosine v, where u^2 + v^2 = 1
  time_function,      ///< a component of a TimeFunction at the time u
  field,              ///< a sum of derivatives of LocalFields, see FieldPart
  /// (u - u_0) (v - v_0), with u_0 and v_0 the constant terms; only in lists that expand_fields
  /// made
  deviation_product,
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

/// One term of a field: factor D^(a, b, c) U at a position, with (a, b, c) the orders of
/// differentiation by x, y and z.
struct FieldPart {
  std::shared_ptr<const LocalField> field;
  std::array<std::size_t, 3> position = {};  ///< values x, y, z
  std::array<int, 3> orders = {};
  Extended factor = 1;
};

/// A monomial of an expanded field, as a product: its coefficient, at `monomial` in a LocalField,
/// times the deviation of `factor` times that of the coordinate `coordinate`, counted among the
/// field's terms.
struct FieldProduct {
  std::size_t coordinate = 0;
  std::size_t factor = 0;  ///< value whose deviation is the rest of the monomial
  std::size_t monomial = 0;
  bool operator==(const FieldProduct&) const = default;
};

/// One operation. Its operands are numbers of earlier operations, except that a sine names its
/// cosine, which follows.
struct Operation {
  OperationCode code = OperationCode::linear;
  std::size_t u = 0;
  std::size_t v = 0;
  Extended constant = 0;
  std::vector<LinearTerm> terms = {};
  std::shared_ptr<const TimeFunction> time_function = {};
  std::size_t component = 0;          ///< the component of the time function
  std::vector<FieldPart> parts = {};  ///< the parts of a field; all have the same deviations
  // Of a field that expand_fields made, whose terms are the coordinates that move:
  std::vector<std::size_t> axes = {};       ///< which coordinate each term is: 0, 1 or 2
  std::vector<FieldProduct> products = {};  ///< by coordinate, then by degree
  /// For a product of deviations, the lowest degrees that u - u_0 and v - v_0 have.
  std::array<int, 2> lowest = {1, 1};
};

/// Calls take(value) for all operands of an operation; a partner of a sine or cosine is none.
template <class Take>
void for_each_operand(const Operation& o, const Take& take) {
  switch (o.code) {
    case OperationCode::input:
      return;
    case OperationCode::linear:
      for (const LinearTerm& term : o.terms) take(term.value);
      return;
    case OperationCode::field:
      for (const LinearTerm& term : o.terms) take(term.value);
      for (const FieldProduct& product : o.products) take(product.factor);
      for (const FieldPart& part : o.parts) {
        for (const std::size_t value : part.position) take(value);
      }
      return;
    case OperationCode::product:
    case OperationCode::quotient:
    case OperationCode::angle:
    case OperationCode::deviation_product:
      take(o.u);
      take(o.v);
      return;
    default:
      take(o.u);
  }
}

/// A function R^inputs -> R^outputs as a straight list of operations on numbered values. Every
/// integrator runs an operation list, on plain numbers, packs, series or extended precision. Lists
/// are made by recording (see expression.hpp) and are immutable; constants carry extended
/// precision.
///
/// The last input may be the time. Values that depend on the time alone, and constants, are
/// *numbers*: they have no slices in series, so that a product with one of them is linear.
class OperationList {
 public:
  OperationList() = default;
  /// With `has_time`, the last input is the time. The terms of sums that are numbers are put last,
  /// and so is the number of a product. Throws Error(usage) for more than 64 inputs.
  OperationList(std::size_t inputs, std::vector<Operation> operations,
                std::vector<std::size_t> outputs, bool has_time = false);

  /// The number of inputs, the time included.
  std::size_t inputs() const noexcept { return inputs_; }
  /// Whether the last input is the time.
  bool has_time() const noexcept { return has_time_; }
  /// The number of inputs without the time.
  std::size_t variables() const noexcept { return has_time_ ? inputs_ - 1 : inputs_; }
  std::span<const Operation> operations() const noexcept { return operations_; }
  std::span<const std::size_t> outputs() const noexcept { return outputs_; }

  /// Which variables a value depends on, with one bit for each.
  std::uint64_t dependencies(std::size_t value) const { return dependencies_[value]; }
  /// Whether a value depends on the time.
  bool depends_on_time(std::size_t value) const { return depends_on_time_[value]; }
  /// Whether a value depends on no variable.
  bool is_number(std::size_t value) const { return dependencies_[value] == 0; }
  /// The values before this one are inputs or numbers. Recorded lists have no numbers behind it.
  std::size_t first_series_value() const noexcept { return first_series_value_; }
  /// Whether an operation is nonlinear in its operands that have slices, and so forms sums of
  /// products of them.
  bool has_sums(std::size_t value) const { return has_sums_[value]; }
  /// Whether a value is, at any time, an affine function of the variables.
  bool is_affine(std::size_t value) const { return affine_[value]; }
  /// Whether all outputs are affine functions of the variables. A flow then has no terms above
  /// degree 1.
  bool is_linear_system() const;
  /// Whether an output depends on the time.
  bool depends_on_time() const;
  /// Whether there are fields among the operations.
  bool has_fields() const;
  /// Number of nonlinear operations, each of which costs about one product of series; a field costs
  /// more, see expand_fields.
  std::size_t nonlinear_operations() const;

 private:
  void set_properties(std::size_t value);

  std::size_t inputs_ = 0;
  bool has_time_ = false;
  std::vector<Operation> operations_;
  std::vector<std::size_t> outputs_;
  std::vector<std::uint64_t> dependencies_;
  std::vector<bool> depends_on_time_;
  std::vector<bool> affine_;
  std::vector<bool> has_sums_;
  std::size_t first_series_value_ = 0;
};

/// A list of the operations that the outputs need, with the inputs first and then the numbers;
/// otherwise the order stays.
OperationList needed_operations(std::size_t inputs, std::vector<Operation> operations,
                                std::vector<std::size_t> outputs, bool has_time);

/// What moves a position: in series the variables alone, because the time is a number, and in
/// expansions in the time everything.
enum class FieldMotion { with_variables, with_time };

/// The list for series of an order. Each field is expanded about the constant terms of its
/// position, with d the deviation of the position from them,
///
///   U(r) = c_0 + sum over the coordinates i of d_i (c_(e_i) + sum over beta of c_(beta + e_i)
///   d^beta)
///
/// up to the order (at least 1), where the coefficients c come from the LocalField, and each
/// monomial belongs to the last of its coordinates. The terms of the operation are the coordinates
/// that move, and its products tell the rest. Their factors d^beta, of degrees below the order, are
/// operations of their own. All fields whose positions differ by numbers share them, and sums of
/// such fields become one operation, so that the polynomials of all forces are summed before
/// anything is multiplied. A list without fields is returned as it is.
OperationList expand_fields(const OperationList& list, int order,
                            FieldMotion motion = FieldMotion::with_variables);

/// The place of x^a y^b z^c among the coefficients of a LocalField.
constexpr std::size_t field_monomial(int a, int b, int c) {
  const auto n = static_cast<std::size_t>(a + b + c);
  const auto r = static_cast<std::size_t>(b + c);
  return n * (n + 1) * (n + 2) / 6 + r * (r + 1) / 2 + static_cast<std::size_t>(c);
}

}  // namespace hamjet
