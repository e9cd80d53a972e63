#include "keep_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "../../algebra/state_sums.hpp"
#include "../checks/flight_checks.hpp"
#include "../flights/extreme_distance.hpp"
#include "single_transfer.hpp"

namespace hamjet {

double keep_out_ratio(const FlownTogether& both, const std::vector<double>& chief,
                      const std::vector<double>& deviation, const ClockTime& start_time,
                      double time) {
  const Scene& scene = both.scene();
  const Eigen::Vector3d semi_axes = *scene.transfer->keep_out_m / metric_units(scene).length_m;
  ExtremeDistance least(ExtremeDistance::Kind::least);
  fly_arcs(both.system(), {both.of_chief(chief), both.of_deputy(state_sum(chief, deviation))},
           start_time, time, [&](const FlightArc& arc) {
             ArcCurve curve = rtn_separation_along(arc, 0, 1);
             for (std::size_t i = 0; i < 3; ++i) {
               curve[i] /= semi_axes[static_cast<Eigen::Index>(i)];
             }
             least.add(arc, curve);
           });
  return least.distance();
}

WayLimits::WayLimits(const Scene& scene)
    : both_(scene),
      surface_(surface_limit(scene)),
      ratio_(std::numeric_limits<double>::infinity()),
      lowest_(ratio_) {}

void WayLimits::fly(const std::vector<double>& chief, const std::vector<double>& deviation,
                    const ClockTime& start_time, double time) {
  if (both_.scene().transfer->keep_out_m) {
    ratio_ = std::min(ratio_, keep_out_ratio(both_, chief, deviation, start_time, time));
  }
  if (surface_) {
    const std::vector<double> deputy = both_.of_deputy(state_sum(chief, deviation));
    lowest_ = std::min(lowest_, lowest_point(both_.system(), deputy, start_time, time).distance);
  }
}

std::string WayLimits::forbidden() const {
  if (ratio_ < 1)
    return fmt::format("its way comes within {:.3g} times the ellipsoid keep_out_m", ratio_);
  if (surface_ && lowest_ < *surface_) {
    return fmt::format("its way passes {:.6g} km below the surface",
                       (*surface_ - lowest_) * both_.scene().units.length_km);
  }
  return "";
}

}  // namespace hamjet
