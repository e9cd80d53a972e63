#pragma once

#include <span>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/maps/flow_map.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Converts between the positions and momenta of an orbit's jet and the coordinates of one pair of
/// charts about the chief, which must not be flow boxes nor automatic. It works in extended
/// precision, for jets that are stored.
class OrbitCharts {
 public:
  /// Takes the chief's canonical states at both ends. Throws as CanonicalChart.
  OrbitCharts(const CoordinatesAtEnds& coordinates, std::span<const double> start,
              std::span<const double> end);

  FlowMap<Extended> into(const FlowMap<Extended>& jet) const;
  FlowMap<Extended> out_of(const FlowMap<Extended>& map) const;

 private:
  SixNumbers<Extended> start_state_;
  CanonicalChart<Extended> start_;
  CanonicalChart<Extended> end_;
};

/// Rounds the coefficients of a jet to double precision, if that is its precision.
void round_to(Precision precision, FlowJet<Extended>& jet);

}  // namespace hamjet
