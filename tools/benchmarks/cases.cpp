#include "cases.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/studies/propagation.hpp"

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
  field.J[3] = 0;
  const std::vector<std::size_t> plane = {0, 1};
  return {restrict_system(zonal_gravity(field), plane),
          SeriesSpace::create(4, order),
          all_variables(4),
          {1, 0, 0, std::sqrt(1.3)}};
}

double worst_error(const FlowJet<double>& jet, const FlowJet<Extended>& reference) {
  const std::vector<double> errors =
      relative_error_by_degree(convert_map<Extended>(jet), reference);
  return *std::max_element(errors.begin(), errors.end());
}

FlowJet<Extended> reference_jet(const Case& c) {
  const FlowProblem<Extended> problem{c.system,
                                      c.space,
                                      c.variables,
                                      {c.nominal.begin(), c.nominal.end()},
                                      hamjet::ClockTime::epoch(),
                                      c.duration};
  GaussSettings settings;
  settings.stages = 16;
  settings.tolerance = 1e-20;
  IntegrationStatistics statistics;
  return integrate_gauss<Extended>(problem, settings, statistics);
}

}  // namespace hamjet::benchmarks
