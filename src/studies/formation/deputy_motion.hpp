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
  double time = 0;      ///< in canonical units
  RelativeState state;  ///< flown state
  /// Distance of the polynomials of orders 1..N from the flown position.
  std::vector<double> errors_m;
  /// Rounding of the flights up to this time. Each flight starts where the one to the time before
  /// ended. Errors below this floor mean nothing.
  double flight_floor_m = 0;
};

/// How the scene's deputy moves relative to the chief.
struct DeputyMotion {
  Scene scene;  ///< with `deputy`
  std::string integrator;
  ChosenCoordinates coordinates;          ///< coordinates of the polynomials; not automatic
  std::vector<DeputyMotionPoint> points;  ///< the first point is the start
  RelativeTrajectory flown;               ///< path at these times and at others between them
  ExtremeSeparations extremes;            ///< of the flight, also between the times
  /// Drift of the deputy at its start; absent beside manoeuvres.
  std::optional<RelativeDrift> drift;
  int manoeuvres = 0;         ///< of both spacecraft that are flown
  double flight_floor_m = 0;  ///< the largest over the times
  double propagation_seconds = 0;
  std::vector<SelfCheck> checks;  ///< checks of both flights

  /// The largest error of an order over all times.
  double largest_error_m(int order) const;
};

/// The motion of the scene's deputy over the scene's duration, without velocity changes but those
/// of the orbit messages of both (see manoeuvred_motion). It is flown with the full equations of
/// motion to times that are equal steps of the chief's eccentric anomaly, some tens per revolution.
/// The jets at the same times are compared with it, which gives their errors. Throws as
/// study_transfer.
DeputyMotion study_deputy_motion(const Scene& scene, const ProgressCallback& progress = {});

}  // namespace hamjet
