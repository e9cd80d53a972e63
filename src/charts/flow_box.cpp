#include "hamjet/charts/flow_box.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "../integrators/gauss/gauss_tolerance.hpp"
#include "../integrators/statistics_sum.hpp"
#include "carried_states.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/error.hpp"
#include "secular_motion.hpp"
#include "steady_turn.hpp"
#include "time_scaled_system.hpp"

namespace hamjet {
namespace {

template <class Real>
SixNumbers<Real> constants_of(const SixNumbers<Series<Real>>& z) {
  return {z[0][0], z[1][0], z[2][0], z[3][0], z[4][0], z[5][0]};
}

/// The steady motion that belongs to an energy and the coordinates of a section in elements.
template <class Real, class T>
SteadyMotion<T> steady_motion(const FlowBoxMap<Real>& map, const T& energy,
                              const SixNumbers<T>& z) {
  using std::sqrt;
  const bool is_nodal = map.start->ignored().has_value();
  const std::size_t pair = pericentre_place(map.start->ignored());
  const T eccentric = (z[pair] * z[pair] + z[pair + 3] * z[pair + 3]) / Real(2);
  const T L = map.mu / sqrt(T(Real(-2) * energy));
  const T H = is_nodal ? z[4] : T(L - eccentric - (z[2] * z[2] + z[5] * z[5]) / Real(2));
  const SecularRates<T> rates =
      secular_rates<Real, T>(energy, eccentric, H, map.mu, map.oblateness);
  const T pericentre = is_nodal ? rates.pericentre : T(rates.pericentre + rates.node);
  const T time = map.advance / (rates.anomaly + pericentre);
  return {time, pericentre * time, rates.node * time};
}

}  // namespace

template <class Real>
SteadyMotion<Real> FlowBoxMap<Real>::steady(const Real& energy, const SixNumbers<Real>& z) const {
  if (start->chart().is_of_elements()) return steady_motion(*this, energy, z);
  return {start->is_bound() ? Real(duration * (Real(1) + start->variable_of(energy))) : duration,
          Real(0), Real(0)};
}

template <class Real>
SteadyMotion<Series<Real>> FlowBoxMap<Real>::steady() const {
  const SpacePointer& space = time.space_pointer();
  if (!start->chart().is_of_elements()) {
    return {start->periods(space) * duration, Series<Real>(space), Series<Real>(space)};
  }
  const auto constant = [&](std::size_t i) { return Series<Real>(space, start->chief()[i]); };
  SixNumbers<Series<Real>> z = {constant(0), constant(1), constant(2),
                                constant(3), constant(4), constant(5)};
  for (std::size_t k = 0; k < start->places().size(); ++k) {
    if (space->order() >= 1) z[start->places()[k]][space->linear_index(k + 1)] = Real(1);
  }
  return steady_motion(*this, start->energies(space), z);
}

template <class Real>
FlowBoxMap<Real> flow_box_map(const ZonalGravity& field,
                              std::shared_ptr<const FlowSection<Real>> start,
                              std::shared_ptr<const FlowSection<Real>> end, const Real& duration,
                              Series<Real> time, std::vector<Series<Real>> coordinates) {
  FlowBoxMap<Real> map{std::move(start),
                       std::move(end),
                       duration,
                       Real(0),
                       Real(field.J[2]) * Real(field.radius) * Real(field.radius),
                       Real(field.mu),
                       std::move(time),
                       std::move(coordinates)};
  if (map.start->chart().is_of_elements()) {
    map.advance = Real(1);
    map.advance = duration / map.steady(map.start->energy(), map.start->chief()).time;
  }
  return map;
}

template <class Real>
FlowBoxPropagation<Real>::FlowBoxPropagation(const ZonalGravity& field, ChartName chart,
                                             const SixNumbers<Real>& chief, int order,
                                             const GaussSettings& settings)
    : field_(field),
      crossing_(time_scaled_first_order(zonal_gravity(field))),
      settings_(settings),
      chart_(chart),
      start_(std::make_shared<const FlowSection<Real>>(field, chart, chief)),
      flow_{time_scaled(zonal_gravity(field)), {}, {}, {}, ClockTime::epoch()},
      periods_(start_->periods(SeriesSpace::create(start_->variables(), order))) {
  const SpacePointer& space = periods_.space_pointer();
  const auto z = start_->states(space);
  flow_.space = space;
  flow_.symmetry = FlowSymmetry::none;
  // Which states each variable moves follows from the initial jet; where sizes of lines are chosen,
  // all variables count as positions.
  for (std::size_t k = 0; k < space->variables(); ++k) flow_.variables.push_back(k % 3);
  flow_.initial_jet = FlowJet<Real>{z[0],
                                    z[1],
                                    z[2],
                                    (square(periods_) - Real(1)) * Real(scale_parameter_unit),
                                    z[3] * periods_,
                                    z[4] * periods_,
                                    z[5] * periods_,
                                    Series<Real>(space)};
}

namespace {

/// The map of states that started on the start's section and have come, after flights of these
/// times, to states z near the chief. They are carried on to the section through the chief there.
template <class Real>
FlowBoxMap<Real> map_of_flights(const ZonalGravity& field, const SharedSystem& crossing,
                                std::shared_ptr<const FlowSection<Real>> start,
                                const Real& duration, SixNumbers<Series<Real>> z,
                                Series<Real> flight) {
  const auto end =
      std::make_shared<const FlowSection<Real>>(field, start->chart().name(), constants_of(z));
  SixNumbers<Series<Real>> c = end->chart().coordinates(z);
  // Each iteration of Newton's method with the chief's rate makes one more degree right.
  for (int i = 0; i < z[0].order(); ++i) {
    Series<Real> left = (end->chief()[0] - c[0]) / end->rate();
    left[0] = Real(0);
    z = carried(crossing, z, left);
    flight += left;
    c = end->chart().coordinates(z);
  }

  FlowBoxMap<Real> map =
      flow_box_map<Real>(field, std::move(start), end, duration, std::move(flight), {});
  const SteadyMotion<Series<Real>> steady = map.steady();
  map.time -= steady.time;
  turn_steadily(*end, SteadyMotion<Series<Real>>{-steady.time, -steady.pericentre, -steady.node},
                c);
  for (const std::size_t place : end->places()) map.coordinates.push_back(c[place]);
  if (end->ignored()) {
    map.coordinates.push_back(c[*end->ignored()] - map.start->chief()[*end->ignored()] -
                              steady.node);
    map.coordinates.back()[0] = within_half_a_turn(map.coordinates.back()[0]);
  }
  return map;
}

}  // namespace

template <class Real>
FlowBoxMap<Real> FlowBoxPropagation<Real>::advance_to(const Real& time) {
  flow_.duration = time - reached_;
  FlowJet<Real>& jet = *flow_.initial_jet;
  flow_.initial_state.clear();
  for (const auto& component : jet) flow_.initial_state.push_back(component[0]);
  IntegrationStatistics statistics;
  // A part that is no longer than another one, of the same orbit, needs no shorter steps.
  constexpr double alike = 1.01;
  using std::abs;
  const auto length = static_cast<double>(Real(abs(flow_.duration)));
  if (step_tolerance_ && length <= alike * tried_) {
    jet = integrate_with_step_tolerance<Real>(flow_, settings_, *step_tolerance_, statistics);
  } else {
    jet = integrate_gauss<Real>(flow_, settings_, statistics);
    step_tolerance_ = statistics.step_tolerance;
    tried_ = length;
  }
  flow_.start_time = flow_.start_time + flow_.duration;
  add_integration(total_, statistics);
  reached_ = time;
  return map_of_flights<Real>(
      field_, crossing_, start_, time,
      {jet[0], jet[1], jet[2], jet[4] / periods_, jet[5] / periods_, jet[6] / periods_},
      periods_ * time);
}

template <class Real>
FlowBoxMap<Real> flow_box_map_of_jet(const ZonalGravity& field, ChartName chart,
                                     const SixNumbers<Real>& chief, const Real& duration,
                                     const FlowMap<Real>& jet) {
  if (jet.components() != 6 || jet.variables() != 6) {
    throw Error(ErrorKind::usage, "flow box: a jet of six components in six variables is needed");
  }
  const auto start = std::make_shared<const FlowSection<Real>>(field, chart, chief);
  const SpacePointer space = SeriesSpace::create(start->variables(), jet.space()->order());
  const SixNumbers<Series<Real>> from = start->states(space);
  const std::vector<Series<Real>> z =
      compose(jet.jet(), without_constants(std::vector<Series<Real>>(from.begin(), from.end())));
  return map_of_flights<Real>(field, time_scaled_first_order(zonal_gravity(field)), start, duration,
                              {z[0], z[1], z[2], z[3], z[4], z[5]}, Series<Real>(space, duration));
}

template <class Real>
ChartName section_chart(const SixNumbers<Real>& z, const Real& mu) {
  for (const ChartName chart : {ChartName::nodal, ChartName::poincare}) {
    try {
      CanonicalChart<Real>(chart, z, mu);
      return chart;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
    }
  }
  return ChartName::spherical;
}

template struct FlowBoxMap<InstantiatedReal>;
template FlowBoxMap<InstantiatedReal> flow_box_map(
    const ZonalGravity&, std::shared_ptr<const FlowSection<InstantiatedReal>>,
    std::shared_ptr<const FlowSection<InstantiatedReal>>, const InstantiatedReal&,
    Series<InstantiatedReal>, std::vector<Series<InstantiatedReal>>);
template class FlowBoxPropagation<InstantiatedReal>;
template FlowBoxMap<InstantiatedReal> flow_box_map_of_jet(const ZonalGravity&, ChartName,
                                                          const SixNumbers<InstantiatedReal>&,
                                                          const InstantiatedReal&,
                                                          const FlowMap<InstantiatedReal>&);
template ChartName section_chart(const SixNumbers<InstantiatedReal>&, const InstantiatedReal&);

}  // namespace hamjet
