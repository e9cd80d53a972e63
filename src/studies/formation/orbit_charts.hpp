#pragma once

#include <span>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/maps/flow_map.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Between the positions and momenta of an orbit's jet and the coordinates of one pair of charts
/// about the chief, which must not be flow boxes nor automatic. In extended precision, for what is
/// stored.
class OrbitCharts {
 public:
  /// Of the chief's canonical states at both ends. Throws as CanonicalChart.
  OrbitCharts(const CoordinatesAtEnds& coordinates, std::span<const double> start,
              std::span<const double> end);

  FlowMap<Extended> into(const FlowMap<Extended>& jet) const;
  FlowMap<Extended> out_of(const FlowMap<Extended>& map) const;

 private:
  SixNumbers<Extended> start_state_;
  CanonicalChart<Extended> start_;
  CanonicalChart<Extended> end_;
};

/// Rounds a jet that is of double precision to the numbers that such have.
void round_to(Precision precision, FlowJet<Extended>& jet);

}  // namespace hamjet
