#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/maps/generating_function.hpp"
#include "hamjet/maps/map_evaluator.hpp"
#include "hamjet/maps/symplecticity.hpp"

namespace hamjet {

/// A flow's jet as a value: the Taylor polynomial of the final state in the deviations of the
/// initial one from a nominal, as the integrators give it,
///
///   z_i(d) = sum over |k| <= N of a_i,k d^k ,   a_i,0 the nominal's final state,
///
/// in the system's own units. It owns its coefficients and its space, so that it may outlive
/// everything from which it was made; a copy shares the space, which cannot change. All functions
/// are const: threads may share one. After a move the source may only be assigned to or destroyed.
///
/// T is double or Extended. The functions for maps of series (composition.hpp, map_evaluator.hpp,
/// symplecticity.hpp, generating_function.hpp) do the work and document the methods.
template <class T>
class FlowMap {
 public:
  /// Takes over a jet, one series per component. Throws Error(usage) if it is empty, or if the
  /// series do not share one space.
  explicit FlowMap(std::vector<Series<T>> jet) : jet_(std::move(jet)) {
    if (jet_.empty()) throw Error(ErrorKind::usage, "flow map: no components");
    for (const Series<T>& component : jet_) require_same_space(component.space(), *space());
  }

  const std::vector<Series<T>>& jet() const& noexcept { return jet_; }
  /// The jet itself, moved out of a map that is no longer needed.
  std::vector<Series<T>> jet() && noexcept { return std::move(jet_); }
  SpacePointer space() const noexcept { return jet_.front().space_pointer(); }
  int order() const noexcept { return space()->order(); }
  std::size_t components() const noexcept { return jet_.size(); }
  std::size_t variables() const noexcept { return space()->variables(); }

  /// The map from initial to final deviations in double precision, prepared for many points. The
  /// nominal is left out, for beside its large numbers small deviations would lose their digits.
  /// Terms above `degree`, if given, are left out. Throws Error(usage) for a degree outside 0 to
  /// the order.
  MapEvaluator evaluator(std::optional<int> degree = {}) const {
    return MapEvaluator(without_constants(convert_map<double>(jet_)), degree);
  }
  /// The final deviation, one number per component, of one initial deviation, one number per
  /// variable. Every call prepares an evaluator; for many points, call evaluator() once. Throws
  /// Error(usage) for another count.
  std::vector<double> evaluate(std::span<const double> deviation) const {
    std::vector<double> values(components());
    evaluator().evaluate(deviation, {.values = values, .last = {}, .last_but_one = {}});
    return values;
  }

  /// The state transition matrix, the derivative of z by d on the nominal, components x variables.
  Matrix<T> linear_part() const { return hamjet::linear_part(jet_); }

  /// The map without the terms above `order`, in the space of that order. Throws Error(usage) for
  /// an order outside 0 to the map's own.
  FlowMap truncated(int order) const {
    if (order == this->order()) return *this;
    if (order > this->order()) throw Error(ErrorKind::usage, "flow map: it has not that order");
    const SpacePointer lower = SeriesSpace::create(variables(), order);
    std::vector<Series<T>> jet;
    for (const Series<T>& component : jet_) {
      const auto kept = component.coefficients().first(lower->size());
      jet.emplace_back(lower, std::vector<T>(kept.begin(), kept.end()));
    }
    return FlowMap(std::move(jet));
  }

  /// The composition next o this, of the lower of the two orders: the flow over the duration of
  /// this map and then over that of `next`. The nominal of `next` must start where the nominal of
  /// this map ends, which is not checked. Throws Error(usage) unless `next` has a variable for each
  /// component of this map.
  FlowMap followed_by(const FlowMap& next) const {
    const auto inner = without_constants(truncated(std::min(order(), next.order())).jet());
    return FlowMap(compose(next.jet_, inner));
  }

  /// The inverse flow, from deviations at the nominal's end to the state at its start. The
  /// nominal's start is `start`, one number per component. Throws Error(usage) for other sizes, or
  /// unless there are as many components as variables; Error(numerical) if the linear part is
  /// singular.
  FlowMap inverse(const std::vector<T>& start) const {
    if (start.size() != components()) {
      throw Error(ErrorKind::usage, "flow map: the start must have a number for each component");
    }
    auto back = hamjet::inverse(without_constants(jet_));
    for (std::size_t i = 0; i < back.size(); ++i) back[i][0] = start[i];
    return FlowMap(std::move(back));
  }

  /// Defects of the degrees 0..N-1 from symplecticity. Throws Error(usage) unless the map has 2n
  /// components in 2n variables.
  std::vector<SymplecticityDefect> symplecticity() const { return symplecticity_by_degree(jet_); }

  /// The generating function of a kind, a polynomial of degrees 2..N+1 in the variables w of the
  /// kind. Throws as invert_partially, whose result also has the condition of the inversion.
  Series<T> generating_function(const GeneratingFunctionKind& kind) const {
    return hamjet::generating_function(one_form(invert_partially(jet_, kind)));
  }

 private:
  std::vector<Series<T>> jet_;
};

}  // namespace hamjet
