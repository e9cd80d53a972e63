#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "stage_slopes.hpp"

namespace hamjet {

/// What a step adds to the coefficients of the highest degree d, whose stages nothing needs: for a
/// second-order system of unit mass, with F_d = R_d + Dg Y_d and Y_d = K R_d + B z_d (StageSystem),
///
///   dq_d = h p_d + h^2 sum b_i (1 - c_i) F_(d,i) ,   dp_d = h sum b_i F_(d,i) ,
///   dz_d = S z_d + T R_d .
///
/// The 2m rows of S and T stand side by side as lanes. A monomial takes 2m + m s multiply-adds of
/// packs, where its stages take m times as many, its slopes some more, and each row a sum over the
/// lanes. T costs what m s monomials do, so that it pays for degrees of many.
template <class Real, int Lanes>
class EndMap {
 public:
  using P = Pack<Real, Lanes>;

  /// Whether the highest degree of an integration can be taken so, and is worth it.
  static bool serves(const StageSystem<Real, Lanes>& system, const SeriesSpace& space, int order) {
    const bool is_possible =
        system.second_order() && system.unit_mass() && 2 * system.components() <= Lanes;
    return is_possible && order >= 2 && space.count(order) >= least_monomials;
  }

  /// Forms S and T from K and B of the stages as they stand (StageSlopes::factorise).
  void form(const StageSlopes<Real, Lanes>& stages) {
    const StageSystem<Real, Lanes>& system = stages.system();
    const std::size_t m = system.components();
    const std::size_t s = system.stages();
    const Real& h = system.step();
    const std::array<P, 2> weights = {P(Real(h * h)) * system.position_weights(),
                                      P(h) * system.weights()};
    gradients_.assign(m * s, P(Real(0)));
    for (std::size_t half = 0; half < 2; ++half) {
      for (std::size_t c = 0; c < m; ++c) {
        for (std::size_t k = 0; k < m; ++k) {
          const P weighted = weights[half] * stages.slope_gradient(c, k);
          for (std::size_t i = 0; i < s; ++i) {
            gradients_[k * s + i].set_lane(static_cast<int>(half * m + c),
                                           weighted.lane(static_cast<int>(i)));
          }
        }
      }
    }
    of_remainders_.resize(m * s);
    sum_columns(&system.response(0, 0, 0), m, s, of_remainders_);
    of_state_.resize(2 * m);
    sum_columns(&system.base_response(0, 0), m, s, of_state_);
    for (std::size_t c = 0; c < m; ++c) {
      add_to_lane(of_state_[m + c], c, h);
      for (std::size_t j = 0; j < s; ++j) {
        for (std::size_t half = 0; half < 2; ++half) {
          add_to_lane(of_remainders_[c * s + j], half * m + c,
                      weights[half].lane(static_cast<int>(j)));
        }
      }
    }
  }

  /// Calls `add(monomial, dz)` for all monomials of a degree; `state[k]` points to the coefficients
  /// of the k-th component, of which those of a monomial are not read after its call.
  template <class Add>
  void apply(const SliceEvaluator<P, Real>& evaluator, const SeriesSpace& space, int degree,
             const std::vector<const Real*>& state, const Add& add) const {
    const std::size_t last = space.first(degree + 1);
    std::size_t k = space.first(degree);
    for (; k + tile <= last; k += tile) apply_tile<tile>(evaluator, degree, k, state, add);
    for (; k < last; ++k) apply_tile<1>(evaluator, degree, k, state, add);
  }

 private:
  /// From which on less is computed than for the stages of a degree; in up to two variables these
  /// are iterated for, without a factorisation.
  static constexpr std::size_t least_monomials = 30;

  static constexpr std::size_t tile = StageSlopes<Real, Lanes>::tile;
  /// Of an orbit there are 6 and multiples of 6.
  static constexpr std::size_t columns_at_once = 6;

  static void add_to_lane(P& pack, std::size_t lane, const Real& x) {
    const auto i = static_cast<int>(lane);
    pack.set_lane(i, pack.lane(i) + x);
  }

  /// result_q = sum over k and i of gradients_(k, i) (columns_q)_(k, i), of columns of m packs over
  /// the stages.
  void sum_columns(const P* columns, std::size_t m, std::size_t s, std::vector<P>& result) const {
    std::size_t q = 0;
    for (; q + columns_at_once <= result.size(); q += columns_at_once) {
      sum_tile<columns_at_once>(columns + q * m, m, s, &result[q]);
    }
    for (; q < result.size(); ++q) sum_tile<1>(columns + q * m, m, s, &result[q]);
  }

  /// Several sums at once do not wait for one another.
  template <std::size_t Width>
  void sum_tile(const P* columns, std::size_t m, std::size_t s, P* result) const {
    std::array<P, Width> sums;
    for (std::size_t k = 0; k < m; ++k) {
      for (std::size_t i = 0; i < s; ++i) {
        const P& gradient = gradients_[k * s + i];
        for (std::size_t q = 0; q < Width; ++q) {
          sums[q] += gradient * P(columns[q * m + k].lane(static_cast<int>(i)));
        }
      }
    }
    for (std::size_t q = 0; q < Width; ++q) result[q] = sums[q];
  }

  template <std::size_t Width, class Add>
  void apply_tile(const SliceEvaluator<P, Real>& evaluator, int degree, std::size_t monomial,
                  const std::vector<const Real*>& state, const Add& add) const {
    const std::size_t m = state.size() / 2;
    const std::size_t s = of_remainders_.size() / m;
    std::array<P, Width> sums;
    for (std::size_t k = 0; k < state.size(); ++k) {
      const P& column = of_state_[k];
      for (std::size_t t = 0; t < Width; ++t) sums[t] += column * P(state[k][monomial + t]);
    }
    for (std::size_t from = 0; from < m; ++from) {
      if (!evaluator.has_remainder(from, degree)) continue;
      const P* r = evaluator.remainder(from) + monomial;
      for (std::size_t j = 0; j < s; ++j) {
        const P& column = of_remainders_[from * s + j];
        for (std::size_t t = 0; t < Width; ++t) {
          sums[t] += column * P(r[t].lane(static_cast<int>(j)));
        }
      }
    }
    for (std::size_t t = 0; t < Width; ++t) add(monomial + t, sums[t]);
  }

  std::vector<P> gradients_;  ///< of the rows' sums by the stages' components
  std::vector<P> of_state_;
  std::vector<P> of_remainders_;
};

}  // namespace hamjet
