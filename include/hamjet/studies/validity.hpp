#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// What limits the reach of an order, described at the worst deputy at the end. If the miss comes
/// from the first neglected degree alone, it is homogeneous in the deviation, and by Euler's
/// theorem its logarithmic slopes by the coordinates add up to that degree.
struct ReachLimit {
  double degree = 0;             ///< d log(miss) / d log(separation)
  std::string start_coordinate;  ///< coordinate of the deputy's deviation with the largest part of
                                 ///< the degree
  double start_degree = 0;       ///< that part
  std::string end_coordinate;    ///< coordinate in which the polynomials miss most, weighted by its
                                 ///< effect on the position
  double end_share = 0;  ///< its fraction of the miss; the fractions of all coordinates add up to 1
};

/// The largest separation at which the polynomial of one order is right to the tolerance at one
/// time.
struct ValidityEntry {
  int order = 0;
  double predicted_m = 0;  ///< prediction from the decay of the jet's degrees
  /// Separation found by flying the sampled deputies; 0 if none of the separations tried holds.
  double proved_m = 0;
  double miss_m = 0;  ///< the worst sampled miss at `proved_m`; at a wall, an upper bound of it
  bool is_at_limit =
      false;  ///< the largest separation tried still holds, so that `proved_m` is a lower bound
  /// No value if nothing limits, at a wall, or if the flights' rounding hides the cause.
  std::optional<ReachLimit> limit = {};
  /// A little further the miss of some deputies jumps, because they escape, fall or leave the
  /// coordinates.
  bool is_at_wall = false;
  /// The search ended after its last trial without an answer; `proved_m` is then 0 and says
  /// nothing.
  bool is_unsettled = false;
};

/// The validity of all orders at one time.
struct ValidityPoint {
  double time = 0;                     ///< in canonical units
  std::vector<ValidityEntry> entries;  ///< for the orders 1..N
};

/// One of the domains into which deputies are split; its polynomials are about its centre.
struct ValidityDomain {
  RelativeState centre;  ///< from the chief, along the frame of the results
  std::size_t deputies = 0;
  double miss_m = 0;  ///< the largest flown miss of these
};

/// The domains into which a set of deputies is split until the polynomials about each one's centre
/// are right to the tolerance at the last time.
struct ValidityDomains {
  double separation_m = 0;    ///< the largest semi-axis of the set
  std::size_t deputies = 0;   ///< of the set, that were flown
  std::size_t maps = 0;       ///< maps that were integrated, those of domains that were split too
  std::string split_across;   ///< coordinate across which most were split; empty for one domain
  std::size_t not_right = 0;  ///< deputies beyond the tolerance, if the limit on domains was met
  double miss_m = 0;          ///< the largest flown miss
  std::vector<ValidityDomain> parts = {};

  std::size_t count() const { return parts.size(); }
};

/// All results of the study of table `[validity]`.
struct ValidityResult {
  Scene scene;  ///< with `validity`
  std::string integrator;
  ChosenCoordinates coordinates;  ///< coordinates of the polynomials; not automatic
  std::vector<ValidityPoint> points;
  std::optional<ValidityDomains> domains = {};  ///< where `validity.separation_m` asks for it
  double flight_floor_m = 0;                    ///< see TransferResult
  long flights = 0;
  double propagation_seconds = 0;
  double proof_seconds = 0;
  std::vector<SelfCheck> checks;  ///< checks of the chief's flight
};

/// The study of table `[validity]` in all coordinates.
struct ValidityInCoordinates {
  struct Refused {
    JetCoordinates coordinates;
    std::string reason;
  };
  std::vector<ValidityResult> results;  ///< the first result is in Cartesian coordinates
  std::vector<Refused> refused;         ///< coordinates that the orbit does not have
  std::vector<SelfCheck> checks;        ///< checks of the chief's flight

  /// The result whose highest order reaches furthest at the last time.
  const ValidityResult& furthest() const;
  /// The coordinates of this result, and the reaches by which they were chosen.
  ChosenCoordinates chosen() const;
};

/// The coordinates that are measured, in the order in which they are reported.
inline constexpr std::array<JetCoordinates, 6> measured_coordinates = {
    JetCoordinates::cartesian, JetCoordinates::spherical, JetCoordinates::cylindrical,
    JetCoordinates::poincare,  JetCoordinates::nodal,     JetCoordinates::flow_box};

/// The study of table `[validity]` in the scene's coordinates; automatic coordinates are measured
/// in all, and the result that reaches furthest is returned. The deviations in position fill an
/// ellipsoid along the axes of the scene's frame, whose largest semi-axis is the separation. Those
/// in the velocity of that frame (by default as seen from the turning axes) fill the same ellipsoid
/// times the mean motion. The samples are random ones and, for each order, those with the largest
/// error. The latter are found first from the part of the next degree, by gradient ascent from the
/// largest samples. To orders up to 6 the jet has two degrees more than are asked for: the miss
/// that they foretell is ascended next, and then, at the reach of these samples, the flown miss
/// itself, until no deputy beyond the tolerance is found. The miss is the distance between the
/// final position that the jet's polynomial gives and that of the flown deputy. The prediction
/// takes the part of degree k + 1 as the error of order k; its largest value over the samples grows
/// as the separation to the power k + 1. For an order without a next degree, from 8 on, this part
/// is extrapolated from the ratio of the last two. Throws as study_transfer.
ValidityResult study_validity(const Scene& scene, const ProgressCallback& progress = {});

/// The scene's coordinates. If these are automatic, the coordinates whose polynomials of the
/// highest order reach furthest at the end of the scene's duration, as measured by some flights.
ChosenCoordinates measured_coordinates_of(const Scene& scene);

/// The same study in all coordinates, with the same deputies. Throws as study_validity; coordinates
/// that the orbit does not have are listed in the result.
ValidityInCoordinates study_validity_in_all(const Scene& scene,
                                            const ProgressCallback& progress = {});

}  // namespace hamjet
