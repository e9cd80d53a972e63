#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// The linear relation between the slices of one degree of all values of an operation list. With s
/// the sums that the nonlinear operations have formed from the slices below
/// (slice_recurrences.hpp),
///
///   v_d = scale s + sum over the operands u of factor u_d .
///
/// The scales and factors depend on constant terms alone. An output follows from the sums below it
/// and the inputs x alone,
///
///   y_d = sum weight s + grad y . x_d ,
///
/// so that an output needs no intermediate value. Gradients are accumulated forwards through the
/// list, because constant terms alone need them too; weights are accumulated backwards (Griewank
/// and Walther, Evaluating Derivatives, sections 3.1 and 3.2). T and Real are as in SliceEvaluator.
template <class T, class Real>
class SlicePropagation {
 public:
  /// The list must outlive this object. Only what degrees up to `working_order` need is prepared.
  SlicePropagation(const OperationList& list, int working_order)
      : list_(&list), scales_(list.operations().size(), T(Real(1))) {
    std::vector<bool> is_operand(scales_.size(), false);
    for (const Operation& o : list.operations()) {
      first_factor_.push_back(operands_.size());
      for_each_operand(o, [&](std::size_t operand, const T& factor) {
        operands_.push_back(operand);
        factors_.push_back(factor);
        is_operand[operand] = true;
      });
      // The sums of each of a pair need the other's slices.
      if (is_of_pair(o.code)) is_operand[o.v] = true;
    }
    first_factor_.push_back(operands_.size());
    gradients_.assign(scales_.size() * list.inputs(), T(Real(0)));
    for (std::size_t j = 0; j < list.inputs(); ++j) gradient_of(j, j) = T(Real(1));
    if (working_order >= 2) set_groups();
    if (working_order >= 1) set_values(is_operand);
  }

  /// The derivative of a value with respect to one of its operands. The caller writes it for all
  /// operations that are not linear.
  T& factor(std::size_t value, std::size_t operand) {
    return factors_[first_factor_[value] + operand];
  }
  /// The scale of a nonlinear operation's sums; 1 unless the caller writes another one.
  T& scale(std::size_t value) { return scales_[value]; }

  /// sum + a b, fused wherever that is fast. Left to the compiler, fusing may differ from one
  /// inlined copy to the next, and a nominal that is integrated alone would have other last bits
  /// than with its jet.
  static T add_product(const T& sum, const T& a, const T& b) {
#ifdef __FP_FAST_FMA
    if constexpr (std::is_same_v<T, double>) return std::fma(a, b, sum);
#endif
    return sum + a * b;
  }

  /// Forms the gradients of all values, from the factors.
  void set_gradients() {
    const std::size_t inputs = list_->inputs();
    for (std::size_t i = inputs; i < scales_.size(); ++i) {
      const std::uint64_t mask = list_->dependencies(i);
      for (std::size_t j = 0; j < inputs; ++j) {
        if ((mask >> j & 1) == 0) continue;
        T sum(Real(0));
        for (std::size_t f = first_factor_[i]; f < first_factor_[i + 1]; ++f) {
          sum = add_product(sum, factors_[f], gradient_of(operands_[f], j));
        }
        gradient_of(i, j) = sum;
      }
    }
  }
  /// The derivative d output / d input at the inputs' constant terms.
  const T& gradient(std::size_t output, std::size_t input) const {
    return gradients_[list_->outputs()[output] * list_->inputs() + input];
  }

  /// Forms the weights from the factors and scales.
  void set_weights() {
    for (const Group& group : groups_) {
      with_width(group, [&]<std::size_t Outputs>(Width<Outputs>) { set_weights<Outputs>(group); });
    }
  }

  /// Forms the remainders of the outputs that have one from the sums, for the monomials from
  /// `first` to `last`. Value i stands at slices + i stride, and the remainder of output o at
  /// remainders + o stride.
  void form_remainders(const T* slices, std::size_t stride, std::size_t first, std::size_t last,
                       T* remainders) const {
    in_tiles(first, last, [&]<std::size_t Monomials>(Width<Monomials>, std::size_t k) {
      for (const Group& group : groups_) {
        with_width(group, [&]<std::size_t Outputs>(Width<Outputs>) {
          std::array<std::array<T, Monomials>, Outputs> sums{};
          const T* weight = weights_.data() + group.first_weight;
          for (const std::size_t i : group.sums) {
            const T* const s = slices + i * stride + k;
            for (std::size_t t = 0; t < Monomials; ++t) {
              for (std::size_t w = 0; w < Outputs; ++w) sums[w][t] += weight[w] * s[t];
            }
            weight += Outputs;
          }
          for (std::size_t w = 0; w < Outputs; ++w) {
            put(sums[w], remainders + group.outputs[w] * stride + k);
          }
        });
      }
    });
  }

  /// Replaces the sums (if there are any at this degree) by the values, for the monomials from
  /// `first` to `last`, once the inputs are known.
  void complete_values(T* slices, std::size_t stride, std::size_t first, std::size_t last,
                       bool has_sums) const {
    complete(values_, slices, stride, first, last, has_sums);
  }
  /// As complete_values, but leaves out the values that are outputs and no operand of another
  /// operation.
  void complete_intermediates(T* slices, std::size_t stride, std::size_t first, std::size_t last,
                              bool has_sums) const {
    complete(intermediates_, slices, stride, first, last, has_sums);
  }

  /// Forms the outputs that are not inputs from their remainders (where this degree has sums), for
  /// the monomials from `first` to `last`, once the inputs are known.
  void complete_outputs(T* slices, std::size_t stride, std::size_t first, std::size_t last,
                        const T* remainders, bool has_sums) const {
    in_tiles(first, last, [&]<std::size_t Monomials>(Width<Monomials>, std::size_t k) {
      for (std::size_t o = 0; o < list_->outputs().size(); ++o) {
        const std::size_t output = list_->outputs()[o];
        if (output < list_->inputs()) continue;
        std::array<T, Monomials> sums{};
        if (has_sums && !list_->is_affine(output)) {
          const T* const remainder = remainders + o * stride + k;
          for (std::size_t t = 0; t < Monomials; ++t) sums[t] = remainder[t];
        }
        for (std::size_t j = 0; j < list_->inputs(); ++j) {
          if ((list_->dependencies(output) >> j & 1) == 0) continue;
          add(gradient(o, j), slices + j * stride + k, sums);
        }
        put(sums, slices + output * stride + k);
      }
    });
  }

 private:
  /// Outputs whose remainders are formed together, because each step backwards through the list
  /// waits for the one before. If one of them is not finite, the remainders of the others need not
  /// be finite either.
  struct Group {
    std::vector<std::size_t> outputs;
    /// Values on which these outputs depend, without the inputs, the later ones first.
    std::vector<std::size_t> values;
    std::vector<std::size_t> sums;  ///< the nonlinear operations among these values
    std::size_t first_weight =
        0;  ///< index of the first weight; there is one for each sum and output
  };
  static constexpr std::size_t whole_group = 3;

  template <std::size_t>
  struct Width {};
  static constexpr bool is_of_numbers = sizeof(T) <= sizeof(double);
  /// The number of monomials that go through the list together. Their slices then stay in the
  /// nearest cache, and with 32 vector registers the sums for a group of outputs stay in registers.
  static constexpr std::size_t tile = sizeof(T) >= 512 ? 1
                                      : sizeof(T) > 64 ? 512 / sizeof(T)
                                      : is_of_numbers  ? 4
                                                       : 8;
  /// The number of monomials that are taken together if T is a plain number, which fills vectors
  /// along the monomials.
  static constexpr std::size_t long_tile = is_of_numbers ? 16 : tile;

  template <class Run>
  static void in_tiles(std::size_t first, std::size_t last, const Run& run) {
    if constexpr (long_tile > tile) {
      for (; first + long_tile <= last; first += long_tile) run(Width<long_tile>{}, first);
    }
    for (; first + tile <= last; first += tile) run(Width<tile>{}, first);
    // With two uncoupled variables a degree has only two monomials.
    if constexpr (tile > 2) {
      for (; first + 2 <= last; first += 2) run(Width<2>{}, first);
    }
    for (; first < last; ++first) run(Width<1>{}, first);
  }
  template <class Run>
  static void with_width(const Group& group, const Run& run) {
    group.outputs.size() == whole_group ? run(Width<whole_group>{}) : run(Width<1>{});
  }

  template <std::size_t Count>
  static void put(const std::array<T, Count>& values, T* target) {
    for (std::size_t t = 0; t < Count; ++t) target[t] = values[t];
  }
  template <std::size_t Count>
  static void add(const T& factor, const T* series, std::array<T, Count>& sums) {
    for (std::size_t t = 0; t < Count; ++t) sums[t] += factor * series[t];
  }

  void complete(const std::vector<std::size_t>& which, T* slices, std::size_t stride,
                std::size_t first, std::size_t last, bool has_sums) const {
    in_tiles(first, last, [&]<std::size_t Monomials>(Width<Monomials>, std::size_t k) {
      for (const std::size_t i : which) {
        T* const w = slices + i * stride + k;
        std::array<T, Monomials> sums{};
        if (has_sums && is_nonlinear(i)) {
          for (std::size_t t = 0; t < Monomials; ++t) sums[t] = scales_[i] * w[t];
        }
        for (std::size_t f = first_factor_[i]; f < first_factor_[i + 1]; ++f) {
          add(factors_[f], slices + operands_[f] * stride + k, sums);
        }
        put(sums, w);
      }
    });
  }

  template <std::size_t Outputs>
  void set_weights(const Group& group) {
    const auto set_zeros = [&](std::size_t i) {
      std::fill_n(&adjoints_[i * Outputs], Outputs, T(Real(0)));
    };
    for (const std::size_t i : group.values) set_zeros(i);
    for (std::size_t j = 0; j < list_->inputs(); ++j) set_zeros(j);
    for (std::size_t w = 0; w < Outputs; ++w) {
      adjoints_[list_->outputs()[group.outputs[w]] * Outputs + w] = T(Real(1));
    }
    T* weight = weights_.data() + group.first_weight;
    for (const std::size_t i : group.values) {
      const T* const adjoint = &adjoints_[i * Outputs];
      for (std::size_t f = first_factor_[i]; f < first_factor_[i + 1]; ++f) {
        T* const sums = &adjoints_[operands_[f] * Outputs];
        for (std::size_t w = 0; w < Outputs; ++w) {
          sums[w] = add_product(sums[w], adjoint[w], factors_[f]);
        }
      }
      if (!is_nonlinear(i)) continue;
      for (std::size_t w = 0; w < Outputs; ++w) *weight++ = adjoint[w] * scales_[i];
    }
  }

  bool is_nonlinear(std::size_t i) const {
    return list_->operations()[i].code != OperationCode::linear;
  }

  template <class Take>
  static void for_each_operand(const Operation& o, const Take& take) {
    switch (o.code) {
      case OperationCode::input:
        return;
      case OperationCode::linear:
        for (const LinearTerm& term : o.terms) take(term.value, T(convert<Real>(term.coefficient)));
        return;
      case OperationCode::product:
      case OperationCode::quotient:
      case OperationCode::angle:
        take(o.u, T(Real(0)));
        take(o.v, T(Real(0)));
        return;
      default:
        take(o.u, T(Real(0)));
    }
  }

  T& gradient_of(std::size_t value, std::size_t input) {
    return gradients_[value * list_->inputs() + input];
  }

  void set_values(const std::vector<bool>& is_operand) {
    std::vector<bool> is_output(scales_.size(), false);
    for (const std::size_t output : list_->outputs()) is_output[output] = true;
    for (std::size_t i = list_->inputs(); i < scales_.size(); ++i) {
      // A constant has no slices above degree 0.
      if (!is_nonlinear(i) && first_factor_[i] == first_factor_[i + 1]) continue;
      values_.push_back(i);
      if (is_operand[i] || !is_output[i]) intermediates_.push_back(i);
    }
  }

  void set_groups() {
    adjoints_.assign(whole_group * scales_.size(), T(Real(0)));
    std::vector<std::size_t> left;
    for (std::size_t o = 0; o < list_->outputs().size(); ++o) {
      if (!list_->is_affine(list_->outputs()[o])) left.push_back(o);
    }
    for (auto o = left.begin(); o != left.end();) {
      const bool is_whole = left.end() - o >= static_cast<std::ptrdiff_t>(whole_group);
      const auto end = o + (is_whole ? static_cast<std::ptrdiff_t>(whole_group) : 1);
      groups_.push_back(group_of({o, end}));
      o = end;
    }
  }

  Group group_of(std::vector<std::size_t> outputs) {
    Group group;
    group.outputs = std::move(outputs);
    group.first_weight = weights_.size();
    std::vector<bool> is_reached(scales_.size(), false);
    for (const std::size_t o : group.outputs) is_reached[list_->outputs()[o]] = true;
    for (std::size_t i = scales_.size(); i-- > list_->inputs();) {
      if (!is_reached[i]) continue;
      group.values.push_back(i);
      if (is_nonlinear(i)) group.sums.push_back(i);
      for (std::size_t f = first_factor_[i]; f < first_factor_[i + 1]; ++f) {
        is_reached[operands_[f]] = true;
      }
    }
    weights_.resize(weights_.size() + group.sums.size() * group.outputs.size());
    return group;
  }

  const OperationList* list_;
  std::vector<T> scales_;                  ///< by value
  std::vector<std::size_t> first_factor_;  ///< by value, and one entry for the end
  std::vector<std::size_t> operands_;
  std::vector<T> factors_;
  std::vector<std::size_t> values_;         ///< values that have slices, without the inputs
  std::vector<std::size_t> intermediates_;  ///< the values of these that are not mere outputs
  std::vector<Group> groups_;               ///< groups of the outputs that are not affine
  std::vector<T> weights_;
  std::vector<T> gradients_;  ///< by value and input
  std::vector<T> adjoints_;   ///< scratch space, by value and output of a group
};

}  // namespace hamjet
