#pragma once

#include <string>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The deputy at one time, as polynomials say.
struct DeputyMotionPoint {
  double time = 0;               ///< canonical
  RelativeState state;           ///< by the polynomial of the highest order
  std::vector<double> errors_m;  ///< of orders 1..N: distance from where the deputy flew to
};

/// How the scene's deputy moves relative to the chief.
struct DeputyMotion {
  Scene scene;  ///< with `deputy`
  std::string integrator;
  std::vector<DeputyMotionPoint> points;  ///< the first one is the start
  RelativeTrajectory flown;               ///< at the same times
  double flight_floor_m = 0;              ///< see TransferResult; errors below it say nothing
  double propagation_seconds = 0;

  double separation_m(std::size_t point) const { return points[point].state.position_m.norm(); }
  /// The largest error of an order over all times.
  double largest_error_m(int order) const;
};

/// The motion of the scene's deputy over the scene's duration, without velocity changes: by the
/// jets at equal times, some tens a revolution, and flown with the full equations of motion, which
/// gives the polynomials' errors. Throws as study_transfer.
DeputyMotion study_deputy_motion(const Scene& scene, const ProgressCallback& progress = {});

}  // namespace hamjet
