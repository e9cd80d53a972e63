#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "compensated_addition.hpp"
#include "gauss/end_map.hpp"
#include "gauss/stage_slopes.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The flow's jet as it advances from step to step, with the round-off that each addition lost, if
/// the summation is compensated. For an end map, the coefficients above degree 0 are stored by
/// rows: one pack for each monomial, whose lanes are the components.
template <class Real, int Lanes>
class SummedJet {
 public:
  using P = Pack<Real, Lanes>;

  SummedJet(const FlowProblem<Real>& problem, bool is_compensated, bool is_by_rows)
      : is_compensated_(is_compensated), jet_(starting_jet(problem)) {
    const std::size_t size = problem.space->size();
    if (is_compensated) lost_.assign(jet_.size(), std::vector<Real>(is_by_rows ? 1 : size));
    if (!is_by_rows) return;
    rows_.resize(size);
    for (std::size_t k = 1; k < size; ++k) {
      for (std::size_t c = 0; c < jet_.size(); ++c) {
        rows_[k].value.set_lane(static_cast<int>(c), jet_[c][k]);
      }
    }
  }

  /// The present jet.
  const FlowJet<Real>& value() {
    for (std::size_t k = 1; k < rows_.size(); ++k) {
      for (std::size_t c = 0; c < jet_.size(); ++c) {
        jet_[c][k] = rows_[k].value.lane(static_cast<int>(c));
      }
    }
    return jet_;
  }
  FlowJet<Real> take() {
    value();
    return std::move(jet_);
  }
  const Real& constant(std::size_t component) const { return jet_[component][0]; }
  /// The constant terms, as a function of the component.
  auto start() const {
    return [this](std::size_t component) -> const Real& { return constant(component); };
  }
  /// A coefficient of any degree.
  Real coefficient(std::size_t component, std::size_t monomial) const {
    return rows_.empty() ? jet_[component][monomial]
                         : rows_[monomial].value.lane(static_cast<int>(component));
  }

  /// The constant terms, and the rounding that they lost (empty if not compensated).
  std::vector<Real> constants() const {
    std::vector<Real> result;
    for (const Series<Real>& component : jet_) result.push_back(component[0]);
    return result;
  }
  std::vector<Real> lost_constants() const {
    std::vector<Real> result;
    for (const auto& component : lost_) result.push_back(component[0]);
    return result;
  }
  /// Continues from given constant terms and the rounding that they lost.
  void resume(const std::vector<Real>& constants, const std::vector<Real>& lost) {
    for (std::size_t c = 0; c < jet_.size(); ++c) {
      jet_[c][0] = constants[c];
      if (is_compensated_) lost_[c][0] = lost[c];
    }
  }

  /// Takes a step: z_(n+1) = z_n + h sum b_j f_j, and with the second-order form
  /// q_(n+1) = q_n + h M^-1 p_n + h^2 sum b_j (1 - c_j) M^-1 F_j, up to a degree.
  void advance(StageSlopes<Real, Lanes>& stages, const Real& h, int highest) {
    with_addition([&](const auto& add) { advance_with(stages, h, highest, add); });
  }

  /// Takes the step of the degrees from 1 to `highest` by the stages' end map, for a jet that is
  /// stored by rows.
  void advance_by(const EndMap<Real, Lanes>& map, const SliceEvaluator<P, Real>& evaluator,
                  int highest) {
    const auto state = [this](std::size_t component, std::size_t monomial) {
      return rows_[monomial].value.lane(static_cast<int>(component));
    };
    with_addition([&](const auto& add) {
      const auto add_to_row = [&](std::size_t k, const P& step) {
        add(&rows_[k].value, &rows_[k].lost, 0, step);
      };
      for (int d = 1; d <= highest; ++d) {
        map.apply(evaluator, jet_[0].space(), d, state, add_to_row);
      }
    });
  }

 private:
  /// The choice is made once per step, so that the loops over the coefficients have none.
  template <class Advance>
  void with_addition(const Advance& advance) {
    if (is_compensated_) {
      advance([](auto* value, auto* lost, std::size_t k, const auto& increment) {
        add_compensated(value[k], lost[k], increment);
      });
    } else {
      advance(
          [](auto* value, auto*, std::size_t k, const auto& increment) { value[k] += increment; });
    }
  }

  template <class Add>
  void advance_with(StageSlopes<Real, Lanes>& stages, const Real& h, int highest, const Add& add) {
    const auto& system = stages.system();
    const std::size_t m = system.components();
    stages.store_newton_slopes();
    const std::size_t count = jet_[0].space().first(highest + 1);
    if (!system.second_order()) {
      for (std::size_t c = 0; c < m; ++c) {
        add_slopes(c, count, system, stages.evaluator().output(c), h, add);
      }
      return;
    }
    // Positions come first, because they need the momenta at the start of the step.
    for (std::size_t c = 0; c < m; ++c) {
      Real* value = jet_[c].coefficients().data();
      Real* lost = lost_of(c);
      for (std::size_t k = 0; k < count; ++k) {
        Real velocity = jet_[m + c][k];
        if (!system.unit_mass()) {
          velocity = Real(0);
          for (std::size_t i = 0; i < m; ++i) {
            velocity += system.inverse_mass(c, i) * jet_[m + i][k];
          }
        }
        add(value, lost, k,
            Real(h * (velocity + h * dot(system.position_weights(), stages.slope(c, k)))));
      }
      add(value, lost, 0, Real(h * h * dot(system.position_weights_lost(), stages.slope(c, 0))));
    }
    for (std::size_t c = 0; c < m; ++c) {
      add_slopes(m + c, count, system, stages.evaluator().output(c), h, add);
    }
  }

  /// Adds h sum b_j f_j to a component; for the nominal, the rounding residues of b_j are added
  /// too.
  template <class Add>
  void add_slopes(std::size_t component, std::size_t count, const StageSystem<Real, Lanes>& system,
                  const P* slopes, const Real& h, const Add& add) {
    Real* value = jet_[component].coefficients().data();
    Real* lost = lost_of(component);
    for (std::size_t k = 0; k < count; ++k) {
      add(value, lost, k, Real(h * dot(system.weights(), slopes[k])));
    }
    add(value, lost, 0, Real(h * dot(system.weights_lost(), slopes[0])));
  }

  Real* lost_of(std::size_t c) { return is_compensated_ ? lost_[c].data() : nullptr; }

  /// The coefficients of one monomial, and the rounding that they lost.
  struct Row {
    P value;
    P lost;
  };

  bool is_compensated_;
  FlowJet<Real> jet_;
  std::vector<std::vector<Real>> lost_;  ///< by component; empty if not compensated
  std::vector<Row> rows_;                ///< by monomial (degree 0 is not used), or empty
};

}  // namespace hamjet
