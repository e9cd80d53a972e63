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
/// The scales and factors depend on constant terms alone, and operands that are numbers have no
/// slices. An output follows from the sums below it and the inputs x alone,
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
    for (const Operation& o : list.operations()) {
      first_factor_.push_back(operands_.size());
      for_each_factor(o, [&](std::size_t operand, const T& factor) {
        operands_.push_back(operand);
        factors_.push_back(factor);
      });
      // Numbers stand last.
      std::size_t end = operands_.size();
      while (end > first_factor_.back() && list.is_number(operands_[end - 1])) --end;
      end_factor_.push_back(end);
    }
    first_factor_.push_back(operands_.size());
    gradients_.assign(scales_.size() * list.variables(), T(Real(0)));
    for (std::size_t j = 0; j < list.variables(); ++j) gradient_of(j, j) = T(Real(1));
    if (working_order >= 2) set_groups(working_order);
    if (working_order >= 1) set_values();
  }

  /// The derivative of a value with respect to one of its operands. The caller writes it for all
  /// operations that are not linear.
  T& factor(std::size_t value, std::size_t operand) {
    return factors_[first_factor_[value] + operand];
  }
  /// The constant term of a sum, from those of its operands; value k stands at slices + k stride.
  T linear_value(std::size_t value, const Real& constant, const T* slices,
                 std::size_t stride) const {
    T sum(constant);
    for (std::size_t f = first_factor_[value]; f < first_factor_[value + 1]; ++f) {
      sum = add_product(sum, factors_[f], slices[operands_[f] * stride]);
    }
    return sum;
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
    const std::size_t variables = list_->variables();
    for (std::size_t i = list_->first_series_value(); i < scales_.size(); ++i) {
      const std::uint64_t mask = list_->dependencies(i);
      for (std::size_t j = 0; j < variables; ++j) {
        if ((mask >> j & 1) == 0) continue;
        T sum(Real(0));
        for (std::size_t f = first_factor_[i]; f < end_factor_[i]; ++f) {
          sum = add_product(sum, factors_[f], gradient_of(operands_[f], j));
        }
        gradient_of(i, j) = sum;
      }
    }
  }
  /// The derivative d output / d input at the inputs' constant terms, by a variable.
  const T& gradient(std::size_t output, std::size_t input) const {
    return gradients_[list_->outputs()[output] * list_->variables() + input];
  }

  /// Forms the weights from the factors and scales.
  void set_weights() {
    for (const Group& group : groups_) {
      with_width(group, [&]<std::size_t Outputs>(Width<Outputs>) { set_weights<Outputs>(group); });
    }
  }

  /// Forms the remainders of degree d of the outputs that have one from the sums, for the monomials
  /// from `first` to `last`. Value i stands at slices + i stride, and the remainder of output o at
  /// remainders + o stride.
  void form_remainders(int d, const T* slices, std::size_t stride, std::size_t first,
                       std::size_t last, T* remainders) const {
    in_tiles(first, last, [&]<std::size_t Monomials>(Width<Monomials>, std::size_t k) {
      for (const Group& group : groups_) {
        with_width(group, [&]<std::size_t Outputs>(Width<Outputs>) {
          std::array<std::array<T, Monomials>, Outputs> sums{};
          const T* weight = weights_.data() + group.first_weight;
          const std::size_t* const end =
              group.sums.data() + group.counts[static_cast<std::size_t>(d)];
          for (const std::size_t* i = group.sums.data(); i != end; ++i) {
            const T* const s = slices + *i * stride + k;
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
  /// Does what complete_values does, for those values alone that sums of higher degrees need.
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
        for (std::size_t j = 0; j < list_->variables(); ++j) {
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
    /// The operations with sums among these values: those that begin at low degrees first, and
    /// otherwise the later ones.
    std::vector<std::size_t> sums;
    std::vector<std::size_t> counts;  ///< by degree, how many of the sums it has
    std::vector<std::size_t> places;  ///< by value of the group, its place in `sums`
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
        if (has_sums && list_->has_sums(i)) {
          for (std::size_t t = 0; t < Monomials; ++t) sums[t] = scales_[i] * w[t];
        }
        for (std::size_t f = first_factor_[i]; f < end_factor_[i]; ++f) {
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
    for (std::size_t j = 0; j < list_->variables(); ++j) set_zeros(j);
    for (std::size_t w = 0; w < Outputs; ++w) {
      adjoints_[list_->outputs()[group.outputs[w]] * Outputs + w] = T(Real(1));
    }
    T* const weights = weights_.data() + group.first_weight;
    const std::size_t* place = group.places.data();
    for (const std::size_t i : group.values) {
      const T* const adjoint = &adjoints_[i * Outputs];
      for (std::size_t f = first_factor_[i]; f < end_factor_[i]; ++f) {
        T* const sums = &adjoints_[operands_[f] * Outputs];
        for (std::size_t w = 0; w < Outputs; ++w) {
          sums[w] = add_product(sums[w], adjoint[w], factors_[f]);
        }
      }
      if (!list_->has_sums(i)) continue;
      T* const weight = weights + *place++ * Outputs;
      for (std::size_t w = 0; w < Outputs; ++w) weight[w] = adjoint[w] * scales_[i];
    }
  }

  template <class Take>
  static void for_each_factor(const Operation& o, const Take& take) {
    switch (o.code) {
      case OperationCode::input:
      case OperationCode::deviation_product:
        return;
      case OperationCode::linear:
      case OperationCode::field:
        for (const LinearTerm& term : o.terms) take(term.value, T(convert<Real>(term.coefficient)));
        return;
      default:
        for_each_operand(o, [&](std::size_t operand) { take(operand, T(Real(0))); });
    }
  }

  T& gradient_of(std::size_t value, std::size_t input) {
    return gradients_[value * list_->variables() + input];
  }

  void set_values() {
    // The slices of a value are needed by the outputs, or by sums of higher degrees: those of its
    // products, or its own where it is no mere product.
    std::vector<bool> is_output_part(scales_.size(), false);
    std::vector<bool> is_needed(scales_.size(), false);
    for (const std::size_t output : list_->outputs()) is_output_part[output] = true;
    for (std::size_t i = scales_.size(); i-- > list_->inputs();) {
      const Operation& o = list_->operations()[i];
      if (list_->has_sums(i)) {
        if (o.code == OperationCode::field) {
          for (const LinearTerm& term : o.terms) is_needed[term.value] = true;
          for (const FieldProduct& product : o.products) is_needed[product.factor] = true;
        } else {
          for_each_operand(o, [&](std::size_t operand) { is_needed[operand] = true; });
        }
        const bool is_product = o.code == OperationCode::product ||
                                o.code == OperationCode::square || o.code == OperationCode::field ||
                                o.code == OperationCode::deviation_product;
        if (!is_product) is_needed[i] = true;
      }
      for (std::size_t f = first_factor_[i]; f < end_factor_[i]; ++f) {
        if (is_output_part[i]) is_output_part[operands_[f]] = true;
        if (is_needed[i]) is_needed[operands_[f]] = true;
      }
    }
    for (std::size_t i = list_->inputs(); i < scales_.size(); ++i) {
      if (list_->is_number(i)) continue;
      if (is_needed[i] || is_output_part[i]) values_.push_back(i);
      if (is_needed[i]) intermediates_.push_back(i);
    }
  }

  void set_groups(int working_order) {
    adjoints_.assign(whole_group * scales_.size(), T(Real(0)));
    std::vector<std::size_t> left;
    for (std::size_t o = 0; o < list_->outputs().size(); ++o) {
      if (!list_->is_affine(list_->outputs()[o])) left.push_back(o);
    }
    for (auto o = left.begin(); o != left.end();) {
      const bool is_whole = left.end() - o >= static_cast<std::ptrdiff_t>(whole_group);
      const auto end = o + (is_whole ? static_cast<std::ptrdiff_t>(whole_group) : 1);
      groups_.push_back(group_of({o, end}, working_order));
      o = end;
    }
  }

  Group group_of(std::vector<std::size_t> outputs, int working_order) {
    Group group;
    group.outputs = std::move(outputs);
    group.first_weight = weights_.size();
    std::vector<bool> is_reached(scales_.size(), false);
    for (const std::size_t o : group.outputs) is_reached[list_->outputs()[o]] = true;
    std::vector<std::size_t> sums;
    for (std::size_t i = scales_.size(); i-- > list_->inputs();) {
      if (!is_reached[i]) continue;
      group.values.push_back(i);
      if (list_->has_sums(i)) sums.push_back(i);
      for (std::size_t f = first_factor_[i]; f < end_factor_[i]; ++f) {
        is_reached[operands_[f]] = true;
      }
    }
    group.counts.assign(static_cast<std::size_t>(working_order) + 1, 0);
    group.places.resize(sums.size());
    for (int d = 2; d <= working_order; ++d) {
      for (std::size_t k = 0; k < sums.size(); ++k) {
        if (std::max(lowest_degree(sums[k]), 2) != d) continue;
        group.places[k] = group.sums.size();
        group.sums.push_back(sums[k]);
      }
      group.counts[static_cast<std::size_t>(d)] = group.sums.size();
    }
    weights_.resize(weights_.size() + group.sums.size() * group.outputs.size());
    return group;
  }

  /// The lowest degree in which an operation has sums.
  int lowest_degree(std::size_t i) const {
    const Operation& o = list_->operations()[i];
    return o.code == OperationCode::deviation_product ? o.lowest[0] + o.lowest[1] : 2;
  }

  const OperationList* list_;
  std::vector<T> scales_;                  ///< by value
  std::vector<std::size_t> first_factor_;  ///< by value, and one entry for the end
  std::vector<std::size_t> end_factor_;    ///< by value, behind its last operand that has slices
  std::vector<std::size_t> operands_;
  std::vector<T> factors_;
  std::vector<std::size_t> values_;         ///< values that have slices, without the inputs
  std::vector<std::size_t> intermediates_;  ///< the values of these that sums need
  std::vector<Group> groups_;               ///< groups of the outputs that are not affine
  std::vector<T> weights_;
  std::vector<T> gradients_;  ///< by value and input
  std::vector<T> adjoints_;   ///< scratch space, by value and output of a group
};

}  // namespace hamjet
