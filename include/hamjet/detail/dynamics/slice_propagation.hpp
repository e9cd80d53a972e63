#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// How the slices of one degree of an operation list's values hang together, which is linear. With
/// s the sums that the nonlinear operations have formed from the slices below
/// (slice_recurrences.hpp),
///
///   v_d = scale s + sum over the operands u of factor u_d .
///
/// The scales and factors are made of constant terms. An output follows from the sums below it
/// and the inputs x alone,
///
///   y_d = sum weight s + grad y . x_d ,
///
/// so that nothing in between is needed for it; weights and gradients are found backwards through
/// the list (the reverse mode of Griewank and Walther, Evaluating Derivatives, section 3.2). T and
/// Real are as in SliceEvaluator.
template <class T, class Real>
class SlicePropagation {
 public:
  /// The list must outlive this object.
  explicit SlicePropagation(const OperationList& list)
      : list_(&list), scales_(list.operations().size(), T(Real(1))) {
    std::vector<bool> is_operand(scales_.size(), false);
    for (const Operation& o : list.operations()) {
      first_factor_.push_back(operands_.size());
      for_each_operand(o, [&](std::size_t operand, const T& factor) {
        operands_.push_back(operand);
        factors_.push_back(factor);
        is_operand[operand] = true;
      });
    }
    first_factor_.push_back(operands_.size());
    gradients_.assign(list.outputs().size() * list.inputs(), T(Real(0)));
    std::vector<bool> is_formed_as_output(scales_.size(), false);
    for (const std::size_t output : list.outputs()) {
      is_formed_as_output[output] = !list.is_affine(output);
    }
    for (std::size_t o = 0; o < list.outputs().size();) {
      const bool is_whole = o + whole_group <= list.outputs().size();
      groups_.push_back(group_of(o, is_whole ? whole_group : 1));
      o += groups_.back().outputs;
    }
    adjoints_.assign(whole_group * scales_.size(), T(Real(0)));
    for (std::size_t i = list.inputs(); i < scales_.size(); ++i) {
      const bool has_terms = is_nonlinear(i) || first_factor_[i] != first_factor_[i + 1];
      if (has_terms && (is_operand[i] || !is_formed_as_output[i])) intermediates_.push_back(i);
    }
  }

  /// The derivative of a value by one of its operands, to be written by the caller for all but
  /// linear operations.
  T& factor(std::size_t value, std::size_t operand) {
    return factors_[first_factor_[value] + operand];
  }
  /// The scale of a nonlinear operation's sums, 1 unless the caller writes another.
  T& scale(std::size_t value) { return scales_[value]; }

  /// sum + a b, fused wherever that is fast: left to the compiler, fusing may differ from one
  /// inlined copy to the next, and a nominal alone would have other last bits than the same nominal
  /// with its jet.
  static T add_product(const T& sum, const T& a, const T& b) {
#ifdef __FP_FAST_FMA
    if constexpr (std::is_same_v<T, double>) return std::fma(a, b, sum);
#endif
    return sum + a * b;
  }

  /// Forms gradients, and weights if they are needed, from the factors and scales.
  void differentiate(bool needs_weights) {
    for (const Group& group : groups_) {
      with_width(group, [&]<std::size_t Outputs>(Width<Outputs>) {
        differentiate<Outputs>(group, needs_weights);
      });
    }
  }

  /// The derivative d output / d input at the inputs' constant terms.
  const T& gradient(std::size_t output, std::size_t input) const {
    const std::size_t whole = list_->outputs().size() / whole_group * whole_group;
    const std::size_t width = output < whole ? whole_group : 1;
    const std::size_t place = output % width;
    return gradients_[(output - place) * list_->inputs() + input * width + place];
  }

  /// Forms the outputs' part that the sums make, for monomials from `first` to `last`: the value i
  /// stands at slices + i stride, that of an output o at remainders + o stride.
  void form_remainders(const T* slices, std::size_t stride, std::size_t first, std::size_t last,
                       T* remainders) const {
    for_each_tile(first, last,
                  [&]<std::size_t Outputs, std::size_t Monomials>(
                      Width<Outputs>, Width<Monomials>, const Group& group, std::size_t k) {
                    Sums<Outputs, Monomials> sums{};
                    const T* weight = weights_.data() + group.first_weight;
                    for (const std::size_t i : group.sums) {
                      add<Outputs, Monomials>(weight, slices + i * stride + k, sums);
                      weight += Outputs;
                    }
                    for (std::size_t w = 0; w < Outputs; ++w) {
                      put(sums[w], remainders + (group.first + w) * stride + k);
                    }
                  });
  }

  /// Puts the values in the place of the sums (if there are any at this degree), for monomials from
  /// `first` to `last` of known inputs, of all operations but those that are outputs alone.
  void complete_intermediates(T* slices, std::size_t stride, std::size_t first, std::size_t last,
                              bool has_sums) const {
    in_tiles(first, last, [&]<std::size_t Monomials>(Width<Monomials>, std::size_t k) {
      for (const std::size_t i : intermediates_) {
        T* const w = slices + i * stride + k;
        std::array<T, Monomials> sums{};
        if (has_sums && is_nonlinear(i)) {
          for (std::size_t t = 0; t < Monomials; ++t) sums[t] = scales_[i] * w[t];
        }
        for (std::size_t f = first_factor_[i]; f < first_factor_[i + 1]; ++f) {
          const T& factor = factors_[f];
          const T* const u = slices + operands_[f] * stride + k;
          for (std::size_t t = 0; t < Monomials; ++t) sums[t] += factor * u[t];
        }
        put(sums, w);
      }
    });
  }

  /// Forms the outputs but for those that are inputs, for monomials from `first` to `last` of known
  /// inputs, from their remainders (if there are sums at this degree).
  void complete_outputs(T* slices, std::size_t stride, std::size_t first, std::size_t last,
                        const T* remainders, bool has_sums) const {
    const std::size_t inputs = list_->inputs();
    for_each_tile(first, last,
                  [&]<std::size_t Outputs, std::size_t Monomials>(
                      Width<Outputs>, Width<Monomials>, const Group& group, std::size_t k) {
                    Sums<Outputs, Monomials> sums{};
                    for (std::size_t w = 0; has_sums && w < Outputs; ++w) {
                      const T* const remainder = remainders + (group.first + w) * stride + k;
                      for (std::size_t t = 0; t < Monomials; ++t) sums[w][t] = remainder[t];
                    }
                    const T* gradient = gradients_.data() + group.first * inputs;
                    for (std::size_t j = 0; j < inputs; ++j) {
                      add<Outputs, Monomials>(gradient, slices + j * stride + k, sums);
                      gradient += Outputs;
                    }
                    for (std::size_t w = 0; w < Outputs; ++w) {
                      const std::size_t output = list_->outputs()[group.first + w];
                      if (output >= inputs) put(sums[w], slices + output * stride + k);
                    }
                  });
  }

 private:
  /// Outputs that are formed together, for each step backwards waits for the one before.
  struct Group {
    std::size_t first = 0;
    std::size_t outputs = 0;
    std::vector<std::size_t> values;  ///< that they depend on, but the inputs, the later first
    std::vector<std::size_t> sums;    ///< the nonlinear operations among them
    std::size_t first_weight = 0;     ///< a weight for each sum and output
  };
  static constexpr std::size_t whole_group = 3;

  template <std::size_t>
  struct Width {};
  template <std::size_t Outputs, std::size_t Monomials>
  using Sums = std::array<std::array<T, Monomials>, Outputs>;
  /// So many monomials go through the list together: their slices stay in the nearest cache, and
  /// their sums for a group of outputs in registers.
  static constexpr std::size_t tile = sizeof(T) >= 512 ? 1 : sizeof(T) > 64 ? 512 / sizeof(T) : 8;

  template <class Run>
  static void in_tiles(std::size_t first, std::size_t last, const Run& run) {
    for (; first + tile <= last; first += tile) run(Width<tile>{}, first);
    // Of two lines a degree has two monomials.
    if constexpr (tile > 2) {
      for (; first + 2 <= last; first += 2) run(Width<2>{}, first);
    }
    for (; first < last; ++first) run(Width<1>{}, first);
  }
  template <class Run>
  static void with_width(const Group& group, const Run& run) {
    group.outputs == whole_group ? run(Width<whole_group>{}) : run(Width<1>{});
  }
  template <class Run>
  void for_each_tile(std::size_t first, std::size_t last, const Run& run) const {
    in_tiles(first, last, [&]<std::size_t Monomials>(Width<Monomials> monomials, std::size_t k) {
      for (const Group& group : groups_) {
        with_width(group, [&]<std::size_t Outputs>(Width<Outputs> outputs) {
          run(outputs, monomials, group, k);
        });
      }
    });
  }

  template <std::size_t Count>
  static void put(const std::array<T, Count>& values, T* target) {
    for (std::size_t t = 0; t < Count; ++t) target[t] = values[t];
  }
  /// sums_(w, t) += factors_w series_t.
  template <std::size_t Outputs, std::size_t Monomials>
  static void add(const T* factors, const T* series, Sums<Outputs, Monomials>& sums) {
    for (std::size_t t = 0; t < Monomials; ++t) {
      for (std::size_t w = 0; w < Outputs; ++w) sums[w][t] += factors[w] * series[t];
    }
  }

  template <std::size_t Outputs>
  void differentiate(const Group& group, bool needs_weights) {
    const auto zeros_at = [&](std::size_t i) {
      std::fill_n(&adjoints_[i * Outputs], Outputs, T(Real(0)));
    };
    for (const std::size_t i : group.values) zeros_at(i);
    for (std::size_t j = 0; j < list_->inputs(); ++j) zeros_at(j);
    for (std::size_t w = 0; w < Outputs; ++w) {
      adjoints_[list_->outputs()[group.first + w] * Outputs + w] = T(Real(1));
    }
    T* weight = weights_.data() + group.first_weight;
    for (const std::size_t i : group.values) {
      std::array<T, Outputs> adjoint;
      std::copy_n(&adjoints_[i * Outputs], Outputs, adjoint.begin());
      for (std::size_t f = first_factor_[i]; f < first_factor_[i + 1]; ++f) {
        T* const sums = &adjoints_[operands_[f] * Outputs];
        for (std::size_t w = 0; w < Outputs; ++w) {
          sums[w] = add_product(sums[w], adjoint[w], factors_[f]);
        }
      }
      if (!needs_weights || !is_nonlinear(i)) continue;
      for (std::size_t w = 0; w < Outputs; ++w) *weight++ = adjoint[w] * scales_[i];
    }
    // Those of the inputs are the gradients; a group's stand as its outputs' beside each other.
    std::copy_n(adjoints_.data(), list_->inputs() * Outputs,
                &gradients_[group.first * list_->inputs()]);
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
        take(o.u, T(Real(0)));
        take(o.v, T(Real(0)));
        return;
      default:
        take(o.u, T(Real(0)));
    }
  }

  Group group_of(std::size_t first, std::size_t outputs) {
    Group group;
    group.first = first;
    group.outputs = outputs;
    group.first_weight = weights_.size();
    std::vector<bool> is_reached(scales_.size(), false);
    for (std::size_t o = first; o < first + outputs; ++o) is_reached[list_->outputs()[o]] = true;
    for (std::size_t i = scales_.size(); i-- > list_->inputs();) {
      if (!is_reached[i]) continue;
      group.values.push_back(i);
      if (is_nonlinear(i)) group.sums.push_back(i);
      for (std::size_t f = first_factor_[i]; f < first_factor_[i + 1]; ++f) {
        is_reached[operands_[f]] = true;
      }
    }
    weights_.resize(weights_.size() + group.sums.size() * outputs);
    return group;
  }

  const OperationList* list_;
  std::vector<T> scales_;                  ///< by value
  std::vector<std::size_t> first_factor_;  ///< by value, and the end
  std::vector<std::size_t> operands_;
  std::vector<T> factors_;
  std::vector<std::size_t> intermediates_;
  std::vector<Group> groups_;
  std::vector<T> weights_;
  std::vector<T> gradients_;  ///< by group, input and output of the group
  std::vector<T> adjoints_;   ///< scratch
};

}  // namespace hamjet
