#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "../real_number.hpp"
#include "component_units.hpp"
#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "stage_coefficients.hpp"
#include "stage_elimination.hpp"

namespace hamjet {

/// Whether K, see StageSystem, is formed beside B. `for_end_map` forms K only if the end map does
/// not follow from B.
enum class Response { left_out, for_end_map, formed };

/// The linear system of the stage equations of one step, and its solution operator.
///
/// The unknowns are m components Y_c, each a pack over the stages i, with
///
///   Y = base + (W (x) I) G,   G_j = g(Y_j),
///
/// where for a general system Y = z, g = z', W = h A and base_i = z_n; and for a second-order
/// system Y = q, g = M^-1 F(q), W = h^2 A^2 and base_i = q_n + h c_i M^-1 p_n (p is eliminated).
/// One linearisation serves Newton's iteration and every monomial of every degree:
///
///   (I - W (x) Dg) Y_d = base_d + W R_d   =>   Y_d = K R_d + B z_d .
///
/// K and B are stored as packs over the output stage i, so that applying them to a monomial is a
/// sequence of broadcast multiply-adds.
template <class Real, int Lanes>
class StageSystem {
 public:
  using P = Pack<Real, Lanes>;

  StageSystem(const DynamicalSystem& system, const GaussTableau& tableau)
      : stages_(tableau.stages),
        second_order_(system.second_order.has_value()),
        components_(second_order_ ? system.degrees_of_freedom : system.dimension()),
        state_size_(system.dimension()),
        coefficients_(StageCoefficients<Real, Lanes>::of(tableau)),
        coupling_(second_order_ ? coefficients_.squared : coefficients_.matrix),
        units_(system),
        inverse_units_(components_, Real(1)),
        elimination_(components_, stages_) {
    if (second_order_) {
      for (const Extended& x : system.second_order->inverse_mass) {
        inverse_mass_.push_back(convert<Real>(x));
      }
      for (std::size_t c = 0; c < components_; ++c) {
        for (std::size_t k = 0; k < components_; ++k) {
          if (inverse_mass(c, k) != Real(c == k ? 1 : 0)) unit_mass_ = false;
        }
      }
    }
    response_.resize(components_ * stages_ * components_);
    base_.resize(state_size_ * components_);
  }

  std::size_t stages() const { return stages_; }
  std::size_t components() const { return components_; }
  std::size_t state_size() const { return state_size_; }
  bool second_order() const { return second_order_; }
  bool unit_mass() const { return unit_mass_; }
  const Real& inverse_mass(std::size_t c, std::size_t k) const {
    return inverse_mass_[c * components_ + k];
  }
  const StageCoefficients<Real, Lanes>& coefficients() const { return coefficients_; }
  const P& weights() const { return coefficients_.weights.value; }
  const P& nodes() const { return coefficients_.nodes.value; }
  const P& position_weights() const { return coefficients_.position_weights.value; }
  const P& weights_lost() const { return coefficients_.weights.lost; }
  const P& position_weights_lost() const { return coefficients_.position_weights.lost; }

  void set_step(const Real& h) {
    step_ = h;
    scale_ = second_order_ ? Real(h * h) : h;
  }
  const Real& step() const { return step_; }

  /// The sum over j of W_ij G_j, for one component.
  P couple(const P& slopes) const {
    // Four partial sums, because each addition waits for the one before.
    std::array<P, 4> sums;
    for (P& sum : sums) sum = P(Real(0));
    std::size_t j = 0;
    for (; j + 4 <= stages_; j += 4) {
      for (std::size_t k = 0; k < 4; ++k) {
        sums[k] += coupling_[j + k].value * P(slopes.lane(static_cast<int>(j + k)));
      }
    }
    for (; j < stages_; ++j) sums[0] += coupling_[j].value * P(slopes.lane(static_cast<int>(j)));
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) * P(scale_);
  }

  /// Several sums side by side, so that they do not wait for one another.
  template <std::size_t Count>
  void couple(const std::array<P, Count>& slopes, std::array<P, Count>& sums) const {
    std::array<P, Count> added = [&]<std::size_t... I>(std::index_sequence<I...>) {
      return std::array<P, Count>{coupling_[0].value * P(slopes[I].lane(0))...};
    }
    (std::make_index_sequence<Count>{});
    for (std::size_t j = 1; j < stages_; ++j) {
      const P& column = coupling_[j].value;
      for (std::size_t i = 0; i < Count; ++i) {
        added[i] += column * P(slopes[i].lane(static_cast<int>(j)));
      }
    }
    for (std::size_t i = 0; i < Count; ++i) sums[i] = added[i] * P(scale_);
  }

  /// The contribution of the coefficients' rounding residues to base + couple. The rounded
  /// coefficients alone are those of a method that is neither symplectic nor symmetric to the last
  /// digit. With them the energy drifts with time, where random rounding would only make it wander
  /// (Hairer, McLachlan and Razakarivony, Achieving Brouwer's law with implicit Runge-Kutta
  /// methods, BIT 48 (2008) 231).
  template <class State>
  P lost(std::size_t c, const State& state, const P& slopes) const {
    P sum(Real(0));
    for (std::size_t j = 0; j < stages_; ++j) {
      sum += coupling_[j].lost * P(slopes.lane(static_cast<int>(j)));
    }
    sum *= P(scale_);
    if (second_order_) sum += P(Real(step_ * velocity(c, state))) * coefficients_.nodes.lost;
    return sum;
  }

  /// The term base for one component, from the state's coefficients of one monomial.
  template <class State>
  P base(std::size_t c, const State& state) const {
    if (!second_order_) return P(state(c));
    return P(state(c)) + P(Real(step_ * velocity(c, state))) * nodes();
  }

  /// The block K_(c, (from, stage)) as a pack over the stages of component c.
  const P& response(std::size_t from, std::size_t stage, std::size_t c) const {
    return response_[(from * stages_ + stage) * components_ + c];
  }
  /// The block B_(c, k), where k is an index into the state.
  const P& base_response(std::size_t k, std::size_t c) const { return base_[k * components_ + c]; }

  /// Forms B and, if asked for, K from the slopes' gradients Dg_(c, from), packs over the stages,
  /// whose 1 / sigma is given (ComponentUnits).
  /// Returns false if the matrix is singular or not finite.
  template <class Gradient>
  bool factorise(const Gradient& gradient, const Real& inverse_sigma, Response response) {
    for (std::size_t c = 0; c < units_.count(); ++c) {
      inverse_units_[c] = units_.inverse_unit(c, inverse_sigma);
    }
    const bool is_dominant = has_dominant_diagonal(gradient);
    end_follows_from_base_ =
        response != Response::left_out && is_dominant && is_symmetric(gradient);
    const bool has_response = response == Response::formed ||
                              (response == Response::for_end_map && !end_follows_from_base_);
    fill(gradient, has_response);
    const std::span<P> response_columns(response_.data(), has_response ? response_.size() : 0);
    return elimination_.solve({response_columns, base_}, is_dominant, inverse_units_);
  }
  /// Whether the effect of forces at the stages on the end of the step follows from B, see EndMap,
  /// for the matrix that was last factorised for remainders. This is so if Dg is symmetric, as for
  /// forces that are gradients, and if the matrix is dominated by its diagonal, so that B has no
  /// larger rounding errors than K.
  bool end_follows_from_base() const { return end_follows_from_base_; }

 private:
  /// The velocity (M^-1 p)_c of a second-order system.
  template <class State>
  Real velocity(std::size_t c, const State& state) const {
    if (unit_mass_) return state(components_ + c);
    Real sum(0);
    for (std::size_t k = 0; k < components_; ++k) {
      sum += inverse_mass(c, k) * state(components_ + k);
    }
    return sum;
  }

  /// Whether the magnitudes of every row of W (x) Dg, in ComponentUnits, add up to at most 1/2, as
  /// in all steps that converge well. Parameters are at rest: their columns are those of the
  /// identity but for what they add to other rows, and need no pivots. The matrix I - W (x) Dg is
  /// then dominated by its diagonal, by at least 1/2 in every row. So is the rest of the matrix
  /// after some pivots, whose blocks have inverses of at most 2 in the maximum norm (Varah, Linear
  /// Algebra Appl. 11 (1975) 3). Elimination needs no pivoting, not even by blocks (Higham,
  /// Accuracy and Stability of Numerical Algorithms, 2nd ed., theorem 9.9 and sections 13.3
  /// and 14.4). Returns false if a number is not finite.
  template <class Gradient>
  bool has_dominant_diagonal(const Gradient& gradient) const {
    P largest(Real(0));
    for (std::size_t c = 0; c < units_.count(); ++c) {
      P sum(Real(0));
      P entries(Real(0));
      for (std::size_t from = 0; from < units_.count(); ++from) {
        entries += larger_magnitude(
            P(Real(0)), gradient(c, from) * P(Real(inverse_units_[c] / inverse_units_[from])));
      }
      for (std::size_t j = 0; j < stages_; ++j) {
        sum +=
            larger_magnitude(P(Real(0)), coupling_[j].value) * P(entries.lane(static_cast<int>(j)));
      }
      largest = larger_magnitude(largest, sum * P(scale_));
    }
    return largest_magnitude(largest) <= Real(0.5);
  }

  /// Whether Dg is symmetric at all stages, apart from rounding; a relative asymmetry enters the
  /// end of the step with the same size. A field need not be a gradient: a field that is scaled by
  /// one of its own variables is not.
  template <class Gradient>
  bool is_symmetric(const Gradient& gradient) const {
    P largest(Real(0));
    P difference(Real(0));
    for (std::size_t c = 0; c < components_; ++c) {
      largest = larger_magnitude(largest, gradient(c, c));
      for (std::size_t k = 0; k < c; ++k) {
        largest = larger_magnitude(largest, gradient(c, k));
        difference = larger_magnitude(difference, gradient(c, k) - gradient(k, c));
      }
    }
    const Real roundings = 64 * std::numeric_limits<Real>::epsilon();
    return largest_magnitude(difference) <= roundings * largest_magnitude(largest);
  }

  template <class Gradient>
  void fill(const Gradient& gradient, bool has_response) {
    const P zero(Real(0));
    for (std::size_t from = 0; from < components_; ++from) {
      for (std::size_t j = 0; j < stages_; ++j) {
        const P column = coupling_[j].value * P(scale_);
        P* m = elimination_.column(from, j);
        P* r = &response_[(from * stages_ + j) * components_];
        for (std::size_t c = 0; c < components_; ++c) {
          m[c] = column * P(Real(-gradient(c, from).lane(static_cast<int>(j))));
          if (has_response) r[c] = c == from ? column : zero;
        }
        m[from].set_lane(static_cast<int>(j), m[from].lane(static_cast<int>(j)) + Real(1));
      }
    }
    for (std::size_t k = 0; k < state_size_; ++k) {
      for (std::size_t c = 0; c < components_; ++c) {
        P& entry = base_[k * components_ + c];
        if (k < components_) {
          entry = c == k ? P(Real(1)) : zero;
        } else {
          entry = nodes() * P(Real(step_ * inverse_mass(c, k - components_)));
        }
      }
    }
  }

  std::size_t stages_;
  bool second_order_;
  std::size_t components_;
  std::size_t state_size_;
  const StageCoefficients<Real, Lanes>& coefficients_;
  /// The columns of A or, for a second-order system, of A^2.
  const std::vector<typename StageCoefficients<Real, Lanes>::Rounded>& coupling_;
  bool unit_mass_ = true;
  bool end_follows_from_base_ = false;
  Real step_ = 0;
  Real scale_ = 0;
  std::vector<Real> inverse_mass_;
  ComponentUnits units_;
  std::vector<Real> inverse_units_;  ///< of the components, for the gradients of the present step
  StageElimination<Real, Lanes> elimination_;  ///< elimination of I - W (x) Dg
  std::vector<P> response_;
  std::vector<P> base_;
};

}  // namespace hamjet
