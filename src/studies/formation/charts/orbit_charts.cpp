#include "orbit_charts.hpp"

#include <algorithm>

#include "deputy_flows.hpp"
#include "hamjet/charts/charted_map.hpp"

namespace hamjet {
namespace {

/// The gravitational parameter of an orbit in its canonical units.
const Extended extended_mu = 1;

SixNumbers<Extended> extended_state(std::span<const double> state) {
  SixNumbers<Extended> result;
  std::copy_n(state.begin(), result.size(), result.begin());
  return result;
}

}  // namespace

OrbitCharts::OrbitCharts(const CoordinatesAtEnds& coordinates, std::span<const double> start,
                         std::span<const double> end)
    : start_state_(extended_state(start)),
      start_(chart_of(coordinates.start), start_state_, extended_mu),
      end_(chart_of(coordinates.end), extended_state(end), extended_mu) {}

FlowMap<Extended> OrbitCharts::into(const FlowMap<Extended>& jet) const {
  return in_charts(jet, start_, start_state_, end_);
}

FlowMap<Extended> OrbitCharts::out_of(const FlowMap<Extended>& map) const {
  return out_of_charts(map, start_, start_state_, end_);
}

void round_to(Precision precision, FlowJet<Extended>& jet) {
  if (precision != Precision::double_precision) return;
  for (Series<Extended>& component : jet) {
    for (Extended& c : component.coefficients()) c = static_cast<double>(c);
  }
}

}  // namespace hamjet
