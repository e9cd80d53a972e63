#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/uncertainty/collision_choices.hpp"
#include "hamjet/uncertainty/covariance.hpp"

namespace hamjet {

/// How well a spacecraft's state at the start is known.
struct StateUncertainty {
  RelativeFrame frame = RelativeFrame::rtn_inertial;  ///< of its own orbit
  Covariance covariance;                              ///< metres and metres a second
};

/// Execution errors of a velocity change that ends where the scene starts, after Gates: its size is
/// wrong by a share of it, and it points wrong about both axes across it, all independent. Source:
/// C. R. Gates, A Simplified Model of Midcourse Maneuver Execution Errors, JPL Technical Report
/// 32-504 (1963), of which these are the parts proportional to the change.
struct BurnUncertainty {
  RelativeFrame frame = RelativeFrame::rtn_inertial;
  Eigen::Vector3d velocity_change_m_s = Eigen::Vector3d::Zero();
  double magnitude = 0;      ///< standard deviation of the size, as a share of it
  double direction_deg = 0;  ///< standard deviation about each axis across

  /// Of position and velocity in the frame, to first order in the errors:
  /// (m^2 - d^2) v v^T + d^2 |v|^2 1 with m the share and d the angle.
  Covariance covariance() const;
};

/// Table `[uncertainty.collision]`: whether chief and deputy may hit each other.
struct CollisionWatch {
  double radius_m = 0;  ///< of both together
  double from = 0;      ///< the window, canonical
  double to = 0;
  bool has_window = false;  ///< the scene names it
  CollisionEvent event = CollisionEvent::nearer;
  CollisionSampling sampling = CollisionSampling::automatic;
  int samples = 200000;
  double confidence = 0.95;
};

/// Table `[uncertainty.safety]`: how near the spacecraft of a formation come to each other where a
/// burn fails.
struct SafetyWatch {
  double keep_apart_m = 0;
  double from = 0;  ///< the window, canonical
  double to = 0;
  std::optional<Eigen::Vector3d> keep_out_m;  ///< semi-axes along R, T, N, about the chief
  /// How much of the burn is done, as shares of it; [1] without a burn.
  std::vector<double> burn_shares = {0, 1};
  std::vector<RelativeState> deputies;  ///< beside the scene's, in its frame
  double share = 0.99;                  ///< of all cases, which stay farther than what is told
  double confidence = 0.95;             ///< of intervals
  int samples = 2000;                   ///< of the polynomials, for each pair and share of the burn
  /// Checked of every pair, where given: the separation that `share` of all cases keep, by the
  /// lower end of its interval; and the standard deviations up to which the ellipsoid stays free.
  std::optional<double> least_separation_m;
  std::optional<double> least_deviations;
};

/// Table `[uncertainty]`.
struct UncertaintySettings {
  RelativeFrame frame = RelativeFrame::rtn_inertial;  ///< of the results, at the chief
  std::optional<StateUncertainty> chief;              ///< absent: known exactly
  std::optional<StateUncertainty> deputy;
  std::optional<BurnUncertainty> burn;    ///< of the deputy, or of the chief of a scene without one
  std::vector<double> times;              ///< canonical, moving away from 0; none is 0
  double acceleration_density_m2_s3 = 0;  ///< of each axis, of white noise; 0: none
  std::optional<CollisionWatch> collision;
  std::optional<SafetyWatch> safety;
  /// Others than the scene's in which the distribution is told too at the last time.
  std::vector<JetCoordinates> coordinates;
  int samples = 2000;  ///< flown with the full equations; 0: none
  std::uint64_t seed = 1;
};

}  // namespace hamjet
