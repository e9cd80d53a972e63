#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// What limits the reach of an order, told at the worst deputy at its end. Where the first of the
/// neglected degrees alone misses, a miss is homogeneous in the deviation, and by Euler's theorem
/// its slopes by the logarithms of the coordinates add up to that degree.
struct ReachLimit {
  double degree = 0;             ///< d log(miss) / d log(separation)
  std::string start_coordinate;  ///< of the deputy's deviation, that has the largest part of it
  double start_degree = 0;       ///< that part
  std::string end_coordinate;    ///< in which the polynomials miss most, as it moves the position
  double end_share = 0;          ///< its part of the miss; those of all add up to 1
};

/// The largest separation at which one order's polynomial is right to the tolerance at one time.
struct ValidityEntry {
  int order = 0;
  double predicted_m = 0;  ///< from the decay of the jet's degrees
  /// Found by flying the sampled deputies; 0 where none of the separations tried holds.
  double proved_m = 0;
  double miss_m = 0;         ///< the worst sampled miss at `proved_m`, or at most that at a wall
  bool is_at_limit = false;  ///< still right at the largest separation tried: a lower bound
  /// None where nothing limits, at a wall, or where the flights' rounding hides what limits.
  std::optional<ReachLimit> limit = {};
  /// A little further the miss of some deputies jumps: they escape, fall or leave the coordinates.
  bool is_at_wall = false;
};

/// The validity of all orders at one time.
struct ValidityPoint {
  double time = 0;                     ///< canonical
  std::vector<ValidityEntry> entries;  ///< orders 1..N
};

/// All results of the study of table `[validity]`.
struct ValidityResult {
  Scene scene;  ///< with `validity`
  std::string integrator;
  ChosenCoordinates coordinates;  ///< of the polynomials; not automatic
  std::vector<ValidityPoint> points;
  double flight_floor_m = 0;  ///< see TransferResult
  long flights = 0;
  double propagation_seconds = 0;
  double proof_seconds = 0;
  std::vector<SelfCheck> checks;  ///< of the chief's flight
};

/// The study of table `[validity]` in all coordinates.
struct ValidityInCoordinates {
  struct Refused {
    JetCoordinates coordinates;
    std::string reason;
  };
  std::vector<ValidityResult> results;  ///< the first is Cartesian
  std::vector<Refused> refused;         ///< those that the orbit has not
  std::vector<SelfCheck> checks;        ///< of the chief's flight

  /// The result whose highest order reaches furthest at the last time.
  const ValidityResult& furthest() const;
  /// The coordinates of that one, and the reaches that they were chosen by.
  ChosenCoordinates chosen() const;
};

/// The coordinates that are measured, in the order in which they are told.
inline constexpr std::array<JetCoordinates, 6> measured_coordinates = {
    JetCoordinates::cartesian, JetCoordinates::spherical, JetCoordinates::cylindrical,
    JetCoordinates::poincare,  JetCoordinates::nodal,     JetCoordinates::flow_box};

/// The study of table `[validity]` in the scene's coordinates; with automatic ones in all, of which
/// the furthest is given. Deviations fill an ellipsoid in position along the axes of the
/// scene's frame, of largest semi-axis the separation, and the same ellipsoid times the mean motion
/// in the velocity of that frame (as seen from the turning axes, by default); the samples are
/// random ones and, for each order, those at which its error is largest: first by the next degree's
/// part (found by gradient ascent from the largest samples), then, where the reach of these ends,
/// by ascent of the miss itself, flown, until none beyond the tolerance is found. The miss is the
/// distance between the final position that the jet's polynomial gives and that of the flown
/// deputy. The prediction takes the part of degree k + 1, whose largest value over the samples
/// grows as the separation to the power k + 1, for the error of order k; that of the highest order
/// is extrapolated from the ratio of the last two. Throws as study_transfer.
ValidityResult study_validity(const Scene& scene, const ProgressCallback& progress = {});

/// The scene's coordinates; where they are automatic, those whose polynomials of the highest order
/// reach furthest at the end of the scene's duration, measured by some flights.
ChosenCoordinates measured_coordinates_of(const Scene& scene);

/// The same study in every coordinates, on the same deputies. Throws as study_validity; coordinates
/// that the orbit has not are told.
ValidityInCoordinates study_validity_in_all(const Scene& scene,
                                            const ProgressCallback& progress = {});

}  // namespace hamjet
