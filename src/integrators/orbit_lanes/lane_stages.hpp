#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "lane_coefficients.hpp"
#include "lane_field.hpp"
#include "lane_judge.hpp"
#include "orbits.hpp"

namespace hamjet {

/// The stages of degree 0 of one step of several orbits, by the fixed-point iteration of
/// StageIteration. Each orbit stops when it has converged, whatever the others do, so that none of
/// its digits depends on them. This is for second-order systems with unit mass, and for first-order
/// systems.
class LaneStages {
 public:
  LaneStages(const DynamicalSystem& system, const GaussTableau& tableau, int order)
      : is_second_order_(system.second_order.has_value()),
        components_(system.evaluated_list().variables()),
        coefficients_(tableau, is_second_order_),
        field_(system, tableau.stages, order),
        places_(components_ * tableau.stages),
        slopes_(places_.size()),
        lost_(places_.size()),
        gradients_(places_.size() * components_),
        base_(places_.size()) {}

  bool is_second_order() const { return is_second_order_; }
  std::size_t components() const { return components_; }
  std::size_t stages() const { return coefficients_.stages; }
  const LaneCoefficients& coefficients() const { return coefficients_; }
  LaneField& field() { return field_; }
  /// The stages' places and slopes, by component and stage, at c s + i.
  const std::vector<Orbits>& places() const { return places_; }
  std::vector<Orbits>& slopes() { return slopes_; }
  const std::vector<Orbits>& slopes() const { return slopes_; }
  /// d g_c / d Y_k, at (c m + k) s + i.
  const std::vector<Orbits>& gradients() const { return gradients_; }
  const Orbits& step() const { return step_; }
  /// h^2, or h for a first-order system.
  const Orbits& scale() const { return scale_; }

  /// Begins steps h at times of the system's clock.
  void begin_step(const Orbits& time, const Orbits& h) {
    field_.set_stage_times(
        [&](std::size_t i) { return time + h * Orbits(coefficients_.nodes[i]); });
    step_ = h;
    scale_ = is_second_order_ ? h * h : h;
  }

  /// Evaluates the collocation polynomials of the slopes at start + length c_i, in units of their
  /// own step, as StageSlopes::reposition.
  [[gnu::flatten]] void reposition(const Orbits& start, const Orbits& length) {
    const std::size_t s = stages();
    std::array<Orbits, most_stages> basis;
    guess_.resize(slopes_.size());
    for (std::size_t i = 0; i < s; ++i) {
      const Orbits x = start + length * Orbits(coefficients_.nodes[i]);
      Orbits product(1.0);
      for (std::size_t j = 0; j < s; ++j) {
        basis[j] = product * Orbits(coefficients_.lagrange[j]);
        product *= x - Orbits(coefficients_.nodes[j]);
      }
      product = Orbits(1.0);
      for (std::size_t j = s; j-- > 0;) {
        basis[j] *= product;
        product *= x - Orbits(coefficients_.nodes[j]);
      }
      for (std::size_t c = 0; c < components_; ++c) {
        const Orbits* const slope = &slopes_[c * s];
        Orbits even = basis[0] * slope[0];
        Orbits odd(0.0);
        for (std::size_t j = 1; j < s; ++j) (j % 2 == 0 ? even : odd) += basis[j] * slope[j];
        guess_[c * s + i] = even + odd;
      }
    }
    slopes_.swap(guess_);
  }

  /// Solves degree 0 of the orbits that `wanted` flags, from the slopes in slopes(); `state(k)` is
  /// component k of the state. Returns flags of the orbits that converged; adds to `evaluations`
  /// how many evaluations each took. After that slopes() and the gradients are those at the places
  /// that were found.
  template <class State>
  [[gnu::flatten]] Orbits solve(const State& state, const Orbits& wanted, EachOrbit& evaluations) {
    const std::size_t s = stages();
    for (std::size_t c = 0; c < components_; ++c) {
      for (std::size_t i = 0; i < s; ++i) {
        base_[c * s + i] = state(c);
        if (is_second_order_) {
          base_[c * s + i] += step_ * state(components_ + c) * Orbits(coefficients_.nodes[i]);
        }
      }
    }
    set_lost(state);
    place_all();
    std::array<LaneJudge, orbit_lanes> judges;
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      judges[k].is_done = wanted.lane(static_cast<int>(k)) == 0;
    }
    const auto is_done = [](const LaneJudge& judge) { return judge.is_done; };
    for (int count = 0; !std::all_of(judges.begin(), judges.end(), is_done); ++count) {
      if (count < 2) set_scales();
      field_.evaluate(places_, slopes_);
      const EachOrbit sizes = apart(couple());
      EachOrbit moves{};
      EachOrbit ends{};
      bool ends_any = false;
      for (std::size_t k = 0; k < orbit_lanes; ++k) {
        if (judges[k].is_done) continue;
        ++evaluations[k];
        moves[k] = 1;
        judges[k].judge(sizes[k]);
        ends[k] = judges[k].is_done ? 1 : 0;
        ends_any = ends_any || judges[k].is_done;
      }
      if (ends_any) {
        // From now on the contribution of the coefficients' rounding residues is known to the last
        // digit.
        end_with_lost(state, together(ends));
      }
      const Orbits moving = together(moves);
      for (std::size_t e = 0; e < places_.size(); ++e) {
        places_[e] = choose(moving, next_[e], places_[e]);
      }
    }
    field_.evaluate(places_, slopes_, gradients_);
    EachOrbit solved{};
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      solved[k] = wanted.lane(static_cast<int>(k)) != 0 && !judges[k].has_failed ? 1 : 0;
      if (wanted.lane(static_cast<int>(k)) != 0) ++evaluations[k];
    }
    Orbits finite(0.0);
    for (const Orbits& slope : slopes_) finite += slope - slope;
    return choose(finite, Orbits(0.0), together(solved));
  }

  /// The sum over j of W_ij / scale times the value at j, for all i, for one component.
  [[gnu::flatten]] void couple(const Orbits* values, const std::vector<double>& matrix,
                               Orbits* result) const {
    const std::size_t s = stages();
    constexpr std::size_t rows = 4;
    std::size_t i = 0;
    for (; i + rows <= s; i += rows) {
      std::array<Orbits, rows> sums;
      for (std::size_t r = 0; r < rows; ++r) sums[r] = Orbits(matrix[(i + r) * s]) * values[0];
      for (std::size_t j = 1; j < s; ++j) {
        const Orbits x = values[j];
        for (std::size_t r = 0; r < rows; ++r) sums[r] += Orbits(matrix[(i + r) * s + j]) * x;
      }
      for (std::size_t r = 0; r < rows; ++r) result[i + r] = sums[r];
    }
    for (; i < s; ++i) {
      Orbits sum = Orbits(matrix[i * s]) * values[0];
      for (std::size_t j = 1; j < s; ++j) sum += Orbits(matrix[i * s + j]) * values[j];
      result[i] = sum;
    }
  }

 private:
  static constexpr std::size_t most_stages = 16;

  /// The part of base + W g that the rounding of the coefficients takes away: see
  /// StageSystem::lost.
  template <class State>
  [[gnu::flatten]] void set_lost(const State& state) {
    const std::size_t s = stages();
    for (std::size_t c = 0; c < components_; ++c) {
      couple(&slopes_[c * s], coefficients_.lost_coupling, &lost_[c * s]);
      for (std::size_t i = 0; i < s; ++i) {
        lost_[c * s + i] *= scale_;
        if (is_second_order_) {
          lost_[c * s + i] += step_ * state(components_ + c) * Orbits(coefficients_.lost_nodes[i]);
        }
      }
    }
  }

  /// Sets the places of all orbits to base + (W g + lost).
  void place_all() {
    next_.resize(places_.size());
    scales_.assign(components_, Orbits(0.0));
    couple();
    places_ = next_;
  }

  /// Sets `next_` to base + (W g + lost); returns the largest changes from the present places, in
  /// units of each component's scale.
  [[gnu::flatten]] Orbits couple() {
    const std::size_t s = stages();
    std::array<Orbits, most_stages> moved;
    Orbits largest(0.0);
    for (std::size_t c = 0; c < components_; ++c) {
      couple(&slopes_[c * s], coefficients_.coupling, moved.data());
      for (std::size_t i = 0; i < s; ++i) {
        const std::size_t e = c * s + i;
        next_[e] = base_[e] + (moved[i] * scale_ + lost_[e]);
        largest = larger_magnitude(largest, (next_[e] - places_[e]) * scales_[c]);
      }
    }
    return largest;
  }

  template <class State>
  void end_with_lost(const State& state, const Orbits& ends) {
    const std::vector<Orbits> before = lost_;
    set_lost(state);
    for (std::size_t e = 0; e < lost_.size(); ++e) lost_[e] = choose(ends, lost_[e], before[e]);
    couple();
  }

  /// Changes count relative to the largest stage of a component, or to the largest term of the sum
  /// that gives the stage.
  void set_scales() {
    const std::size_t s = stages();
    for (std::size_t c = 0; c < components_; ++c) {
      Orbits largest(std::numeric_limits<double>::min());
      for (std::size_t i = 0; i < s; ++i) {
        largest = larger_magnitude(larger_magnitude(largest, places_[c * s + i]), base_[c * s + i]);
      }
      scales_[c] = Orbits(1.0) / largest;
    }
  }

  bool is_second_order_;
  std::size_t components_;
  LaneCoefficients coefficients_;
  LaneField field_;
  Orbits step_{0.0};
  Orbits scale_{0.0};
  std::vector<Orbits> places_;
  std::vector<Orbits> slopes_;
  std::vector<Orbits> lost_;
  std::vector<Orbits> gradients_;
  std::vector<Orbits> base_;
  std::vector<Orbits> next_;
  std::vector<Orbits> guess_;
  std::vector<Orbits> scales_;  ///< by component, the inverse of the scale of changes
};

}  // namespace hamjet
