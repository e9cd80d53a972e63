#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"
#include "lane_elimination.hpp"
#include "lane_judge.hpp"
#include "lane_stages.hpp"
#include "orbits.hpp"

namespace hamjet {

/// The jets of orbits side by side, of order 0 to 2, and their steps. At each stage a field of m
/// inputs is expanded in these inputs alone. With its second derivatives G_ab and the stages'
/// linear parts Y_a, the remainder of degree 2 is
///
///   R_kl = sum over a <= b of G_ab (Y_ak Y_bl + Y_al Y_bk) ,   half of that for k = l ,
///
/// and each degree follows from Y_d = base_d + W (R_d + Dg Y_d), as in StageSystem.
template <int Components>
class LaneJets {
 public:
  LaneJets(const LaneStages& stages, std::size_t state_size, SpacePointer space, int order,
           bool is_compensated)
      : space_(std::move(space)),
        order_(order),
        is_compensated_(is_compensated),
        is_iterated_(space_->variables() <= most_iterated),
        components_(stages.components()),
        size_(space_->first(order + 1)),
        values_(state_size * size_, Orbits(0.0)),
        lost_(values_),
        elimination_(components_, stages.stages(), stages.coefficients().coupling),
        columns_(components_ * stages.stages() * width),
        remainders_(columns_.size()) {
    const std::size_t m = components_;
    if (order_ < 2) return;
    linear_.resize(m * stages.stages() * space_->variables());
    second_.resize(m * m * m * stages.stages());
    for (std::size_t k = space_->first(2); k < space_->first(3); ++k) {
      std::array<std::size_t, 2> factors{};
      std::size_t count = 0;
      const auto exponents = space_->exponents(k);
      for (std::size_t v = 0; v < exponents.size(); ++v) {
        for (int e = 0; e < exponents[v]; ++e) factors[count++] = v;
      }
      pairs_.push_back(factors);
    }
  }

  /// The largest allowed growth of entries in an elimination, see LaneElimination; a step with more
  /// growth is refused.
  static constexpr double most_growth = 8;

  /// Component c of the states.
  const Orbits& state(std::size_t c) const { return values_[c * size_]; }

  /// Puts a jet into a lane.
  void start(std::size_t lane, const FlowJet<double>& jet) {
    for (std::size_t c = 0; c < jet.size(); ++c) {
      for (std::size_t k = 0; k < size_; ++k) {
        values_[c * size_ + k].set_lane(static_cast<int>(lane), jet[c][k]);
        lost_[c * size_ + k].set_lane(static_cast<int>(lane), 0);
      }
    }
  }
  /// The jet of a lane, in the space of the problem.
  FlowJet<double> jet(std::size_t lane) const {
    FlowJet<double> result;
    for (std::size_t c = 0; c * size_ < values_.size(); ++c) {
      Series<double>& series = result.emplace_back(space_);
      for (std::size_t k = 0; k < size_; ++k) {
        series[k] = values_[c * size_ + k].lane(static_cast<int>(lane));
      }
    }
    return result;
  }

  /// Takes the equations of the degrees 1 and 2, and eliminates them unless they are iterated.
  /// Returns the growth of the entries, see LaneElimination; 0 if nothing was eliminated.
  Orbits take_equations(const LaneStages& stages, std::vector<Orbits> entry_weights) {
    elimination_.take(stages.gradients(), stages.scale(), std::move(entry_weights));
    is_eliminated_ = false;
    return is_iterated_ ? Orbits(0.0) : elimination_.factorise();
  }

  /// Takes the step of the orbits that `taken` flags. Returns flags of the orbits whose columns did
  /// not converge.
  Orbits advance(LaneStages& stages, const Orbits& taken) {
    failed_ = Orbits(0.0);
    if (order_ >= 2) stages.field().evaluate_second(stages.places(), second_);
    for (int d = 1; d <= order_; ++d) {
      const std::size_t last = space_->first(d + 1);
      for (std::size_t k = space_->first(d); k < last; k += width) {
        advance_columns(stages, taken, d, k, std::min(width, last - k));
      }
    }
    advance_states(stages, taken);
    return failed_;
  }

 private:
  /// Up to this number of variables the columns are solved by iteration, as in
  /// GaussIntegrator::solve_degrees.
  static constexpr std::size_t most_iterated = 2;

  static constexpr std::size_t width = LaneElimination<Components>::width;

  std::size_t components() const {
    return Components == 0 ? components_ : static_cast<std::size_t>(Components);
  }

  [[gnu::flatten]] void advance_columns(const LaneStages& stages, const Orbits& taken, int degree,
                                        std::size_t first, std::size_t count) {
    const std::size_t m = components();
    const std::size_t s = stages.stages();
    const LaneCoefficients& coefficients = stages.coefficients();
    const bool has_remainder = degree == 2;
    for (std::size_t t = 0; t < width; ++t) {
      for (std::size_t c = 0; c < m; ++c) {
        Orbits start(0.0);
        Orbits velocity(0.0);
        if (t < count) start = values_[c * size_ + first + t];
        if (t < count && stages.is_second_order()) {
          velocity = stages.step() * values_[(m + c) * size_ + first + t];
        }
        for (std::size_t i = 0; i < s; ++i) {
          columns_[(i * m + c) * width + t] = start + velocity * Orbits(coefficients.nodes[i]);
        }
      }
      if (has_remainder && t < count)
        add_remainder(stages, pairs_[first + t - space_->first(2)], t);
    }
    if (is_iterated_) {
      std::array<Orbits, width> failed;
      for (std::size_t t = 0; t < count; ++t) failed[t] = iterate(stages, taken, t);
      eliminate_where(failed, count);
    } else {
      elimination_.solve(columns_.data());
    }
    for (std::size_t t = 0; t < count; ++t) {
      for (std::size_t c = 0; c < m; ++c) {
        Orbits to_momentum(0.0);
        Orbits to_position(0.0);
        for (std::size_t i = 0; i < s; ++i) {
          const Orbits* const gradient = &stages.gradients()[c * m * s + i];
          const Orbits* const column = &columns_[i * m * width + t];
          Orbits slope = gradient[0] * column[0];
          for (std::size_t k = 1; k < m; ++k) slope += gradient[k * s] * column[k * width];
          if (has_remainder) slope += remainders_[(t * m + c) * s + i];
          to_momentum += Orbits(coefficients.weights[i]) * slope;
          to_position += Orbits(coefficients.position_weights[i]) * slope;
          if (degree == 1 && order_ >= 2) {
            linear_[((first + t - 1) * m + c) * s + i] = columns_[(i * m + c) * width + t];
          }
        }
        add_step(stages, taken, c, first + t, to_position, to_momentum);
      }
    }
  }

  /// Solves the columns of the flagged orbits by elimination; the flags are given by column.
  void eliminate_where(const std::array<Orbits, width>& flags, std::size_t count) {
    bool is_any = false;
    for (std::size_t t = 0; t < count; ++t) is_any = is_any || largest_magnitude(flags[t]) > 0;
    if (!is_any) return;
    if (!is_eliminated_) growth_ = elimination_.factorise();
    is_eliminated_ = true;
    const std::vector<Orbits> iterated = columns_;
    elimination_.solve(columns_.data());
    for (std::size_t e = 0; e < columns_.size(); ++e) {
      const std::size_t t = e % width;
      if (t < count) columns_[e] = choose(flags[t], columns_[e], iterated[e]);
    }
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      const auto lane = static_cast<int>(k);
      for (std::size_t t = 0; t < count; ++t) {
        if (flags[t].lane(lane) != 0 && !(growth_.lane(lane) <= most_growth)) {
          failed_.set_lane(lane, 1);
        }
      }
    }
  }

  /// Solves Y = column + W Dg Y for one column by fixed-point iteration, as DegreeIteration does;
  /// each orbit stops when it has converged. Returns flags of the orbits for which the iteration
  /// does not contract; their column is unchanged.
  Orbits iterate(const LaneStages& stages, const Orbits& taken, std::size_t t) {
    const std::size_t m = components();
    const std::size_t s = stages.stages();
    known_.resize(m * s);
    next_.resize(m * s);
    for (std::size_t c = 0; c < m; ++c) {
      for (std::size_t i = 0; i < s; ++i) known_[c * s + i] = columns_[(i * m + c) * width + t];
    }
    places_ = known_;
    sweep(stages);
    places_.swap(next_);
    std::vector<Orbits> scales(m);
    for (std::size_t c = 0; c < m; ++c) {
      Orbits size(std::numeric_limits<double>::min());
      for (std::size_t e = c * s; e < (c + 1) * s; ++e) {
        size = larger_magnitude(larger_magnitude(size, places_[e]), known_[e]);
      }
      scales[c] = Orbits(1.0) / size;
    }
    std::array<LaneJudge, orbit_lanes> judges;
    for (std::size_t k = 0; k < orbit_lanes; ++k) {
      judges[k].is_done = taken.lane(static_cast<int>(k)) == 0;
    }
    const auto is_done = [](const LaneJudge& judge) { return judge.is_done; };
    while (!std::all_of(judges.begin(), judges.end(), is_done)) {
      EachOrbit moves{};
      for (std::size_t k = 0; k < orbit_lanes; ++k) moves[k] = judges[k].is_done ? 0 : 1;
      const Orbits moving = together(moves);
      sweep(stages);
      move(moving);
      sweep(stages);
      Orbits largest(0.0);
      for (std::size_t e = 0; e < places_.size(); ++e) {
        largest = larger_magnitude(largest, (next_[e] - places_[e]) * scales[e / s]);
      }
      move(moving);
      const EachOrbit sizes = apart(largest);
      for (std::size_t k = 0; k < orbit_lanes; ++k) {
        if (!judges[k].is_done) judges[k].judge(sizes[k]);
      }
    }
    EachOrbit failed{};
    for (std::size_t k = 0; k < orbit_lanes; ++k) failed[k] = judges[k].has_failed ? 1 : 0;
    const Orbits has_failed = together(failed);
    for (std::size_t c = 0; c < m; ++c) {
      for (std::size_t i = 0; i < s; ++i) {
        Orbits& column = columns_[(i * m + c) * width + t];
        column = choose(has_failed, column, places_[c * s + i]);
      }
    }
    return has_failed;
  }

  /// Sets `next_` to known + W Dg places.
  [[gnu::flatten]] void sweep(const LaneStages& stages) {
    const std::size_t m = components();
    const std::size_t s = stages.stages();
    std::array<Orbits, 16> slopes;
    for (std::size_t c = 0; c < m; ++c) {
      for (std::size_t i = 0; i < s; ++i) {
        slopes[i] = elimination_.scaled_gradient(c, 0, i) * places_[i];
        for (std::size_t k = 1; k < m; ++k) {
          slopes[i] += elimination_.scaled_gradient(c, k, i) * places_[k * s + i];
        }
      }
      stages.couple(slopes.data(), stages.coefficients().coupling, &next_[c * s]);
      for (std::size_t e = c * s; e < (c + 1) * s; ++e) next_[e] += known_[e];
    }
  }
  [[gnu::flatten]] void move(const Orbits& moving) {
    for (std::size_t e = 0; e < places_.size(); ++e) {
      places_[e] = choose(moving, next_[e], places_[e]);
    }
  }

  /// Adds W R to a column, where R is the remainder of the monomial of two variables.
  [[gnu::flatten]] void add_remainder(const LaneStages& stages,
                                      const std::array<std::size_t, 2>& factors, std::size_t t) {
    const std::size_t m = components();
    const std::size_t s = stages.stages();
    const double share = factors[0] == factors[1] ? 0.5 : 1;
    std::array<Orbits, 16> coupled;
    for (std::size_t c = 0; c < m; ++c) {
      Orbits* const remainder = &remainders_[(t * m + c) * s];
      for (std::size_t i = 0; i < s; ++i) {
        Orbits sum(0.0);
        for (std::size_t a = 0; a < m; ++a) {
          const Orbits& y_k = linear_[(factors[0] * m + a) * s + i];
          const Orbits& y_l = linear_[(factors[1] * m + a) * s + i];
          for (std::size_t b = a; b < m; ++b) {
            const Orbits& z_k = linear_[(factors[0] * m + b) * s + i];
            const Orbits& z_l = linear_[(factors[1] * m + b) * s + i];
            sum += second_[((c * m + a) * m + b) * s + i] * (y_k * z_l + y_l * z_k);
          }
        }
        remainder[i] = Orbits(share) * sum;
      }
      stages.couple(remainder, stages.coefficients().coupling, coupled.data());
      for (std::size_t i = 0; i < s; ++i) {
        columns_[(i * m + c) * width + t] += stages.scale() * coupled[i];
      }
    }
  }

  /// The step of degree 0, including the rounding residues of the weights.
  [[gnu::flatten]] void advance_states(const LaneStages& stages, const Orbits& taken) {
    const std::size_t m = components();
    const std::size_t s = stages.stages();
    const LaneCoefficients& b = stages.coefficients();
    for (std::size_t c = 0; c < m; ++c) {
      Orbits to_momentum(0.0), to_position(0.0), lost_momentum(0.0), lost_position(0.0);
      for (std::size_t i = 0; i < s; ++i) {
        const Orbits& slope = stages.slopes()[c * s + i];
        to_momentum += Orbits(b.weights[i]) * slope;
        to_position += Orbits(b.position_weights[i]) * slope;
        lost_momentum += Orbits(b.lost_weights[i]) * slope;
        lost_position += Orbits(b.lost_position_weights[i]) * slope;
      }
      add_step(stages, taken, c, 0, to_position, to_momentum);
      const Orbits& h = stages.step();
      if (stages.is_second_order()) {
        add(taken, c, 0, h * h * lost_position);
        add(taken, m + c, 0, h * lost_momentum);
      } else {
        add(taken, c, 0, h * lost_momentum);
      }
    }
  }

  /// The step of one coefficient of component c, see SummedJet. The position comes first, because
  /// it needs the momentum at the start.
  void add_step(const LaneStages& stages, const Orbits& taken, std::size_t c, std::size_t k,
                const Orbits& to_position, const Orbits& to_momentum) {
    const Orbits& h = stages.step();
    if (!stages.is_second_order()) {
      add(taken, c, k, h * to_momentum);
      return;
    }
    const std::size_t momentum = components() + c;
    add(taken, c, k, h * (values_[momentum * size_ + k] + h * to_position));
    add(taken, momentum, k, h * to_momentum);
  }

  /// add_compensated for the orbits that `taken` flags.
  void add(const Orbits& taken, std::size_t component, std::size_t k, const Orbits& increment) {
    Orbits& value = values_[component * size_ + k];
    Orbits& lost = lost_[component * size_ + k];
    const Orbits corrected = is_compensated_ ? increment - lost : increment;
    const Orbits sum = value + corrected;
    if (is_compensated_) lost = choose(taken, (sum - value) - corrected, lost);
    value = choose(taken, sum, value);
  }

  SpacePointer space_;
  int order_;
  bool is_compensated_;
  bool is_iterated_;
  std::size_t components_;
  std::size_t size_;  ///< number of coefficients of a component
  std::vector<Orbits> values_;
  std::vector<Orbits> lost_;
  LaneElimination<Components> elimination_;
  std::vector<Orbits> columns_;
  std::vector<Orbits> remainders_;  ///< by column, component and stage
  std::vector<Orbits> linear_;      ///< Y of degree 1, by variable, component and stage
  std::vector<Orbits> second_;      ///< see LaneField::evaluate_second
  /// Work space for a column that is iterated, at c s + i.
  std::vector<Orbits> known_, places_, next_;
  bool is_eliminated_ = false;  ///< columns are eliminated, because an iteration did not contract
  Orbits growth_{0.0};          ///< growth of the entries in that elimination
  Orbits failed_{0.0};
  /// The two variables of each monomial of degree 2.
  std::vector<std::array<std::size_t, 2>> pairs_;
};

}  // namespace hamjet
