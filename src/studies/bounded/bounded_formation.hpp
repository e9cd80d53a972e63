#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "box_control.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/relative_motion/deputy_coordinates.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// How the deputies of a study of bounded motion are chosen.
enum class BoundedRule {
  poincare_map,   ///< equal mean nodal periods and drifts of the node, see BoundedFamily
  refined,        ///< the same, corrected by flying until the flown means are equal
  j2_invariant,   ///< of first order in J2, after Schaub and Alfriend
  mean_elements,  ///< equal mean semi-major axis and inclination
};
inline constexpr std::array<BoundedRule, 4> bounded_rules = {
    BoundedRule::poincare_map, BoundedRule::refined, BoundedRule::j2_invariant,
    BoundedRule::mean_elements};
constexpr bool is_of_map(BoundedRule rule) {
  return rule == BoundedRule::poincare_map || rule == BoundedRule::refined;
}
/// The name of a rule in results.
std::string_view name_of(BoundedRule rule);

/// What is left of a deputy's drift over a span, as slopes of straight lines of least squares in
/// the flown differences; a revolution, relative to the size of the relative orbit. A difference is
/// that between the deputy's and the chief's passages through the same mean argument of latitude,
/// where terms of short period are the same.
struct BoundedDrift {
  int revolutions = 0;
  double along = 0;  ///< a (-n d time + cos i d node), n the mean nodal motion
  /// By how much `along` changes where the window ends one look earlier: where terms of long period
  /// are larger than the drift, the slope is that of these looks and no finer.
  double along_doubt = 0;
  double cross = 0;  ///< a sin i d node
  double range = 0;  ///< range of the along-track difference over the span, in parts of the size
};

/// A deputy of one size, phase and rule.
struct BoundedDeputy {
  BoundedRule rule = BoundedRule::poincare_map;
  double wanted_m = 0;  ///< the size that was asked for
  std::string
      failure;  ///< if not empty, the reason why there is no such deputy; all below is empty then
  double amplitude = 0;  ///< length of the difference of the eccentricity vectors
  double size_m = 0;     ///< the largest distance over the first revolution
  // The size over one revolution is found from each look of the window on: the least of these
  // sizes, the largest, and the size of the revolution that begins at the end of the window.
  double least_size_m = 0;
  double largest_size_m = 0;
  double last_size_m = 0;
  // For deputies of the map and refined ones these are the period of the Kepler ellipse over the
  // chief's, less 1, and H less the chief's, canonical.
  double period_difference = 0;
  double momentum_difference = 0;
  int refinements = 0;                              ///< iterations of Newton's method by flying
  std::vector<double> state;                        ///< the state at the chief's start, canonical
  std::array<std::array<double, 6>, 6> forms = {};  ///< the start in every DeputyForm
  std::vector<RelativeState> first;                 ///< RTN, over the first revolution
  std::vector<RelativeState> last;                  ///< RTN, over the last revolution
  std::vector<BoundedDrift> drifts;  ///< over a tenth of the window, and over the whole window
  /// Least distance from the centre over the revolutions that begin at the looks, also between the
  /// places at which the deputy is looked at.
  double lowest_m = 0;

  /// The part of the size that was asked for by which the sizes may differ from it.
  static constexpr double held_share = 0.25;
  /// Whether the sizes over the whole window are near the size that was asked for.
  bool is_held() const {
    return failure.empty() && least_size_m >= (1 - held_share) * wanted_m &&
           largest_size_m <= (1 + held_share) * wanted_m;
  }
};

/// The deputies that stay with a scene's chief.
struct BoundedFormation {
  Scene scene;
  double nodal_period = 0;              ///< canonical
  double mean_period = 0;               ///< over the window
  double mean_node = 0;                 ///< radians a revolution
  int revolutions = 0;                  ///< the number of revolutions of the window
  std::vector<BoundedDeputy> deputies;  ///< by size, then rule
  std::optional<BoxControl> box;        ///< where the scene has a table [bounded.box]
  double seconds = 0;                   ///< of all
  double flight_seconds = 0;
  std::vector<SelfCheck> checks;  ///< checks of the chief's flight over the window
};

/// Finds, for each size of the scene's table [bounded], a deputy by each rule, and flies it beside
/// the chief over the window with the scene's field. Throws Error(scene) for a scene that has no
/// such table or whose chief is no orbit, and as BoundedFamily; that one size has no deputy is said
/// at it.
BoundedFormation study_bounded(const Scene& scene, const ProgressCallback& progress = {});

}  // namespace hamjet
