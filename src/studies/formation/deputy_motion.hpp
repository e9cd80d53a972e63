#pragma once

#include <optional>
#include <string>
#include <vector>

#include "extreme_separations.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/relative_drift.hpp"
#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The deputy at one time.
struct DeputyMotionPoint {
  double time = 0;               ///< canonical
  RelativeState state;           ///< as it flew
  std::vector<double> errors_m;  ///< of the polynomials of orders 1..N: distance from there
  /// Rounding of the flights to here, which go on from time to time; errors below it say nothing.
  double flight_floor_m = 0;
};

/// How the scene's deputy moves relative to the chief.
struct DeputyMotion {
  Scene scene;  ///< with `deputy`
  std::string integrator;
  ChosenCoordinates coordinates;          ///< of the polynomials; not automatic
  std::vector<DeputyMotionPoint> points;  ///< the first one is the start
  RelativeTrajectory flown;               ///< at these times and at others between them
  ExtremeSeparations extremes;            ///< as it flew, between the times too
  std::optional<RelativeDrift> drift;     ///< of the deputy at its start
  double flight_floor_m = 0;              ///< the largest of the times
  double propagation_seconds = 0;
  std::vector<SelfCheck> checks;  ///< of the flights of both

  /// The largest error of an order over all times.
  double largest_error_m(int order) const;
};

/// The motion of the scene's deputy over the scene's duration, without velocity changes: flown with
/// the full equations of motion to times that are equal steps of the chief's eccentric anomaly,
/// some tens a revolution, and by the jets at the same times, whose errors that gives. Throws as
/// study_transfer.
DeputyMotion study_deputy_motion(const Scene& scene, const ProgressCallback& progress = {});

}  // namespace hamjet
