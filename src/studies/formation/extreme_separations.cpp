#include "extreme_separations.hpp"

#include "../../algebra/state_sums.hpp"
#include "../flights/extreme_distance.hpp"
#include "single_transfer.hpp"

namespace hamjet {

double separation_m(const RelativeState& state) { return state.position_m.norm(); }

ExtremeSeparations extreme_separations(const Scene& scene, const std::vector<double>& deviation,
                                       RelativeFrame frame, double time) {
  const MetricUnits units = metric_units(scene);
  const std::vector<double> deputy = state_sum(scene.nominal, deviation);
  ExtremeDistance least(ExtremeDistance::Kind::least);
  ExtremeDistance greatest(ExtremeDistance::Kind::greatest);
  ExtremeSeparations found;
  fly_arcs(make_system(scene), {scene.nominal, deputy}, scene.start_time, time,
           [&](const FlightArc& arc) {
             const ArcCurve curve = separation_along(arc, 0, 1);
             const auto look = [&](ExtremeDistance& extreme, SeparationAt& at) {
               if (!extreme.add(arc, curve)) return;
               const std::vector<double> chief = arc.state(0, extreme.share());
               const std::vector<double> difference =
                   state_difference(arc.state(1, extreme.share()), chief);
               at = {extreme.time(), ChiefFrame(chief, units, frame).relative(difference)};
             };
             look(least, found.nearest);
             look(greatest, found.farthest);
           });
  return found;
}

}  // namespace hamjet
