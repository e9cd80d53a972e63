#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/detail/algebra/slice_recurrences.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// Runs an operation list on series in one variable, power by power. When the inputs' coefficients
/// are known up to the power k, the coefficient of t^k of each operation is formed from the
/// coefficients of its operands up to k. SliceEvaluator does the same in several variables; here
/// every coefficient is known when it is needed, so that no gradients are computed. Source of the
/// recurrences: A. Griewank and A. Walther, Evaluating Derivatives, 2nd ed., SIAM 2008, section
/// 13.2.
///
/// T is a real number or a Pack, Real its number type.
template <class T, class Real>
class TimeExpansion {
 public:
  /// Prepares expansions up to the power `order`; the list must outlive the object.
  TimeExpansion(const OperationList& list, int order)
      : list_(&list), stride_(static_cast<std::size_t>(order) + 1) {
    coefficients_.assign(list.operations().size() * stride_, T(Real(0)));
    for (std::size_t i = list.inputs(); i < list.operations().size(); ++i) {
      const Operation& operation = list.operations()[i];
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

  /// Forms the coefficients of t^k of all values; those of lower powers must be known.
  void expand(int k) {
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
    }
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

  const OperationList* list_;
  std::size_t stride_;
  std::vector<T> coefficients_;
  std::vector<Step> steps_;
  std::vector<Term> terms_;
};

}  // namespace hamjet
