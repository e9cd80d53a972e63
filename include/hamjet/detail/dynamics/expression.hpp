#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

class Recorder;

/// A number type that records what is done to it: a system written as a template over its number
/// type is run once on Expressions, and the list of operations results. A constant is an Expression
/// without a recorder; constants are folded in extended precision, equal operations are recorded
/// once, and multiplications by 0 and 1 vanish. A term that is absent from a system therefore costs
/// nothing.
class Expression {
 public:
  Expression() = default;
  template <std::floating_point F>
  Expression(F value) : constant_(value) {}  // NOLINT: numbers embed in expressions
  template <std::integral I>
  Expression(I value) : constant_(value) {}                // NOLINT
  Expression(const Extended& value) : constant_(value) {}  // NOLINT

  bool is_constant() const noexcept { return recorder_ == nullptr; }
  const Extended& constant() const noexcept { return constant_; }
  std::size_t value() const noexcept { return value_; }
  Recorder* recorder() const noexcept { return recorder_; }

  Expression& operator+=(const Expression& o) { return *this = *this + o; }
  Expression& operator-=(const Expression& o) { return *this = *this - o; }
  Expression& operator*=(const Expression& o) { return *this = *this * o; }
  Expression& operator/=(const Expression& o) { return *this = *this / o; }

  friend Expression operator+(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a, const Expression& b);
  friend Expression operator*(const Expression& a, const Expression& b);
  friend Expression operator/(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a);
  friend Expression square(const Expression& a);
  /// a^exponent with a constant exponent; throws Error(usage) if the exponent is not constant.
  friend Expression pow(const Expression& a, const Expression& exponent);
  friend Expression sqrt(const Expression& a);
  friend Expression exp(const Expression& a);
  friend Expression log(const Expression& a);
  friend Expression sin(const Expression& a);
  friend Expression cos(const Expression& a);
  friend Expression sinh(const Expression& a);
  friend Expression cosh(const Expression& a);
  /// The angle of a point of the unit circle, from its sine and cosine: in (-pi, pi] where it
  /// starts, and analytic everywhere. The caller sees to it that sine^2 + cosine^2 = 1.
  friend Expression angle(const Expression& sine, const Expression& cosine);

  /// D^orders U at a position, where `orders` are those of differentiation by x, y and z.
  friend Expression field_value(const std::shared_ptr<const LocalField>& field,
                                const std::array<Expression, 3>& position,
                                const std::array<int, 3>& orders);
  /// The components of a function of the time; Error(usage) unless t is the time itself or a
  /// number.
  friend std::vector<Expression> time_values(const std::shared_ptr<const TimeFunction>& function,
                                             const Expression& t);

 private:
  friend class Recorder;
  Expression(Recorder* recorder, std::size_t value) : recorder_(recorder), value_(value) {}

  Recorder* recorder_ = nullptr;
  std::size_t value_ = 0;
  Extended constant_ = 0;
};

// Functions made of those that are recorded; each is exact, and as accurate as its derivatives are
// bounded.
Expression tan(const Expression& a);
Expression tanh(const Expression& a);
/// The inverse functions are angles: of the sine a and the cosine sqrt((1 - a)(1 + a)), or the other
/// way round; of a / sqrt(1 + a^2) and 1 / sqrt(1 + a^2).
Expression asin(const Expression& a);
Expression acos(const Expression& a);
Expression atan(const Expression& a);
/// The angle of the point (x, y) other than the origin.
Expression atan2(const Expression& y, const Expression& x);
Expression field_value(const std::shared_ptr<const LocalField>& field,
                       const std::array<Expression, 3>& position,
                       const std::array<int, 3>& orders = {});
std::vector<Expression> time_values(const std::shared_ptr<const TimeFunction>& function,
                                    const Expression& t);

/// Collects the operations done to Expressions. It cannot be copied, because Expressions point to
/// it.
class Recorder {
 public:
  /// With `has_time`, the last input is the time.
  explicit Recorder(std::size_t inputs, bool has_time = false);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  Expression input(std::size_t i) { return {this, i}; }
  /// A value recorded so far, and its operation.
  Expression value(std::size_t i) { return {this, i}; }
  const Operation& operation_of(std::size_t value) const { return operations_[value]; }
  std::vector<Expression> inputs();

  /// Records constant + sum of the terms; sums of sums are flattened.
  Expression linear(const Extended& constant, const std::vector<LinearTerm>& terms);
  Expression operation(OperationCode code, std::size_t u, std::size_t v = 0,
                       const Extended& constant = 0);
  /// Records a constant as a value, for operations that take no constants.
  std::size_t constant_value(const Extended& constant);
  Expression time_function(const std::shared_ptr<const TimeFunction>& function,
                           std::size_t component, std::size_t time);
  /// Whether a value is the input of the time.
  bool is_time(std::size_t value) const { return has_time_ && value + 1 == inputs_; }
  /// Whether a value depends on no variable, see OperationList.
  bool is_number(std::size_t value) const { return is_number_[value]; }
  /// Records sine and cosine as a pair, because their series need each other; `sine` may be that of
  /// hyperbolic ones.
  std::pair<Expression, Expression> sine_cosine(std::size_t u,
                                                OperationCode sine = OperationCode::sine);

  /// The list that computes these outputs, without operations that none of them needs.
  OperationList finish(std::span<const Expression> outputs) const;

 private:
  using Key = std::tuple<OperationCode, std::size_t, std::size_t, Extended,
                         std::vector<std::pair<std::size_t, Extended>>, const void*,
                         std::array<std::size_t, 6>>;
  friend Expression field_value(const std::shared_ptr<const LocalField>&,
                                const std::array<Expression, 3>&, const std::array<int, 3>&);
  std::size_t record(Operation operation);
  void append(Operation operation);

  std::size_t inputs_;
  bool has_time_;
  std::vector<Operation> operations_;
  std::vector<bool> is_number_;  ///< by value
  std::map<Key, std::size_t> known_;
};

/// Records a function: `function(std::span<const Expression>)` returns the outputs. With
/// `has_time`, the last of the inputs is the time.
template <class Function>
OperationList record(std::size_t inputs, const Function& function, bool has_time = false) {
  Recorder recorder(inputs, has_time);
  const std::vector<Expression> variables = recorder.inputs();
  const std::vector<Expression> outputs = function(std::span<const Expression>(variables));
  return recorder.finish(outputs);
}

/// Runs a list on expressions, which records its operations anew (and so simplifies them); returns
/// the values of all operations.
std::vector<Expression> replay(const OperationList& list, std::span<const Expression> inputs);

/// The outputs of a list run on expressions: a recorded function called inside the recording of
/// another one.
std::vector<Expression> recorded_outputs(const OperationList& list,
                                         std::span<const Expression> inputs);

/// The gradient by the variables of a list with one output, by reverse accumulation (Griewank and
/// Walther, Evaluating Derivatives, chapter 3): a list with one output per variable, and with the
/// time where the list has it. Throws Error(usage) for more outputs.
OperationList gradient(const OperationList& list);

/// The Jacobian by the variables of a list, by forward accumulation: output i * variables + j is d
/// output_i / d variable_j.
OperationList jacobian(const OperationList& list);

/// The list at one time, without the input of the time.
OperationList at_time(const OperationList& list, const Extended& time);
/// The list with the time as a further input, on which it does not depend; itself if it has one.
OperationList with_time(const OperationList& list);

/// The list with some variables set to zero and removed, and only some outputs kept; the time
/// stays.
OperationList restrict_list(const OperationList& list, std::span<const std::size_t> kept_inputs,
                            std::span<const std::size_t> kept_outputs);

/// Whether an output is the constant zero.
bool output_vanishes(const OperationList& list, std::size_t output);

}  // namespace hamjet
