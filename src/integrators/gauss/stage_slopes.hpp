#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "component_units.hpp"
#include "degree_iteration.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "newton_measures.hpp"
#include "stage_iteration.hpp"
#include "stage_system.hpp"

namespace hamjet {

/// The stages of one step. Degree 0 is solved by fixed-point iteration or, where this does not
/// contract, by Newton's method on the slopes G; the higher degrees follow from the linearisation.
/// Y_c are the inputs of the evaluator, G_c the slopes g(Y)_c.
template <class Real, int Lanes>
class StageSlopes {
 public:
  using P = Pack<Real, Lanes>;

  /// The number of monomials that are solved for at once. The numbers of monomials of a degree,
  /// which are binomial coefficients, are often multiples of it, and the 21 sums of three
  /// components fit the registers.
  static constexpr std::size_t tile = 7;

  StageSlopes(const DynamicalSystem& system, const GaussTableau& tableau, SpacePointer space,
              int working_order)
      : system_(system, tableau),
        units_(system),
        list_(system.evaluated_list()),
        evaluator_(list_, space, working_order),
        space_(std::move(space)),
        iteration_(system_),
        slopes_(system_.components()) {}
  StageSlopes(const StageSlopes&) = delete;
  StageSlopes& operator=(const StageSlopes&) = delete;

  /// Begins a step h at a time of the system's clock.
  void begin_step(const Real& time, const Real& h) {
    system_.set_step(h);
    if (evaluator_.has_time()) evaluator_.set_time(P(time) + P(h) * system_.nodes());
  }
  const StageSystem<Real, Lanes>& system() const { return system_; }
  SliceEvaluator<P, Real>& evaluator() { return evaluator_; }
  std::vector<P>& slopes() { return slopes_; }

  /// The slope g_c = (M^-1 F)_c, or z'_c, of one monomial, from the evaluator's outputs.
  P slope(std::size_t c, std::size_t monomial = 0) const {
    if (!system_.second_order() || system_.unit_mass()) return evaluator_.output(c)[monomial];
    P sum(Real(0));
    for (std::size_t k = 0; k < system_.components(); ++k) {
      sum += P(system_.inverse_mass(c, k)) * evaluator_.output(k)[monomial];
    }
    return sum;
  }

  /// The collocation polynomial of the slopes, evaluated at the start and at the end of the step.
  Real slope_at_start(std::size_t c) const { return dot(system_.coefficients().start, slopes_[c]); }
  Real slope_at_end(std::size_t c) const { return dot(system_.coefficients().end, slopes_[c]); }

  /// Evaluates the collocation polynomial of the slopes at start + length c_i, in units of its own
  /// step. The results are the first guess of the slopes of another step.
  void reposition(const Real& start, const Real& length) {
    const std::size_t s = system_.stages();
    const P x = P(start) + P(length) * system_.nodes();
    // The products of x - c_k over k < j, which are then multiplied by those over k > j.
    std::array<P, Lanes> basis;
    P product(Real(1));
    for (std::size_t j = 0; j < s; ++j) {
      basis[j] = product * P(system_.coefficients().lagrange.lane(static_cast<int>(j)));
      product *= x - P(system_.nodes().lane(static_cast<int>(j)));
    }
    product = P(Real(1));
    for (std::size_t j = s; j-- > 0;) {
      basis[j] *= product;
      product *= x - P(system_.nodes().lane(static_cast<int>(j)));
    }
    for (P& slope : slopes_) {
      P sum(Real(0));
      for (std::size_t j = 0; j < s; ++j) sum += basis[j] * P(slope.lane(static_cast<int>(j)));
      slope = sum;
    }
  }

  /// The largest value(c), a number or several, of the measured components in their units.
  template <class T, class Value>
  T largest_component(const Value& value) const {
    T largest(Real(0));
    for (std::size_t c = 0; c < units_.count(); ++c) {
      largest = larger_magnitude(largest, T(value(c) * T(units_.inverse_unit(c, inverse_sigma_))));
    }
    return largest;
  }

  double largest_slope() const {
    return largest_of(largest_component<P>([this](std::size_t c) { return slopes_[c]; }));
  }

  /// The largest entry of Dg at the stages, see GradientBlocks.
  P gradient_sizes() const { return gradient_blocks().largest(); }
  /// The largest entry of Dg over all stages.
  double largest_gradient() const { return largest_of(gradient_sizes()); }

  /// The largest distance, over the stages, of a component from a point.
  template <class State>
  double displacement(const State& state) {
    return largest_of(
        largest_component<P>([&](std::size_t c) { return evaluator_.input(c)[0] - P(state(c)); }));
  }

  /// The derivative d g_c / d Y_from at the stages.
  P slope_gradient(std::size_t c, std::size_t from) const {
    if (!system_.second_order() || system_.unit_mass()) return evaluator_.output_gradient(c, from);
    P sum(Real(0));
    for (std::size_t k = 0; k < system_.components(); ++k) {
      sum += P(system_.inverse_mass(c, k)) * evaluator_.output_gradient(k, from);
    }
    return sum;
  }

  /// Whether the slopes are those of Newton's method. In a stiff system these are good to
  /// round-off, while slopes evaluated at the stages are small differences of large terms; after
  /// fixed-point iteration the evaluated slopes are better.
  bool is_by_newton() const { return is_by_newton_; }
  /// See StageIteration.
  double contraction() const { return iteration_.contraction(); }
  /// Restores what the next steps take from an earlier solution.
  void restore(const std::vector<P>& slopes, bool is_by_newton, double contraction) {
    slopes_ = slopes;
    is_by_newton_ = is_by_newton;
    iteration_.restore_contraction(contraction);
  }

  /// Replaces the evaluated slopes by those of Newton's method, at degree 0. This is for unit mass
  /// only, where slopes and forces are the same.
  void store_newton_slopes() {
    if (!is_by_newton_ || !system_.unit_mass()) return;
    for (std::size_t c = 0; c < system_.components(); ++c) {
      P* target = evaluator_.mutable_output(c);
      if (target != nullptr) *target = slopes_[c];
    }
  }

  /// Solves degree 0, starting from slopes(); returns true if the solution was found to round-off.
  template <class State>
  bool solve_constant_terms(const State& state, IntegrationStatistics& statistics) {
    const auto evaluate = [&](const std::vector<P>& stages, std::vector<P>& slopes) {
      for (std::size_t c = 0; c < stages.size(); ++c) evaluator_.input(c)[0] = stages[c];
      evaluator_.evaluate_constant_values();
      ++statistics.nominal_evaluations;
      for (std::size_t c = 0; c < stages.size(); ++c) slopes[c] = slope(c);
    };
    for (bool may_expect = true;; may_expect = false) {
      const auto outcome = iteration_.solve_constant_terms(state, slopes_, evaluate, may_expect);
      is_by_newton_ = outcome == iteration_.fails;
      if (is_by_newton_) return solve_by_newton(state, statistics);
      evaluate_at_slopes(state, statistics);
      const auto evaluated = [this](std::size_t c) { return slope(c); };
      if (outcome == iteration_.solved || iteration_.is_confirmed(slopes_, evaluated)) return true;
      for (std::size_t c = 0; c < slopes_.size(); ++c) slopes_[c] = slope(c);
    }
  }

  /// Solves degree 0 by Newton's method, with rho = g(Y) - G and Y = base + W G:
  /// dY = K rho, dG = rho + Dg dY.
  template <class State>
  bool solve_by_newton(const State& state, IntegrationStatistics& statistics) {
    const std::size_t m = system_.components();
    std::vector<P> residual(m);
    std::vector<P> change(m);
    Real previous = std::numeric_limits<Real>::max();
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    bool is_factorised = false;
    for (int iteration = 0; iteration < largest_iteration_count; ++iteration) {
      evaluate_at_slopes(state, statistics);
      if (!is_factorised) {
        if (!factorise()) return false;
        is_factorised = true;
      }
      for (std::size_t c = 0; c < m; ++c) residual[c] = slope(c) - slopes_[c];
      apply_response(residual, change);
      const Real size = largest_relative_change(system_, evaluator_, change);
      if (!is_finite(size)) return false;
      for (std::size_t c = 0; c < m; ++c) {
        slopes_[c] += residual[c];
        for (std::size_t k = 0; k < m; ++k) slopes_[c] += slope_gradient(c, k) * change[k];
      }
      // Once the correction stops shrinking, it is round-off, provided that it is no larger than
      // what the rounding of the slopes alone causes; in stiff systems this is far above epsilon.
      const bool is_stalled = size >= previous / 4;
      if (size <= 2 * epsilon ||
          (is_stalled &&
           size <= 100 * epsilon * rounding_amplification(system_, evaluator_, slopes_, state))) {
        evaluate_at_slopes(state, statistics);
        statistics.most_newton_iterations =
            std::max(statistics.most_newton_iterations, iteration + 1);
        return true;
      }
      // The old linearisation is kept as long as it contracts well.
      if (size > previous / 20) is_factorised = false;
      previous = size;
    }
    return false;
  }

  /// Evaluates the stages, and all values there, from the slopes of an earlier solution.
  template <class State>
  [[gnu::noinline]] void evaluate_at_slopes(const State& state, IntegrationStatistics& statistics) {
    place_stages(state);
    evaluator_.evaluate_constant_terms();
    ++statistics.nominal_evaluations;
    if (system_.second_order()) return;
    const GradientBlocks<P> blocks = gradient_blocks();
    inverse_sigma_ = GradientBlocks<Real>{Real(0), largest_magnitude(blocks.velocity),
                                          largest_magnitude(blocks.force)}
                         .inverse_sigma();
  }

  const ComponentUnits& units() const { return units_; }

  /// Forms B and, if asked for, K at the present stages; returns false if the matrix is singular.
  /// Not inlined, as whatever a step and its repetition share: copies may fuse products and sums
  /// otherwise, and a jet along a known nominal would have other last bits than one that is
  /// integrated with it.
  [[gnu::noinline]] bool factorise(Response response = Response::formed) {
    return system_.factorise(
        [&](std::size_t c, std::size_t from) { return slope_gradient(c, from); }, inverse_sigma_,
        response);
  }

  /// As solve_degree, but by fixed-point iteration without a factorisation. Returns false if the
  /// iteration does not contract.
  template <class State>
  bool iterate_degree(int d, const State& state) {
    if (system_.second_order() && !system_.unit_mass() && d >= 2) apply_inverse_mass(d);
    const std::size_t last = space_->first(d + 1);
    std::size_t k = space_->first(d);
    for (; k + 2 <= last; k += 2) {
      if (!iterate_monomials<2>(d, k, state)) return false;
    }
    return k == last || iterate_monomials<1>(d, k, state);
  }

  /// Forms the degree-d slices of the stages from those of the outputs' remainders and of the
  /// state: Y_d = K R_d + B z_d. `state(k, monomial)` is a coefficient of the k-th component.
  template <class State>
  void solve_degree(int d, const State& state) {
    const std::size_t first = space_->first(d);
    const std::size_t last = space_->first(d + 1);
    if (system_.second_order() && !system_.unit_mass() && d >= 2) apply_inverse_mass(d);
    const auto solve =
        [&]<std::size_t Components>(std::integral_constant<std::size_t, Components>) {
          for (std::size_t c = 0; c < system_.components(); c += Components) {
            std::size_t k = first;
            for (; k + tile <= last; k += tile) solve_tile<tile, Components>(c, d, k, state);
            for (; k < last; ++k) solve_tile<1, Components>(c, d, k, state);
          }
        };
    // Three components together read the remainders only once.
    if (system_.components() == 3) return solve(std::integral_constant<std::size_t, 3>{});
    solve(std::integral_constant<std::size_t, 1>{});
  }

 private:
  static double largest_of(const P& x) { return static_cast<double>(largest_magnitude(x)); }

  GradientBlocks<P> gradient_blocks() const {
    return units_.blocks<P>([this](std::size_t c, std::size_t k) { return slope_gradient(c, k); });
  }

  template <std::size_t Width, class State>
  bool iterate_monomials(int d, std::size_t first, const State& state) {
    // The usual number of components is unrolled, and its numbers stay in registers.
    if (system_.components() == 3) return iterate_tile<Width, 3>(d, first, state);
    return iterate_tile<Width, 0>(d, first, state);
  }

  template <std::size_t Width, std::size_t Components, class State>
  bool iterate_tile(int d, std::size_t first, const State& state) {
    DegreeIteration<Real, Lanes, Components, Width> iteration(system_);
    const std::size_t m = system_.components();
    for (std::size_t c = 0; c < m; ++c) {
      for (std::size_t k = 0; k < m; ++k) iteration.gradient[c * m + k] = slope_gradient(c, k);
      for (std::size_t t = 0; t < Width; ++t) {
        const auto monomial = [&](std::size_t i) { return state(i, first + t); };
        P& known = iteration.known[c * Width + t];
        known = system_.base(c, monomial);
        if (has_remainder(c, d)) known += system_.couple(remainder(c)[first + t]);
      }
    }
    if (!iteration.solve()) return false;
    for (std::size_t c = 0; c < m; ++c) {
      for (std::size_t t = 0; t < Width; ++t) {
        evaluator_.input(c)[first + t] = iteration.stages[c * Width + t];
      }
    }
    return true;
  }

  static constexpr int largest_iteration_count = 40;

  template <class State>
  [[gnu::noinline]] void place_stages(const State& state) {
    for (std::size_t c = 0; c < system_.components(); ++c) {
      evaluator_.input(c)[0] = system_.base(c, state) +
                               (system_.couple(slopes_[c]) + system_.lost(c, state, slopes_[c]));
    }
  }

  void apply_response(const std::vector<P>& residual, std::vector<P>& change) const {
    const std::size_t m = system_.components();
    for (std::size_t c = 0; c < m; ++c) {
      P sum(Real(0));
      for (std::size_t from = 0; from < m; ++from) {
        for (std::size_t j = 0; j < system_.stages(); ++j) {
          sum += system_.response(from, j, c) * P(residual[from].lane(static_cast<int>(j)));
        }
      }
      change[c] = sum;
    }
  }

  /// Forms the remainders of M^-1 F. An affine force has no remainder and is skipped.
  void apply_inverse_mass(int d) {
    mapped_.resize(system_.components());
    for (std::size_t c = 0; c < system_.components(); ++c) {
      mapped_[c].resize(space_->size());
      const auto begin = static_cast<std::ptrdiff_t>(space_->first(d));
      const auto end = static_cast<std::ptrdiff_t>(space_->first(d + 1));
      std::fill(mapped_[c].begin() + begin, mapped_[c].begin() + end, P(Real(0)));
      for (std::size_t from = 0; from < system_.components(); ++from) {
        if (!evaluator_.has_remainder(from, d)) continue;
        const P entry(system_.inverse_mass(c, from));
        for (std::size_t k = space_->first(d); k < space_->first(d + 1); ++k) {
          mapped_[c][k] += entry * evaluator_.remainder(from)[k];
        }
      }
    }
  }

  /// Whether a slope has a remainder, see SliceEvaluator::has_remainder.
  bool has_remainder(std::size_t c, int d) const {
    if (!system_.second_order() || system_.unit_mass()) return evaluator_.has_remainder(c, d);
    return d >= 2;
  }

  const P* remainder(std::size_t c) const {
    const bool is_mapped = system_.second_order() && !system_.unit_mass();
    return is_mapped ? mapped_[c].data() : evaluator_.remainder(c);
  }

  /// Forms Y of `Components` components from c on for `Width` monomials at once. Each entry of K is
  /// loaded once for all these monomials, and each remainder once for all these components, which
  /// stand side by side in K and B.
  template <std::size_t Width, std::size_t Components, class State>
  void solve_tile(std::size_t c, int d, std::size_t monomial, const State& state) {
    std::array<std::array<P, Width>, Components> sum;
    for (auto& row : sum) row.fill(P(Real(0)));
    const auto add = [&](const P* entries, const auto& value) {
      for (std::size_t t = 0; t < Width; ++t) {
        const P broadcast(value(t));
        for (std::size_t i = 0; i < Components; ++i) sum[i][t] += entries[i] * broadcast;
      }
    };
    for (std::size_t k = 0; k < system_.state_size(); ++k) {
      add(&system_.base_response(k, c), [&](std::size_t t) { return state(k, monomial + t); });
    }
    for (std::size_t from = 0; from < system_.components(); ++from) {
      if (!has_remainder(from, d)) continue;
      const P* r = remainder(from) + monomial;
      for (std::size_t j = 0; j < system_.stages(); ++j) {
        add(&system_.response(from, j, c),
            [&](std::size_t t) { return r[t].lane(static_cast<int>(j)); });
      }
    }
    for (std::size_t i = 0; i < Components; ++i) {
      P* target = evaluator_.input(c + i) + monomial;
      for (std::size_t t = 0; t < Width; ++t) target[t] = sum[i][t];
    }
  }

  StageSystem<Real, Lanes> system_;
  ComponentUnits units_;
  Real inverse_sigma_ = 1;  ///< the inverse sigma of the stages, see ComponentUnits
  OperationList list_;
  SliceEvaluator<P, Real> evaluator_;
  SpacePointer space_;
  StageIteration<Real, Lanes> iteration_;
  std::vector<P> slopes_;
  bool is_by_newton_ = false;
  std::vector<std::vector<P>> mapped_;
};

}  // namespace hamjet
