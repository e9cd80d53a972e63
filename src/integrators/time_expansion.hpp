#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/detail/algebra/slice_recurrences.hpp"
#include "hamjet/detail/dynamics/field_values.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// Runs an operation list on series in one variable, power by power. When the inputs' coefficients
/// are known up to the power k, the coefficient of t^k of each operation is formed from the
/// coefficients of its operands up to k. SliceEvaluator does the same in several variables; here
/// every coefficient is known when it is needed, so that no gradients are computed. Source of the
/// recurrences: A. Griewank and A. Walther, Evaluating Derivatives, 2nd ed., SIAM 2008, section
/// 13.2.
///
/// The series of a function of the time come from its object. A field is expanded in the
/// deviations of its position (expand_fields), and its object is asked for coefficients of higher
/// degree as higher powers of the time need them.
///
/// T is a real number or a Pack, Real its number type.
template <class T, class Real>
class TimeExpansion {
 public:
  /// Prepares expansions up to the power `order`; the list must outlive the object.
  TimeExpansion(const OperationList& list, int order)
      : expanded_(list.has_fields() ? std::make_shared<const OperationList>(
                                          expand_fields(list, order, FieldMotion::with_time))
                                    : nullptr),
        list_(expanded_ ? expanded_.get() : &list),
        order_(order),
        stride_(static_cast<std::size_t>(order) + 1),
        fields_(*list_, order, stride_),
        field_coefficients_(fields_.is_empty() ? 0 : list_->operations().size()) {
    const auto operations = list_->operations();
    coefficients_.assign(operations.size() * stride_, T(Real(0)));
    // Without a time nothing that depends on it is a number.
    if (list.has_time()) set_time(T(Real(std::numeric_limits<double>::quiet_NaN())));
    for (std::size_t i = list_->inputs(); i < operations.size(); ++i) {
      const Operation& operation = operations[i];
      steps_.push_back({operation.code, i * stride_, operation.u * stride_, operation.v * stride_,
                        terms_.size(), terms_.size() + operation.terms.size(),
                        convert<Real>(operation.constant)});
      for (const LinearTerm& term : operation.terms) {
        terms_.push_back({term.value * stride_, convert<Real>(term.coefficient)});
      }
    }
  }

  /// The coefficients of the i-th input, which the caller writes.
  T* input(std::size_t i) { return value(i); }
  const T* input(std::size_t i) const { return value(i); }
  /// The coefficients of the i-th output.
  const T* output(std::size_t i) const { return value(list_->outputs()[i]); }

  /// Sets the time about which all is expanded, before power 0; it does nothing for a list that has
  /// no time.
  void set_time(const T& time) {
    if (!list_->has_time()) return;
    *input(list_->variables()) = time;
    for (auto& [function, values] : time_values_) values.clear();
  }
  /// Sets the unit of the time in which powers are counted, before power 1; it is 1 without a call.
  void set_unit(const T& unit) { unit_ = unit; }

  /// Tells that powers up to this one will be formed, so that fields are asked for their
  /// coefficients at once; further powers may follow. It is 4 without a call.
  void expect_power(int power) { expected_power_ = std::max(power, 1); }

  /// Forms the coefficients of t^k of all values; those of lower powers must be known.
  void expand(int k) {
    if (k == 0) {
      unit_ = T(Real(1));
      field_degree_ = 0;
    }
    if (k > 0 && list_->has_time()) input(list_->variables())[k] = k == 1 ? unit_ : T(Real(0));
    if (k > field_degree_ && !fields_.is_empty()) raise_field_degree();
    if (k > 1 && !fields_.is_empty()) {
      const auto power = static_cast<std::size_t>(k);
      fields_.form_cofactors(k - 1, power - 1, power, coefficients_.data());
    }
    for (const Step& step : steps_) form(step, k);
  }

 private:
  /// An operation; values are given by the place where their coefficients begin.
  struct Step {
    OperationCode code;
    std::size_t value;
    std::size_t u;
    std::size_t v;
    std::size_t first_term;
    std::size_t last_term;
    Real constant;
  };
  struct Term {
    std::size_t value;
    Real factor;
  };

  T* value(std::size_t i) { return coefficients_.data() + i * stride_; }
  const T* value(std::size_t i) const { return coefficients_.data() + i * stride_; }

  void form(const Step& o, int k) {
    using std::atan2;
    using std::cos;
    using std::cosh;
    using std::exp;
    using std::log;
    using std::sin;
    using std::sinh;
    T* const w = coefficients_.data() + o.value;
    const T* const u = coefficients_.data() + o.u;
    const T* const v = coefficients_.data() + o.v;
    switch (o.code) {
      case OperationCode::input:
        return;
      case OperationCode::linear: {
        T sum(k == 0 ? o.constant : Real(0));
        const auto power = static_cast<std::size_t>(k);
        for (std::size_t t = o.first_term; t < o.last_term; ++t) {
          sum += T(terms_[t].factor) * coefficients_[terms_[t].value + power];
        }
        w[k] = sum;
        return;
      }
      case OperationCode::product:
        w[k] = sum_of(0, k, [&](int j) { return u[j] * v[k - j]; });
        return;
      case OperationCode::square: {
        const int half = (k + 1) / 2;  // pairs of different powers
        T sum = sum_of(0, half - 1, [&](int j) { return u[j] * u[k - j]; });
        sum += sum;
        w[k] = k % 2 == 0 ? sum + u[k / 2] * u[k / 2] : sum;
        return;
      }
      case OperationCode::quotient:
        w[k] = (u[k] - sum_of(1, k, [&](int j) { return v[j] * w[k - j]; })) / v[0];
        return;
      case OperationCode::power: {  // u w' = c u' w
        if (k == 0) {
          w[0] = power(u[0], o.constant);
          return;
        }
        const Real part = (o.constant + Real(1)) / Real(k);
        w[k] =
            sum_of(1, k, [&](int j) { return T(part * Real(j) - Real(1)) * (u[j] * w[k - j]); }) /
            u[0];
        return;
      }
      case OperationCode::exponential:  // w' = u' w
        w[k] = k == 0 ? T(exp(u[0])) : by_derivative(u, w, k);
        return;
      case OperationCode::logarithm:  // u w' = u'
        w[k] =
            k == 0
                ? T(log(u[0]))
                : (u[k] - sum_of(1, k - 1,
                                 [&](int j) { return T(Real(j) / Real(k)) * (w[j] * u[k - j]); })) /
                      u[0];
        return;
      case OperationCode::cosine:  // c' = -u' s, and s' = u' c; each needs the other up to k - 1
        w[k] = k == 0 ? T(cos(u[0])) : -by_derivative(u, v, k);
        return;
      case OperationCode::sine:
        w[k] = k == 0 ? T(sin(u[0])) : by_derivative(u, v, k);
        return;
      case OperationCode::hyperbolic_cosine:  // c' = u' s, and s' = u' c
        w[k] = k == 0 ? T(cosh(u[0])) : by_derivative(u, v, k);
        return;
      case OperationCode::hyperbolic_sine:
        w[k] = k == 0 ? T(sinh(u[0])) : by_derivative(u, v, k);
        return;
      case OperationCode::angle:  // w' = v u' - u v'
        w[k] = k == 0 ? T(atan2(u[0], v[0])) : by_derivative(u, v, k) - by_derivative(v, u, k);
        return;
      case OperationCode::time_function:
        w[k] = time_value(list_->operations()[o.value / stride_], k);
        return;
      case OperationCode::deviation_product: {
        const auto& lowest = list_->operations()[o.value / stride_].lowest;
        w[k] = sum_of(lowest[0], k - lowest[1], [&](int j) { return u[j] * v[k - j]; });
        return;
      }
      case OperationCode::field:
        w[k] = field_value(o, k);
        return;
    }
  }

  auto constant_terms() const {
    return [this](std::size_t i) -> const T& { return *value(i); };
  }

  T field_value(const Step& o, int k) {
    const std::size_t place = o.value / stride_;
    if (k == 0) return fields_.evaluate(place, constant_terms());
    T sum(Real(0));
    for (std::size_t c = 0; c < o.last_term - o.first_term; ++c) {
      const T* const cofactor = fields_.cofactor(place, c);
      const T* const coordinate = coefficients_.data() + terms_[o.first_term + c].value;
      sum += field_coefficients_[place][c] * coordinate[k];
      sum += sum_of(1, k - 1, [&](int j) { return cofactor[j] * coordinate[k - j]; });
    }
    return sum;
  }

  /// Asks the fields for coefficients of higher degree. Those that are known stay as they are, so
  /// that no digit depends on how far an expansion goes.
  void raise_field_degree() {
    const int known = field_degree_;
    field_degree_ = std::min(order_, known == 0 ? expected_power_ : 2 * known);
    for (const Step& step : steps_) {
      if (step.code != OperationCode::field) continue;
      const std::size_t place = step.value / stride_;
      field_coefficients_[place].resize(step.last_term - step.first_term);
      fields_.evaluate_coefficients(place, known, field_degree_, constant_terms(),
                                    [&](std::size_t t, const T& coefficient) {
                                      field_coefficients_[place][t] = coefficient;
                                    });
    }
  }

  /// The coefficient of t^k of a function of the time, which is asked once for all of them.
  T time_value(const Operation& o, int k) {
    std::vector<T>& values = time_values_[o.time_function.get()];
    if (values.empty()) {
      expand_in_lanes<T, Real>(*o.time_function, *value(o.u), order_, values);
    }
    T result = values[o.component * stride_ + static_cast<std::size_t>(k)];
    for (int j = 0; j < k; ++j) result *= unit_;
    return result;
  }

  /// The coefficient of the integral of u' v.
  T by_derivative(const T* u, const T* v, int k) const {
    return sum_of(1, k, [&](int j) { return T(Real(j) / Real(k)) * (u[j] * v[k - j]); });
  }

  /// The sum over j from the first to the last index, as two sums that do not wait for each other.
  template <class Term>
  static T sum_of(int first, int last, const Term& term) {
    T even(Real(0));
    T odd(Real(0));
    int j = first;
    for (; j < last; j += 2) {
      even += term(j);
      odd += term(j + 1);
    }
    if (j == last) even += term(j);
    return even + odd;
  }

  std::shared_ptr<const OperationList> expanded_;  ///< the list, if it has fields
  const OperationList* list_;
  int order_;
  std::size_t stride_;
  FieldValues<T, Real> fields_;
  std::vector<std::vector<T>> field_coefficients_;  ///< of the coordinates, by value
  int field_degree_ = 0;
  int expected_power_ = 4;
  T unit_ = T(Real(1));
  std::map<const TimeFunction*, std::vector<T>> time_values_;
  std::vector<T> coefficients_;
  std::vector<Step> steps_;
  std::vector<Term> terms_;
};

}  // namespace hamjet
