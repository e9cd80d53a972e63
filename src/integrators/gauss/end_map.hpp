#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "stage_slopes.hpp"

namespace hamjet {

/// The increment of the coefficients of a degree in a step, computed without the slopes. For a
/// second-order system of unit mass, with F_d = R_d + Dg Y_d and Y_d = K R_d + B z_d (StageSystem),
///
///   dq_d = h p_d + h^2 sum b_i (1 - c_i) F_(d,i) ,   dp_d = h sum b_i F_(d,i) ,
///   dz_d = S z_d + T R_d .
///
/// Where forces are gradients, so that Dg is symmetric, T follows from B alone: a Gauss method
/// keeps the bilinear invariants of the linearised equations (Sanz-Serna, SIAM Review 58 (2016) 3,
/// section 2). Let B_i = (A_i, C_i) be the derivatives of the positions at stage i by the state,
/// Phi = I + S those of the end, and J = [[0, I], [-I, 0]]. For the change dz that forces R_i at
/// the stages cause, the invariant gives
///
///   Phi^T J dz = h sum b_i B_i^T R_i ,
///
/// and because Phi is symplectic,
///
///   T_i = h b_i Phi (-C_i, A_i)^T .
///
/// The 2m rows of S and T stand side by side as lanes. A monomial takes 2m + m s multiply-adds of
/// packs and no sums over lanes.
template <class Real, int Lanes>
class EndMap {
 public:
  using P = Pack<Real, Lanes>;

  /// Whether an integration can treat its degrees above 0 in this way. With up to two variables
  /// these are iterated instead, without B. Order 1 gains nothing, but is treated alike to have the
  /// same bits as all other orders.
  static bool serves(const StageSystem<Real, Lanes>& system, const SeriesSpace& space, int order) {
    const bool is_possible =
        system.second_order() && system.unit_mass() && 2 * system.components() <= Lanes;
    return is_possible && order >= 1 && space.variables() > 2;
  }

  /// Forms S and, if there are remainders, T from the present stages. StageSlopes::factorise must
  /// have been called with Response::for_end_map (with B alone if there are no remainders).
  void form(const StageSlopes<Real, Lanes>& stages, bool has_remainders) {
    form_gradients(stages);
    const StageSystem<Real, Lanes>& system = stages.system();
    const std::size_t m = system.components();
    of_state_.resize(2 * m);
    sum_columns(&system.base_response(0, 0), m, system.stages(), of_state_);
    for (std::size_t c = 0; c < m; ++c) add_to_lane(of_state_[m + c], c, system.step());
    of_remainders_.resize(has_remainders ? m * system.stages() : 0);
    if (!has_remainders) return;
    if (system.end_follows_from_base()) {
      form_by_symplecticity(system);
    } else {
      form_by_response(system);
    }
  }

  /// Calls `add(monomial, dz)` for all monomials of a degree. `state(component, monomial)` is the
  /// state's coefficient; it is not read after that call.
  template <class State, class Add>
  void apply(const SliceEvaluator<P, Real>& evaluator, const SeriesSpace& space, int degree,
             const State& state, const Add& add) const {
    const std::size_t last = space.first(degree + 1);
    std::size_t k = space.first(degree);
    for (; k + tile <= last; k += tile) apply_tile<tile>(evaluator, degree, k, state, add);
    for (; k < last; ++k) apply_tile<1>(evaluator, degree, k, state, add);
  }

 private:
  static constexpr std::size_t tile = StageSlopes<Real, Lanes>::tile;
  /// For an orbit, S has 6 columns, and T, where it is summed, 3 per stage.
  static constexpr std::size_t columns_at_once = 6;

  /// The derivatives of h^2 sum b_i (1 - c_i) F_i and h sum b_i F_i by the stages' components.
  void form_gradients(const StageSlopes<Real, Lanes>& stages) {
    const StageSystem<Real, Lanes>& system = stages.system();
    const std::size_t m = system.components();
    const std::size_t s = system.stages();
    const std::array<P, 2> weights = slope_weights(system);
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
  }

  static std::array<P, 2> slope_weights(const StageSystem<Real, Lanes>& system) {
    const Real& h = system.step();
    return {P(Real(h * h)) * system.position_weights(), P(h) * system.weights()};
  }

  void form_by_symplecticity(const StageSystem<Real, Lanes>& system) {
    const std::size_t m = system.components();
    const std::size_t s = system.stages();
    const P weights = slope_weights(system)[1];
    end_ = of_state_;
    for (std::size_t k = 0; k < 2 * m; ++k) add_to_lane(end_[k], k, Real(1));
    for (std::size_t from = 0; from < m; ++from) {
      for (std::size_t j = 0; j < s; ++j) of_remainders_[from * s + j] = P(Real(0));
      for (std::size_t k = 0; k < m; ++k) {
        const P by_position = weights * system.base_response(k, from);
        const P by_momentum = weights * system.base_response(m + k, from);
        for (std::size_t j = 0; j < s; ++j) {
          const auto lane = static_cast<int>(j);
          of_remainders_[from * s + j] +=
              end_[m + k] * P(by_position.lane(lane)) - end_[k] * P(by_momentum.lane(lane));
        }
      }
    }
  }

  void form_by_response(const StageSystem<Real, Lanes>& system) {
    const std::size_t m = system.components();
    const std::size_t s = system.stages();
    const std::array<P, 2> weights = slope_weights(system);
    sum_columns(&system.response(0, 0, 0), m, s, of_remainders_);
    for (std::size_t c = 0; c < m; ++c) {
      for (std::size_t j = 0; j < s; ++j) {
        for (std::size_t half = 0; half < 2; ++half) {
          add_to_lane(of_remainders_[c * s + j], half * m + c,
                      weights[half].lane(static_cast<int>(j)));
        }
      }
    }
  }

  static void add_to_lane(P& pack, std::size_t lane, const Real& x) {
    const auto i = static_cast<int>(lane);
    pack.set_lane(i, pack.lane(i) + x);
  }

  /// result_q = sum over k and i of gradients_(k, i) (columns_q)_(k, i), for columns of m packs
  /// over the stages.
  void sum_columns(const P* columns, std::size_t m, std::size_t s, std::vector<P>& result) const {
    std::size_t q = 0;
    for (; q + columns_at_once <= result.size(); q += columns_at_once) {
      sum_tile<columns_at_once>(columns + q * m, m, s, &result[q]);
    }
    for (; q < result.size(); ++q) sum_tile<1>(columns + q * m, m, s, &result[q]);
  }

  /// Several sums at once, because each of them waits for its own last addition.
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

  template <std::size_t Width, class State, class Add>
  void apply_tile(const SliceEvaluator<P, Real>& evaluator, int degree, std::size_t monomial,
                  const State& state, const Add& add) const {
    const std::size_t m = of_state_.size() / 2;
    const std::size_t s = of_remainders_.size() / m;  // the degree has remainders
    std::array<P, Width> sums;
    for (std::size_t k = 0; k < of_state_.size(); ++k) {
      const P& column = of_state_[k];
      for (std::size_t t = 0; t < Width; ++t) sums[t] += column * P(state(k, monomial + t));
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

  std::vector<P> gradients_;  ///< gradients of the rows' sums by the stages' components
  std::vector<P> of_state_;
  std::vector<P> of_remainders_;
  std::vector<P> end_;  ///< columns of Phi
};

}  // namespace hamjet
