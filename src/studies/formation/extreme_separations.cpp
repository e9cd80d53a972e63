#include "extreme_separations.hpp"

#include "../../algebra/state_sums.hpp"
#include "single_transfer.hpp"

namespace hamjet {

double separation_m(const RelativeState& state) { return state.position_m.norm(); }

SeparationExtremes::SeparationExtremes(const Scene& scene, RelativeFrame frame)
    : units_(metric_units(scene)), frame_(frame) {}

void SeparationExtremes::add(const FlightArc& arc) {
  const ArcCurve curve = separation_along(arc, 0, 1);
  const auto look = [&](ExtremeDistance& extreme, SeparationAt& at) {
    if (!extreme.add(arc, curve)) return;
    const std::vector<double> chief = arc.state(0, extreme.share());
    const std::vector<double> difference = state_difference(arc.state(1, extreme.share()), chief);
    at = {extreme.time(), ChiefFrame(chief, units_, frame_).relative(difference)};
  };
  look(least_, found_.nearest);
  look(greatest_, found_.farthest);
}

ExtremeSeparations extreme_separations(const Scene& scene, const std::vector<double>& deviation,
                                       RelativeFrame frame, double time) {
  SeparationExtremes extremes(scene, frame);
  fly_arcs(make_system(scene), {scene.nominal, state_sum(scene.nominal, deviation)},
           scene.start_time, time, [&](const FlightArc& arc) { extremes.add(arc); });
  return extremes.found();
}

}  // namespace hamjet
