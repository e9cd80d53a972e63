#include "hamjet/charts/charted_map.hpp"

#include <utility>
#include <vector>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "linear_chart.hpp"

namespace hamjet {
namespace {

template <class Real>
SixNumbers<Series<Real>> six(const std::vector<Series<Real>>& map) {
  return {map[0], map[1], map[2], map[3], map[4], map[5]};
}

template <class Real>
std::vector<Series<Real>> deviations(const SixNumbers<Series<Real>>& z) {
  return without_constants(std::vector<Series<Real>>(z.begin(), z.end()));
}

template <class Real>
void require_six(const FlowMap<Real>& map) {
  if (map.components() != 6 || map.variables() != 6) {
    throw Error(ErrorKind::usage, "charts: a jet of six components in six variables is needed");
  }
}

template <class Real>
FlowMap<Real> as_map(const SixNumbers<Series<Real>>& z) {
  return FlowMap<Real>(std::vector<Series<Real>>(z.begin(), z.end()));
}

}  // namespace

template <class Real>
FlowMap<Real> in_charts(const FlowMap<Real>& jet, const CanonicalChart<Real>& start,
                        const SixNumbers<Real>& start_state, const CanonicalChart<Real>& end) {
  require_six(jet);
  const auto from = start.state(moved(start.coordinates(start_state), jet.space()));
  return as_map<Real>(end.coordinates(six(compose(jet.jet(), deviations(from)))));
}

template <class Real>
FlowMap<Real> out_of_charts(const FlowMap<Real>& map, const CanonicalChart<Real>& start,
                            const SixNumbers<Real>& start_state, const CanonicalChart<Real>& end) {
  require_six(map);
  const auto from = start.coordinates(moved(start_state, map.space()));
  return as_map<Real>(end.state(six(compose(map.jet(), deviations(from)))));
}

template FlowMap<InstantiatedReal> in_charts(const FlowMap<InstantiatedReal>&,
                                             const CanonicalChart<InstantiatedReal>&,
                                             const SixNumbers<InstantiatedReal>&,
                                             const CanonicalChart<InstantiatedReal>&);
template FlowMap<InstantiatedReal> out_of_charts(const FlowMap<InstantiatedReal>&,
                                                 const CanonicalChart<InstantiatedReal>&,
                                                 const SixNumbers<InstantiatedReal>&,
                                                 const CanonicalChart<InstantiatedReal>&);

}  // namespace hamjet
