#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"

namespace hamjet {

/// A surface across the flow of a zonal field through one state, the chief's: the states whose
/// first coordinate in a chart (the angle along the orbit) is the chief's. A state on the surface
/// is given by its energy and the chart's other coordinates, without the momentum of that angle,
/// which follows from H = E. Together with the time tau from the surface, (tau, E) is a further
/// canonical pair: a state z is reached from a state on the surface by the flow over the time tau.
///
/// The variables u of the surface are
///
///   u_0       stands for the energy: where the chief is bound, P/P_chief - 1 with the period
///             P = 2 pi mu (-2 E)^(-3/2) of Kepler's ellipse of that energy; otherwise the
///             difference of E in units of mu over the chief's distance
///   u_1, ...  differences from the chief's of the coordinates in `places`, in the chart's units
///
/// There are five, or four in the nodal chart, because the field does not depend on the node
/// (`ignored`). The period is taken because a time of flight is nearly linear in it, and far from
/// linear in the energy.
///
/// Source: the reduction of the energy, in V. I. Arnold, Mathematical Methods of Classical
/// Mechanics, 2nd ed., section 45.
template <class Real>
class FlowSection {
 public:
  /// The surface through the chief's state. Throws Error(numerical) where the chart does not exist
  /// there, Error(usage) for a chart without an angle along the orbit.
  FlowSection(const ZonalGravity& field, ChartName chart, const SixNumbers<Real>& chief);

  const CanonicalChart<Real>& chart() const noexcept { return chart_; }
  /// The state through which the surface goes, as it was given.
  const SixNumbers<Real>& origin() const noexcept { return origin_; }
  /// The chief's coordinates in the chart.
  const SixNumbers<Real>& chief() const noexcept { return chief_; }
  const Real& energy() const noexcept { return energy_; }
  const Real& energy_unit() const noexcept { return energy_unit_; }
  /// Whether the chief's orbit is an ellipse whose period serves as a variable.
  bool is_bound() const { return energy_ < Real(-least_binding) * energy_unit_; }
  /// The rate of the angle at the chief.
  const Real& rate() const noexcept { return rate_; }
  std::size_t variables() const noexcept { return places_.size() + 1; }
  /// The indices, among the chart's coordinates, of u_1, ...
  const std::vector<std::size_t>& places() const noexcept { return places_; }
  std::optional<std::size_t> ignored() const noexcept { return ignored_; }

  /// The energy that belongs to u_0, and the inverse.
  Real energy_of(const Real& u0) const;
  Real variable_of(const Real& energy) const;
  /// The energy and P/P_chief (1 where the chief is not bound), as series in u.
  Series<Real> energies(const SpacePointer& space) const;
  Series<Real> periods(const SpacePointer& space) const;

  /// The states on the surface as series in u; their ignored coordinate is the chief's.
  SixNumbers<Series<Real>> states(const SpacePointer& space) const;
  /// The state on the surface with this energy and these coordinates of the chart, of which
  /// `coordinates[0]` and `[3]` are not read. Throws Error(numerical) if there is no such state
  /// near the chief.
  SixNumbers<Real> state(const Real& energy, SixNumbers<Real> coordinates) const;

 private:
  SharedSystem system_;
  CanonicalChart<Real> chart_;
  SixNumbers<Real> origin_;
  SixNumbers<Real> chief_;
  Real energy_;
  Real energy_unit_;
  Real rate_;
  std::vector<std::size_t> places_;
  std::optional<std::size_t> ignored_;
};

}  // namespace hamjet
