#include "hamjet/charts/flow_box_states.hpp"

#include <utility>

#include "carried_states.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "series_energy.hpp"
#include "steady_turn.hpp"
#include "time_scaled_system.hpp"

namespace hamjet {
namespace {

/// The section's variables u, the time since the section, and the difference in the ignored
/// coordinate, as series for states about the chief's.
struct SectionEntry {
  std::vector<Series<double>> variables;
  Series<double> time;
  Series<double> ignored;
};

SectionEntry entry_to(const FlowSection<double>& section, const ZonalGravity& field, int order) {
  const SpacePointer space = SeriesSpace::create(6, order);
  const SixNumbers<double> chief = section.chart().state(section.chief());
  const auto component = [&](std::size_t i) {
    return Series<double>::variable(space, i, chief[i]);
  };
  SixNumbers<Series<double>> z = {component(0), component(1), component(2),
                                  component(3), component(4), component(5)};
  const Series<double> energy = energy_series(zonal_gravity(field), z);
  const SharedSystem crossing = time_scaled_first_order(zonal_gravity(field));
  SectionEntry entry{{}, Series<double>(space), Series<double>(space)};
  SixNumbers<Series<double>> c = section.chart().coordinates(z);
  // Newton's method with the chief's rate, as in FlowBoxPropagation: each iteration makes one more
  // degree right.
  for (int i = 0; i < order; ++i) {
    Series<double> left = (section.chief()[0] - c[0]) / section.rate();
    left[0] = 0;
    z = carried(crossing, z, left);
    entry.time -= left;
    c = section.chart().coordinates(z);
  }
  Series<double> excess = energy / energy[0];
  entry.variables.push_back(section.is_bound() ? pow(excess, -1.5) - 1.0
                                               : (energy - energy[0]) / section.energy_unit());
  for (const std::size_t place : section.places()) {
    entry.variables.push_back(c[place] - section.chief()[place]);
  }
  for (Series<double>& variable : entry.variables) variable[0] = 0;
  if (section.ignored())
    entry.ignored = c[*section.ignored()] - section.chief()[*section.ignored()];
  entry.ignored[0] = 0;
  return entry;
}

}  // namespace

std::vector<Series<double>> flow_box_coordinates(const ZonalGravity& field,
                                                 const FlowBoxMap<double>& map) {
  const FlowSection<double>& end = *map.end;
  const int order = map.time.order();
  // The flight from section to section.
  const SteadyMotion<Series<double>> steady = map.steady();
  const SpacePointer& space = map.time.space_pointer();
  const auto constant = [&](std::size_t i) { return Series<double>(space, end.chief()[i]); };
  SixNumbers<Series<double>> c = {constant(0), constant(1), constant(2),
                                  constant(3), constant(4), constant(5)};
  for (std::size_t k = 0; k < end.places().size(); ++k) c[end.places()[k]] = map.coordinates[k];
  turn_steadily(end, steady, c);
  std::vector<Series<double>> values = {map.time + steady.time};
  for (const std::size_t place : end.places()) values.push_back(c[place]);
  if (end.ignored()) values.push_back(map.coordinates.back() + steady.node);

  const SectionEntry entry = entry_to(*map.start, field, order);
  std::vector<Series<double>> arrived = compose(without_constants(values), entry.variables);
  std::vector<Series<double>> result = {entry.time - arrived[0]};
  // The energy is that of the start. Its unit, the chief's period at the start, serves at the end
  // too.
  result.push_back(entry.variables[0]);
  for (std::size_t k = 0; k < end.places().size(); ++k) result.push_back(arrived[k + 1]);
  if (end.ignored()) result.push_back(entry.ignored + arrived.back());
  return result;
}

FlowMap<double> flow_box_jet(const ZonalGravity& field, const FlowBoxMap<double>& map) {
  const FlowSection<double>& end = *map.end;
  const std::vector<Series<double>> arrived = flow_box_coordinates(field, map);
  const SpacePointer& space = arrived[0].space_pointer();
  const auto constant = [&](std::size_t i) { return Series<double>(space, end.chief()[i]); };
  SixNumbers<Series<double>> c = {constant(0), constant(1), constant(2),
                                  constant(3), constant(4), constant(5)};
  for (std::size_t k = 0; k < end.places().size(); ++k) c[end.places()[k]] += arrived[k + 2];
  if (end.ignored()) c[*end.ignored()] += arrived.back();
  // The energy that belongs to its variable, about the chief's own energy at the end.
  const Series<double> energy = map.start->is_bound()
                                    ? end.energy() * pow(arrived[1] + 1.0, -2.0 / 3)
                                    : arrived[1] * map.start->energy_unit() + end.energy();
  const SharedSystem system(zonal_gravity(field));
  for (int i = 0; i <= space->order(); ++i) {
    Series<double> excess = energy_series(*system, end.chart().state(c)) - energy;
    excess[0] = 0;
    c[3] -= excess / end.rate();
  }
  SixNumbers<Series<double>> z = end.chart().state(c);
  for (std::size_t i = 0; i < 6; ++i) z[i][0] = end.origin()[i];
  z = carried(time_scaled_first_order(zonal_gravity(field)), z, arrived[0]);
  return FlowMap<double>({z[0], z[1], z[2], z[3], z[4], z[5]});
}

std::array<std::string, 6> coordinate_names(ChartName chart) {
  switch (chart) {
    case ChartName::cartesian:
      return {"x", "y", "z", "vx", "vy", "vz"};
    case ChartName::spherical:
      return {"alpha", "r", "beta", "p_alpha", "p_r", "p_beta"};
    case ChartName::cylindrical:
      return {"phi", "rho", "z", "L_z", "p_rho", "p_z"};
    case ChartName::poincare:
      return {"l+g+h", "eccentric_q", "inclined_q", "L", "eccentric_p", "inclined_p"};
    default:
      return {"l+g", "h", "eccentric_q", "L", "H", "eccentric_p"};
  }
}

std::array<std::string, 6> flow_box_coordinate_names(const FlowSection<double>& section) {
  const std::array<std::string, 6> names = coordinate_names(section.chart().name());
  std::array<std::string, 6> result = {"tau", section.is_bound() ? "period" : "energy"};
  std::size_t next = 2;
  for (const std::size_t place : section.places()) result[next++] = names[place];
  if (section.ignored()) result[next] = names[*section.ignored()];
  return result;
}

}  // namespace hamjet
