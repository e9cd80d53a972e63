#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "hamjet/detail/algebra/slice_recurrences.hpp"
#include "hamjet/detail/dynamics/common_powers.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"
#include "hamjet/detail/dynamics/series_work.hpp"

namespace hamjet {

/// Runs an operation list on series, one degree at a time, without knowing the inputs' slice of
/// that degree: the heart of the implicit integrators.
///
/// With v the value of any operation, x the inputs and v_d the slice of degree d,
///
///   v_d = r_d + grad v(x_0) . x_d ,
///
/// where r_d (the remainder) needs only slices below d. So each product of two series is formed
/// once in a step, slice by slice: evaluate_remainder(d) forms all r_d; the caller solves for x_d,
/// writes it into the inputs and calls complete(d), which adds the linear part. T is a real number,
/// or a Pack whose lanes are the stages of an implicit method.
template <class T, class Real>
class SliceEvaluator {
 public:
  /// `working_order` is the highest degree that will be evaluated, at most the space's order. The
  /// list must outlive the evaluator.
  SliceEvaluator(const OperationList& list, SpacePointer space, int working_order)
      : list_(&list), space_(std::move(space)), powers_(list), working_order_(working_order) {
    const std::size_t values = list.operations().size();
    stride_ = space_->first(working_order + 1);
    slices_.assign(values * stride_, T(Real(0)));
    scratch_.assign(stride_, T(Real(0)));
    partial_u_.assign(values, T(Real(0)));
    partial_v_.assign(values, T(Real(0)));
    gradients_.assign(values * list.inputs(), T(Real(0)));
    for (const Operation& o : list.operations()) {
      constants_.push_back(convert<Real>(o.constant));
      first_term_.push_back(coefficients_.size());
      for (const LinearTerm& term : o.terms) {
        coefficients_.push_back(convert<Real>(term.coefficient));
      }
    }
    for (std::size_t j = 0; j < list.inputs(); ++j) gradient(j, j) = T(Real(1));
  }

  /// The coefficients of the i-th input, to be written by the caller; inputs stand first in the
  /// list.
  T* input(std::size_t i) { return value(i); }
  const T* input(std::size_t i) const { return value(i); }
  /// The coefficients of the i-th output.
  const T* output(std::size_t i) const { return value(list_->outputs()[i]); }
  /// The coefficients of the i-th output, to be overwritten; null where the output is one of the
  /// inputs.
  T* mutable_output(std::size_t i) {
    const std::size_t place = list_->outputs()[i];
    return place < list_->inputs() ? nullptr : value(place);
  }
  /// The derivative d output_i / d input_j at the inputs' constant terms.
  const T& output_gradient(std::size_t i, std::size_t j) const {
    return gradients_[list_->outputs()[i] * list_->inputs() + j];
  }

  /// Evaluates the constant terms and the gradients of all values.
  void evaluate_constant_terms() {
    evaluate_constant_values();
    for (std::size_t i = list_->inputs(); i < list_->operations().size(); ++i) {
      evaluate_partials(i, list_->operations()[i]);
      evaluate_gradient(i, list_->operations()[i]);
    }
  }
  /// Evaluates the constant terms of all values, without their gradients.
  void evaluate_constant_values() {
    for (std::size_t i = list_->inputs(); i < list_->operations().size(); ++i) {
      evaluate_constant_term(i, list_->operations()[i]);
    }
  }

  /// Forms the remainders r_d, d >= 1.
  void evaluate_remainder(int d) {
    if (d < 2) return;  // at degree 1 everything is linear in the inputs
    for (std::size_t i = list_->inputs(); i < list_->operations().size(); ++i) {
      if (!list_->is_affine(i)) form_remainder(i, list_->operations()[i], d);
    }
  }

  /// Whether an output has a remainder at this degree (otherwise its slice is not yet meaningful).
  bool has_remainder(std::size_t output, int d) const {
    return d >= 2 && !list_->is_affine(list_->outputs()[output]);
  }

  /// Adds the linear part, the inputs' slices of degree d being known now. At the working order the
  /// intermediate values are needed by nothing, and only the outputs are completed.
  void complete(int d) {
    if (d == working_order_) {
      for (const std::size_t i : list_->outputs()) {
        if (i >= list_->inputs()) add_linear_part(i, d);
      }
    } else {
      for (std::size_t i = list_->inputs(); i < list_->operations().size(); ++i) {
        add_linear_part(i, d);
      }
    }
  }

  /// The work of the products of series formed so far.
  const SeriesWork& work() const noexcept { return work_; }

  /// Evaluates all degrees at once, for explicit methods, which know the inputs in full.
  void evaluate_all() {
    evaluate_constant_terms();
    for (int d = 1; d <= working_order_; ++d) {
      evaluate_remainder(d);
      complete(d);
    }
  }

 private:
  T* value(std::size_t i) { return slices_.data() + i * stride_; }
  const T* value(std::size_t i) const { return slices_.data() + i * stride_; }
  T& gradient(std::size_t i, std::size_t j) { return gradients_[i * list_->inputs() + j]; }

  void evaluate_constant_term(std::size_t i, const Operation& o) {
    using std::cos;
    using std::exp;
    using std::log;
    using std::sin;
    const T& u = *value(o.u);
    const T& v = *value(o.v);
    T& w = *value(i);
    switch (o.code) {
      case OperationCode::input:
        break;
      case OperationCode::linear: {
        T sum(constants_[i]);
        for (std::size_t k = 0; k < o.terms.size(); ++k) {
          sum = add_product(sum, T(coefficients_[first_term_[i] + k]), *value(o.terms[k].value));
        }
        w = sum;
        break;
      }
      case OperationCode::product:
        w = u * v;
        break;
      case OperationCode::square:
        w = u * u;
        break;
      case OperationCode::quotient:
        partial_u_[i] = T(Real(1)) / v;
        w = u * partial_u_[i];
        break;
      case OperationCode::power:
        powers_.evaluate(i, u, constants_[i], [this](std::size_t k) -> T& { return *value(k); });
        break;
      case OperationCode::exponential:
        w = T(exp(u));
        break;
      case OperationCode::logarithm:
        w = T(log(u));
        break;
      case OperationCode::sine:
        w = T(sin(u));
        break;
      case OperationCode::cosine:
        w = T(cos(u));
        break;
    }
  }

  /// The partial derivatives of a value by its operands, all values being known.
  void evaluate_partials(std::size_t i, const Operation& o) {
    const T& u = *value(o.u);
    const T& w = *value(i);
    switch (o.code) {
      case OperationCode::input:
      case OperationCode::linear:
        break;
      case OperationCode::product:
        partial_u_[i] = *value(o.v);
        partial_v_[i] = u;
        break;
      case OperationCode::square:
        partial_u_[i] = u + u;
        break;
      case OperationCode::quotient:  // the one by u, 1/v, is there already
        partial_v_[i] = -w * partial_u_[i];
        break;
      case OperationCode::power:
        partial_u_[i] = powers_.derivative(i, u, constants_[i], w);
        break;
      case OperationCode::exponential:
        partial_u_[i] = w;
        break;
      case OperationCode::logarithm:
        partial_u_[i] = T(Real(1)) / u;
        break;
      case OperationCode::sine:
        partial_u_[i] = *value(o.v);
        break;
      case OperationCode::cosine:
        partial_u_[i] = -*value(o.v);
        break;
    }
  }

  void evaluate_gradient(std::size_t i, const Operation& o) {
    const std::uint64_t mask = list_->dependencies(i);
    const bool binary = has_two_operands(o.code);
    for (std::size_t j = 0; j < list_->inputs(); ++j) {
      if ((mask >> j & 1) == 0) continue;
      T sum(Real(0));
      if (o.code == OperationCode::linear) {
        for (std::size_t k = 0; k < o.terms.size(); ++k) {
          sum =
              add_product(sum, T(coefficients_[first_term_[i] + k]), gradient(o.terms[k].value, j));
        }
      } else {
        sum = partial_u_[i] * gradient(o.u, j);
        if (binary) sum = add_product(sum, partial_v_[i], gradient(o.v, j));
      }
      gradient(i, j) = sum;
    }
  }

  /// sum + a b, fused wherever that is fast: left to the compiler, fusing may differ from one
  /// inlined copy to the next, and a nominal alone would have other last bits than the same nominal
  /// with its jet.
  static T add_product(const T& sum, const T& a, const T& b) {
#ifdef __FP_FAST_FMA
    if constexpr (std::is_same_v<T, double>) return std::fma(a, b, sum);
#endif
    return sum + a * b;
  }

  static bool has_two_operands(OperationCode code) {
    return code == OperationCode::product || code == OperationCode::quotient;
  }

  void form_remainder(std::size_t i, const Operation& o, int d) {
    const SeriesSpace& space = *space_;
    T* w = value(i);
    const T* u = value(o.u);
    switch (o.code) {
      case OperationCode::input:
        return;
      case OperationCode::linear:
        form_linear_remainder(i, o, d);
        return;
      case OperationCode::product:
        interior_product(space, d, u, value(o.v), w);
        count_product(d);
        break;
      case OperationCode::square:
        interior_square(space, d, u, w);
        count_square(d);
        break;
      case OperationCode::quotient:
        quotient_interior(space, d, value(o.v), w);
        count_product(d);
        break;
      case OperationCode::power:
        if (constants_[i] == Real(-1)) {
          reciprocal_interior(space, d, u, w);
          count_product(d);
        } else if (constants_[i] == Real(0.5)) {
          square_root_interior(space, d, w);
          count_square(d);
        } else {
          power_interior(space, d, constants_[i], u, w, scratch_.data());
          count_product(d);
        }
        break;
      case OperationCode::exponential:
        exponential_interior<Real>(space, d, u, w, scratch_.data());
        count_product(d);
        break;
      case OperationCode::logarithm:
        logarithm_interior<Real>(space, d, u, w, scratch_.data());
        count_product(d);
        break;
      case OperationCode::sine:
        sine_cosine_interior<Real>(space, d, u, w, value(o.v), scratch_.data());
        count_product(d);
        count_product(d);
        break;
      case OperationCode::cosine:
        break;  // its interior part was written with the sine's
    }
    Terms terms;
    if (!list_->is_affine(o.u)) terms.add(partial_u_[i], value(o.u));
    if (has_two_operands(o.code) && !list_->is_affine(o.v)) terms.add(partial_v_[i], value(o.v));
    add_terms(terms, d, w, true);
  }

  void count_product(int d) {
    ++work_.slice_products;
    work_.multiply_adds += static_cast<double>(space_->products(d).multiply_adds);
  }
  void count_square(int d) {
    ++work_.slice_products;
    work_.multiply_adds += static_cast<double>(space_->products(d).square_multiply_adds);
  }

  /// A sum of factors times series, gathered so that the result is read and written once.
  struct Terms {
    static constexpr std::size_t largest_count = 3;
    std::array<T, largest_count> factors{};
    std::array<const T*, largest_count> series{};
    std::size_t count = 0;

    bool is_full() const { return count == largest_count; }
    void add(const T& factor, const T* values) {
      factors[count] = factor;
      series[count] = values;
      ++count;
    }
  };

  /// Sets w_d = (keep ? w_d : 0) + sum of the terms' slices.
  void add_terms(const Terms& terms, int d, T* w, bool keep) {
    switch (terms.count) {
      case 1:
        keep ? add_terms<1, true>(terms, d, w) : add_terms<1, false>(terms, d, w);
        break;
      case 2:
        keep ? add_terms<2, true>(terms, d, w) : add_terms<2, false>(terms, d, w);
        break;
      case 3:
        keep ? add_terms<3, true>(terms, d, w) : add_terms<3, false>(terms, d, w);
        break;
      default:
        break;
    }
  }

  template <std::size_t Count, bool Keep>
  void add_terms(const Terms& terms, int d, T* w) {
    const auto factors = terms.factors;
    const auto series = terms.series;
    for (std::size_t k = space_->first(d); k < space_->first(d + 1); ++k) {
      T sum = Keep ? T(w[k] + factors[0] * series[0][k]) : T(factors[0] * series[0][k]);
      for (std::size_t t = 1; t < Count; ++t) sum += factors[t] * series[t][k];
      w[k] = sum;
    }
  }

  void form_linear_remainder(std::size_t i, const Operation& o, int d) {
    Terms terms;
    bool keep = false;
    for (std::size_t t = 0; t < o.terms.size(); ++t) {
      if (list_->is_affine(o.terms[t].value)) continue;
      if (terms.is_full()) flush(terms, d, value(i), keep);
      terms.add(T(coefficients_[first_term_[i] + t]), value(o.terms[t].value));
    }
    flush(terms, d, value(i), keep);
  }

  void add_linear_part(std::size_t i, int d) {
    const std::uint64_t mask = list_->dependencies(i);
    Terms terms;
    bool keep = d >= 2 && !list_->is_affine(i);
    for (std::size_t j = 0; j < list_->inputs(); ++j) {
      if ((mask >> j & 1) == 0) continue;
      if (terms.is_full()) flush(terms, d, value(i), keep);
      terms.add(gradient(i, j), value(j));
    }
    flush(terms, d, value(i), keep);
  }

  void flush(Terms& terms, int d, T* w, bool& keep) {
    add_terms(terms, d, w, keep);
    keep = keep || terms.count > 0;
    terms.count = 0;
  }

  const OperationList* list_;
  SpacePointer space_;
  CommonPowers<T, Real> powers_;
  int working_order_;
  std::size_t stride_ = 0;
  std::vector<T> slices_;  ///< one series per value
  std::vector<T> scratch_;
  std::vector<T> partial_u_;
  std::vector<T> partial_v_;
  std::vector<T> gradients_;
  std::vector<Real> constants_;
  std::vector<Real> coefficients_;
  std::vector<std::size_t> first_term_;
  SeriesWork work_;
};

}  // namespace hamjet
