#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/detail/studies/domain_settings.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/uncertainty/collision_choices.hpp"
#include "hamjet/uncertainty/covariance.hpp"

namespace hamjet {

/// The coordinates in which the states at the start are Gaussian.
enum class GaussianIn {
  automatic,  ///< elements where the orbit bends away from a Gaussian in positions, else positions
  positions,  ///< positions and velocities
  elements,   ///< Poincare's elements, with the covariance that their linear map makes
};
inline constexpr std::array<std::string_view, 3> gaussian_in_names = {"auto", "positions",
                                                                      "elements"};

/// A parameter of the forces that is not known exactly.
struct UncertainParameter {
  std::string name;      ///< as in jet.variables
  double deviation = 0;  ///< standard deviation, in the parameter's own unit
  /// Covariances with the spacecraft's position and velocity, and with the parameters that stand
  /// before this one; missing ones are 0.
  std::vector<double> covariances = {};
};

/// How accurately the state of a spacecraft at the start is known.
struct StateUncertainty {
  RelativeFrame frame = RelativeFrame::rtn_inertial;  ///< frame of the spacecraft's own orbit
  Covariance covariance;                              ///< in metres and metres per second
  std::vector<UncertainParameter> parameters = {};    ///< of this spacecraft alone

  /// The covariance of position, velocity and parameters, as it is told.
  Matrix<double> joint_matrix() const;
};

/// Execution errors, after Gates, of a velocity change that ends at the scene's start: an error of
/// its size, and an error of its direction about both axes across it, all independent. Source: C.
/// R. Gates, A Simplified Model of Midcourse Maneuver Execution Errors, JPL Technical Report 32-504
/// (1963); these are the parts proportional to the change.
struct BurnUncertainty {
  RelativeFrame frame = RelativeFrame::rtn_inertial;
  Eigen::Vector3d velocity_change_m_s = Eigen::Vector3d::Zero();
  double magnitude = 0;      ///< standard deviation of the size, as a fraction of the size
  double direction_deg = 0;  ///< standard deviation about each axis across

  /// Covariance of position and velocity in the frame, to first order in the errors: (m^2 - d^2) v
  /// v^T + d^2 |v|^2 1, with m the fraction and d the angle.
  Covariance covariance() const;
};

/// Table `[uncertainty.collision]`: whether chief and deputy may hit each other.
struct CollisionWatch {
  double radius_m = 0;  ///< radius of both bodies together
  double from = 0;      ///< start of the window, in canonical units
  double to = 0;
  bool has_window = false;  ///< the scene gives a window
  CollisionEvent event = CollisionEvent::nearer;
  CollisionSampling sampling = CollisionSampling::automatic;
  int samples = 200000;
  double confidence = 0.95;
};

/// Table `[uncertainty.safety]`: the distances between the spacecraft of a formation after a burn
/// that fails.
struct SafetyWatch {
  double keep_apart_m = 0;
  double from = 0;  ///< start of the window, in canonical units
  double to = 0;
  /// Semi-axes along R, T, N of an ellipsoid about the chief.
  std::optional<Eigen::Vector3d> keep_out_m;
  /// Fractions of the burn that are completed; [1] without a burn.
  std::vector<double> burn_shares = {0, 1};
  std::vector<RelativeState> deputies;  ///< further deputies, in the frame of the scene's deputy
  double share =
      0.99;  ///< fraction of all cases that stay farther apart than the reported separation
  double confidence = 0.95;  ///< confidence of the intervals
  int samples =
      2000;  ///< number of samples of the polynomials, for each pair and fraction of the burn
  /// Checks of every pair, if given: the separation that a fraction `share` of all cases must keep,
  /// judged by the lower end of its interval; and the number of standard deviations up to which the
  /// ellipsoid must stay free.
  std::optional<double> least_separation_m;
  std::optional<double> least_deviations;
};

/// Table `[uncertainty]`.
struct UncertaintySettings {
  RelativeFrame frame = RelativeFrame::rtn_inertial;  ///< frame of the results, at the chief
  std::optional<StateUncertainty> chief;              ///< absent if the state is known exactly
  std::optional<StateUncertainty> deputy;
  /// Parameters that all spacecraft share, such as the factor of densities.
  std::vector<UncertainParameter> common;
  GaussianIn gaussian_in = GaussianIn::automatic;
  /// Burn of the deputy, or of the chief in a scene without one.
  std::optional<BurnUncertainty> burn;
  std::vector<double> times;  ///< in canonical units, moving away from 0; none is 0
  double acceleration_density_m2_s3 =
      0;  ///< power spectral density of white noise in the acceleration, for each axis; 0 for none
  /// If given, the deviations within three standard deviations are split into domains where the
  /// polynomials of positions and velocities are not right.
  std::optional<DomainSettings> domains;
  std::optional<CollisionWatch> collision;
  std::optional<SafetyWatch> safety;
  /// Coordinates other than the scene's in which the distribution at the last time is given too.
  std::vector<JetCoordinates> coordinates;
  int samples = 2000;  ///< number of samples flown with the full equations; 0 for none
  std::uint64_t seed = 1;
};

}  // namespace hamjet
