#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/slice_recurrences.hpp"
#include "hamjet/detail/dynamics/common_powers.hpp"
#include "hamjet/detail/dynamics/field_values.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"
#include "hamjet/detail/dynamics/series_work.hpp"
#include "hamjet/detail/dynamics/slice_propagation.hpp"

namespace hamjet {

/// Runs an operation list on series, one degree at a time, before the inputs' slice of that degree
/// is known. The implicit integrators are built on this class.
///
/// With y an output, x the inputs and y_d the slice of degree d,
///
///   y_d = r_d + grad y(x_0) . x_d ,
///
/// where r_d (the remainder) needs only slices below d. So each product of two series is formed
/// once in a step, slice by slice. evaluate_remainder(d) forms the sums of products and from them
/// all r_d. The caller then solves for x_d, writes x_d into the inputs and calls complete(d), which
/// adds the linear part and forms the intermediate values (SlicePropagation). T is a real number,
/// or a Pack whose lanes are the stages of an implicit method.
///
/// In a list that has the time, set_time comes before every evaluation at other times; until then
/// all that depends on the time is NaN.
template <class T, class Real>
class SliceEvaluator {
 public:
  /// `working_order` is the highest degree that will be evaluated, and at most the space's order.
  /// The list must outlive the evaluator.
  SliceEvaluator(const OperationList& list, SpacePointer space, int working_order)
      : expanded_(list.has_fields()
                      ? std::make_shared<const OperationList>(expand_fields(list, working_order))
                      : nullptr),
        list_(expanded_ ? expanded_.get() : &list),
        space_(std::move(space)),
        powers_(*list_),
        propagation_(*list_, working_order),
        fields_(*list_, working_order, space_->first(working_order + 1)),
        working_order_(working_order) {
    const std::size_t values = list_->operations().size();
    stride_ = space_->first(working_order + 1);
    slices_.assign(values * stride_, T(Real(0)));
    remainders_.assign(working_order >= 2 ? list.outputs().size() * stride_ : 0, T(Real(0)));
    scratch_.assign(stride_, T(Real(0)));
    for (const Operation& o : list_->operations()) constants_.push_back(convert<Real>(o.constant));
    for (std::size_t i = list_->first_series_value(); i < values; ++i) steps_.push_back(step_of(i));
    set_schedules();
    if (list.has_time()) {
      set_time(T(Real(std::numeric_limits<double>::quiet_NaN())));
    } else {
      evaluate_numbers();
    }
  }

  /// Whether the list has the time.
  bool has_time() const { return list_->has_time(); }
  /// Sets the time, and evaluates what depends on it alone. It does nothing for a list that has no
  /// time. Throws what the functions of the time throw.
  void set_time(const T& time) {
    if (!list_->has_time()) return;
    *value(list_->variables()) = time;
    evaluate_numbers();
  }
  /// The number of values that depend on the time alone, or on nothing, with the time itself; the
  /// same for all evaluators of a list.
  std::size_t numbers() const { return list_->first_series_value() - list_->variables(); }
  /// One of these values, which set_time sets; the caller may overwrite it by that of another
  /// evaluator of the same list.
  T& number(std::size_t i) { return *value(list_->variables() + i); }

  /// The coefficients of the i-th input, which the caller writes; inputs stand first in the list.
  T* input(std::size_t i) { return value(i); }
  const T* input(std::size_t i) const { return value(i); }
  /// The coefficients of the i-th output.
  const T* output(std::size_t i) const { return value(list_->outputs()[i]); }
  /// The coefficients of the i-th output, which the caller may overwrite; null where the output is
  /// one of the inputs or a number.
  T* mutable_output(std::size_t i) {
    const std::size_t place = list_->outputs()[i];
    return place < list_->first_series_value() ? nullptr : value(place);
  }
  /// The derivative d output_i / d input_j at the inputs' constant terms.
  const T& output_gradient(std::size_t i, std::size_t j) const {
    return propagation_.gradient(i, j);
  }

  /// Evaluates the constant terms and the gradients of the outputs.
  void evaluate_constant_terms() {
    evaluate_constant_values();
    for (const Step& step : steps_) set_linear_part(step);
    propagation_.set_gradients();
  }
  /// Evaluates the constant terms of all values, without gradients.
  void evaluate_constant_values() {
    for (const Step& step : steps_) evaluate_constant_term(step);
  }

  /// Forms the remainders r_d. It must be called once for each d = 1 to the working order, in this
  /// order.
  void evaluate_remainder(int d) {
    if (d < 2) return;  // at degree 1 everything is linear in the inputs
    if (d == 2) propagation_.set_weights();
    form_sums(d);
    propagation_.form_remainders(d, slices_.data(), stride_, space_->first(d), space_->first(d + 1),
                                 remainders_.data());
  }

  /// Whether an output has a remainder at this degree.
  bool has_remainder(std::size_t output, int d) const {
    return d >= 2 && !list_->is_affine(list_->outputs()[output]);
  }
  /// The remainders of the i-th output, where it has them; for working orders of 2 and more.
  const T* remainder(std::size_t i) const { return remainders_.data() + i * stride_; }

  /// Forms all values of degree d from the remainders and the inputs' slices, which the caller has
  /// set. At the working order only the outputs are formed, because nothing needs the intermediate
  /// values.
  void complete(int d) {
    if (d < working_order_) complete_intermediates(d);
    propagation_.complete_outputs(slices_.data(), stride_, space_->first(d), space_->first(d + 1),
                                  remainders_.data(), d >= 2);
  }
  /// As complete(d), but forms only the values that higher degrees need: outputs that are no
  /// operand of another operation stay as they are.
  void complete_intermediates(int d) {
    propagation_.complete_intermediates(slices_.data(), stride_, space_->first(d),
                                        space_->first(d + 1), d >= 2);
  }

  /// The work of the products of series formed so far.
  const SeriesWork& work() const noexcept { return work_; }

  /// Evaluates all degrees at once, without remainders. This is for explicit methods, which know
  /// the inputs in full.
  void evaluate_all() {
    evaluate_constant_terms();
    for (int d = 1; d <= working_order_; ++d) {
      if (d >= 2) form_sums(d);
      propagation_.complete_values(slices_.data(), stride_, space_->first(d), space_->first(d + 1),
                                   d >= 2);
    }
  }

 private:
  /// What the loops over the operations need of each.
  struct Step {
    OperationCode code;
    bool has_sums;
    std::uint32_t value;
    std::uint32_t u;
    std::uint32_t v;
  };

  Step step_of(std::size_t i) const {
    const Operation& o = list_->operations()[i];
    const auto place = [](std::size_t value) { return static_cast<std::uint32_t>(value); };
    return {o.code, list_->has_sums(i), place(i), place(o.u), place(o.v)};
  }

  T* value(std::size_t i) { return slices_.data() + i * stride_; }
  const T* value(std::size_t i) const { return slices_.data() + i * stride_; }

  /// Evaluates the numbers that are no inputs.
  void evaluate_numbers() {
    for (auto& [function, values] : time_values_) values.clear();
    for (std::size_t i = list_->inputs(); i < list_->first_series_value(); ++i) {
      evaluate_constant_term(step_of(i));
    }
  }

  // What is rare stays out of the loops over the operations, which would be slower with it.

  [[gnu::noinline]] T field_value(std::size_t i) {
    return fields_.evaluate(i, [this](std::size_t k) -> const T& { return *value(k); });
  }
  [[gnu::noinline]] void set_field_factors(std::size_t i) {
    fields_.evaluate_coefficients(
        i, 0, std::max(working_order_, 1), [this](std::size_t k) -> const T& { return *value(k); },
        [&](std::size_t term, const T& factor) { propagation_.factor(i, term) = factor; });
  }

  /// A component of a function of the time; a function is asked once for all its components.
  [[gnu::noinline]] T time_value(const Operation& o) {
    std::vector<T>& values = time_values_[{o.time_function.get(), o.u}];
    if (values.empty()) {
      expand_in_lanes<T, Real>(*o.time_function, *value(o.u), 0, values);
    }
    return values[o.component];
  }

  void evaluate_constant_term(const Step& o) {
    const std::size_t i = o.value;
    using std::atan2;
    using std::cos;
    using std::cosh;
    using std::exp;
    using std::log;
    using std::sin;
    using std::sinh;
    const T& u = *value(o.u);
    const T& v = *value(o.v);
    T& w = *value(i);
    switch (o.code) {
      case OperationCode::input:
        break;
      case OperationCode::linear:
        w = propagation_.linear_value(i, constants_[i], slices_.data(), stride_);
        break;
      case OperationCode::product:
        w = u * v;
        break;
      case OperationCode::square:
        w = u * u;
        break;
      case OperationCode::quotient:
        propagation_.factor(i, 0) = T(Real(1)) / v;
        w = u * propagation_.factor(i, 0);
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
      case OperationCode::hyperbolic_sine:
        w = T(sinh(u));
        break;
      case OperationCode::hyperbolic_cosine:
        w = T(cosh(u));
        break;
      case OperationCode::angle:
        w = T(atan2(u, v));
        break;
      case OperationCode::time_function:
        w = time_value(list_->operations()[i]);
        break;
      case OperationCode::field:
        w = field_value(i);
        break;
      case OperationCode::deviation_product:
        break;  // its constant term is 0
    }
  }

  /// Sets the factors with which the slices of a value's operands enter its own slice, and the
  /// scale of its sums. The constant terms of all values must be known.
  void set_linear_part(const Step& o) {
    const std::size_t i = o.value;
    const T& u = *value(o.u);
    const T& w = *value(i);
    switch (o.code) {
      case OperationCode::input:
      case OperationCode::linear:
      case OperationCode::time_function:
      case OperationCode::deviation_product:
        break;
      case OperationCode::field:
        set_field_factors(i);
        break;
      case OperationCode::product:
        propagation_.factor(i, 0) = *value(o.v);
        propagation_.factor(i, 1) = u;
        break;
      case OperationCode::square:
        propagation_.factor(i, 0) = u + u;
        break;
      case OperationCode::quotient:  // the factor of u, 1/v, is there already
        propagation_.factor(i, 1) = -w * propagation_.factor(i, 0);
        propagation_.scale(i) = quotient_scale(propagation_.factor(i, 0));
        break;
      case OperationCode::power:
        propagation_.factor(i, 0) = powers_.derivative(i, u, constants_[i], w);
        propagation_.scale(i) = constants_[i] == Real(-1)    ? quotient_scale(w)
                                : constants_[i] == Real(0.5) ? square_root_scale(w)
                                                             : power_scale(u);
        break;
      case OperationCode::exponential:
        propagation_.factor(i, 0) = w;
        break;
      case OperationCode::logarithm:
        propagation_.factor(i, 0) = T(Real(1)) / u;
        propagation_.scale(i) = logarithm_scale(u);
        break;
      case OperationCode::sine:
        propagation_.factor(i, 0) = *value(o.v);
        break;
      case OperationCode::cosine:
        propagation_.factor(i, 0) = -*value(o.v);
        propagation_.scale(i) = T(Real(-1));
        break;
      case OperationCode::hyperbolic_sine:
      case OperationCode::hyperbolic_cosine:
        propagation_.factor(i, 0) = *value(o.v);
        break;
      case OperationCode::angle:
        propagation_.factor(i, 0) = *value(o.v);
        propagation_.factor(i, 1) = -u;
        break;
    }
  }

  void form_sums(int d) {
    if (!fields_.is_empty()) {
      fields_.form_cofactors(d - 1, space_->first(d - 1), space_->first(d), slices_.data());
    }
    for (const Step& step : steps_) form_sums(step, d);
  }

  /// Forms the sums of degree d of a nonlinear operation.
  void form_sums(const Step& o, int d) {
    const std::size_t i = o.value;
    const SeriesSpace& space = *space_;
    T* w = value(i);
    const T* u = value(o.u);
    switch (o.code) {
      case OperationCode::input:
      case OperationCode::linear:
      case OperationCode::time_function:
        break;
      case OperationCode::field:
        form_field_sum(i, list_->operations()[i], d);
        break;
      case OperationCode::deviation_product:
        form_deviation_product(i, list_->operations()[i], d);
        break;
      case OperationCode::product:
        if (!o.has_sums) break;
        interior_product(space, d, u, value(o.v), w);
        count_product(d);
        break;
      case OperationCode::square:
        interior_square(space, d, u, w);
        count_square(d);
        break;
      case OperationCode::quotient:
        quotient_sum(space, d, value(o.v), w);
        count_product(d);
        break;
      case OperationCode::power:
        if (constants_[i] == Real(-1)) {
          quotient_sum(space, d, u, w);
          count_product(d);
        } else if (constants_[i] == Real(0.5)) {
          square_root_sum(space, d, w);
          count_square(d);
        } else {
          power_sum(space, d, constants_[i], u, w, scratch_.data());
          count_product(d);
        }
        break;
      case OperationCode::exponential:
        exponential_sum<Real>(space, d, u, w, scratch_.data());
        count_product(d);
        break;
      case OperationCode::logarithm:
        logarithm_sum<Real>(space, d, u, w, scratch_.data());
        count_product(d);
        break;
      case OperationCode::sine:
      case OperationCode::hyperbolic_sine:
        sine_cosine_sum<Real>(space, d, u, w, value(o.v), scratch_.data());
        count_product(d);
        count_product(d);
        break;
      case OperationCode::cosine:
      case OperationCode::hyperbolic_cosine:
        break;  // the sums of the cosine were written with those of its sine
      case OperationCode::angle:
        angle_sum<Real>(space, d, u, value(o.v), w, scratch_.data());
        count_product(d);
        break;
    }
  }

  /// The schedules of the products of deviations, by value and degree.
  void set_schedules() {
    schedules_.resize(list_->operations().size());
    for (std::size_t i = 0; i < schedules_.size(); ++i) {
      const Operation& o = list_->operations()[i];
      if (o.code != OperationCode::deviation_product) continue;
      for (int d = o.lowest[0] + o.lowest[1]; d < working_order_; ++d) {
        schedules_[i].push_back(&space_->products_above(d, o.lowest[0], o.lowest[1], o.u == o.v));
      }
    }
  }

  [[gnu::noinline]] void form_field_sum(std::size_t i, const Operation& o, int d) {
    T* const w = value(i);
    for (std::size_t c = 0; c < o.terms.size(); ++c) {
      T* const target = c == 0 ? w : scratch_.data();
      interior_product(*space_, d, fields_.cofactor(i, c), value(o.terms[c].value), target);
      count_product(d);
      if (c == 0) continue;
      for (std::size_t k = space_->first(d); k < space_->first(d + 1); ++k) w[k] += target[k];
    }
  }

  [[gnu::noinline]] void form_deviation_product(std::size_t i, const Operation& o, int d) {
    const int lowest = o.lowest[0] + o.lowest[1];
    // Cofactors, which alone need it, have no slice of the working order.
    if (d < lowest || d == working_order_) return;
    const ProductSchedule& schedule = *schedules_[i][static_cast<std::size_t>(d - lowest)];
    product_above(*space_, schedule, d, o.lowest[0], o.lowest[1], value(o.u), value(o.v), value(i));
    ++work_.slice_products;
    work_.multiply_adds +=
        static_cast<double>(o.u == o.v ? schedule.square_multiply_adds : schedule.multiply_adds);
  }

  void count_product(int d) {
    ++work_.slice_products;
    work_.multiply_adds += static_cast<double>(space_->products(d).multiply_adds);
  }
  void count_square(int d) {
    ++work_.slice_products;
    work_.multiply_adds += static_cast<double>(space_->products(d).square_multiply_adds);
  }

  std::shared_ptr<const OperationList> expanded_;  ///< the list, if it has fields
  const OperationList* list_;
  SpacePointer space_;
  CommonPowers<T, Real> powers_;
  SlicePropagation<T, Real> propagation_;
  FieldValues<T, Real> fields_;
  int working_order_;
  std::size_t stride_ = 0;
  std::vector<T> slices_;      ///< one series per value
  std::vector<T> remainders_;  ///< one series per output
  std::vector<T> scratch_;
  std::vector<Real> constants_;
  std::vector<Step> steps_;  ///< the steps of the operations that are no numbers
  /// The schedules of products of deviations.
  std::vector<std::vector<const ProductSchedule*>> schedules_;
  std::map<std::pair<const TimeFunction*, std::size_t>, std::vector<T>> time_values_;
  SeriesWork work_;
};

// Compiled once for all, by slice_evaluator.cpp.
extern template class SliceEvaluator<double, double>;
extern template class SliceEvaluator<Extended, Extended>;

}  // namespace hamjet
