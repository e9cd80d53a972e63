#include "cases.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet::benchmarks {
namespace {

std::vector<std::size_t> all_variables(std::size_t count) {
  std::vector<std::size_t> result(count);
  std::iota(result.begin(), result.end(), std::size_t{0});
  return result;
}

}  // namespace

Case paper_case(const ZonalGravity& field, int order) {
  const double speed = std::sqrt(1.3);
  return {zonal_gravity(field),
          SeriesSpace::create(6, order),
          all_variables(6),
          {1, 0, 0, 0, speed / 2, speed * std::sqrt(0.75)}};
}

Case planar_case(int order) {
  ZonalGravity field = paper_field;
  field.J3 = 0;
  const std::vector<std::size_t> plane = {0, 1};
  return {restrict_system(zonal_gravity(field), plane),
          SeriesSpace::create(4, order),
          all_variables(4),
          {1, 0, 0, std::sqrt(1.3)}};
}

double worst_error(const FlowJet<double>& jet, const FlowJet<Extended>& reference) {
  const SeriesSpace& space = reference[0].space();
  double worst = 0;
  for (int d = 0; d <= space.order(); ++d) {
    double difference = 0;
    double largest = 0;
    for (std::size_t i = 0; i < jet.size(); ++i) {
      for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
        difference = std::max(difference,
                              std::abs(static_cast<double>(Extended(reference[i][k] - jet[i][k]))));
        largest = std::max(largest, std::abs(static_cast<double>(reference[i][k])));
      }
    }
    worst = std::max(worst, difference / largest);
  }
  return worst;
}

FlowJet<Extended> reference_jet(const Case& c) {
  const FlowProblem<Extended> problem{
      &c.system, c.space, c.variables, {c.nominal.begin(), c.nominal.end()}, c.duration};
  GaussSettings settings;
  settings.stages = 16;
  settings.tolerance = 1e-20;
  IntegrationStatistics statistics;
  return integrate_gauss<Extended>(problem, settings, statistics);
}

}  // namespace hamjet::benchmarks
