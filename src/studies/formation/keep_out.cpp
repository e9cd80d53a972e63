#include "keep_out.hpp"

#include "extreme_separations.hpp"
#include "flown_trajectory.hpp"

namespace hamjet {

double keep_out_ratio(const Scene& scene, const std::vector<double>& chief,
                      const std::vector<double>& deviation, double time) {
  // Between two of them cubic interpolation finds where to look.
  constexpr IntervalCount points_of_way = {32, 48, 2048};
  Scene from_here = scene;
  from_here.nominal = chief;
  const RelativeTrajectory flown =
      flown_trajectory(from_here, deviation, RelativeFrame::rtn_rotating, time,
                       interval_count(from_here, time, points_of_way));
  return least_ratio(from_here, flown, *scene.transfer->keep_out_m);
}

}  // namespace hamjet
