#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/detail/studies/finite_burns.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Burns in place of a return's impulses, from the orbit before the first to that behind the
/// second.
struct BurnedReturn {
  BurnPlan plan;        ///< with times since the first impulse
  double farthest = 0;  ///< as BoxReturn::farthest, by these burns
};

/// A return into the box: two impulses, m/s along the chief's R, T and N at their moments.
struct BoxReturn {
  double time = 0;      ///< time of the first impulse from the start, canonical
  double duration = 0;  ///< time from the first impulse to the second, canonical
  Eigen::Vector3d first_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d second_m_s = Eigen::Vector3d::Zero();
  double miss_m = 0;  ///< distance from the reference's place at which the flight ends
  double farthest =
      0;  ///< farthest from the reference on the way, in parts of the box: 1 is a face
  /// States right before the first impulse and right after the second one, canonical.
  std::vector<double> deputy_before;
  std::vector<double> deputy_after;
  std::vector<double> chief_before;
  std::vector<double> chief_after;
  std::optional<BurnedReturn> burns = {};  ///< if the scene has a thruster

  double change_m_s() const { return first_m_s.norm() + second_m_s.norm(); }
  /// The burns that replace the impulses; null where there are none.
  const BurnedReturn* burned() const { return burns && burns->plan.is_found() ? &*burns : nullptr; }
};

/// A deputy that was kept in a box, flown with the full equations of motion.
struct BoxControl {
  double days = 0;
  std::vector<double> start;  ///< the deputy's state, canonical
  std::vector<BoxReturn> returns;
  /// The farthest from the reference over all, looked at `places_a_revolution` times a revolution
  /// and ten times as often near a face, in parts of the box: 1 is a face.
  double farthest = 0;
  /// Between which places along R, T and N it was, metres.
  Eigen::Vector3d least_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d most_m = Eigen::Vector3d::Zero();
  /// Distances from the reference along R, T and N over the time, thinned for drawing.
  struct Place {
    double time = 0;  ///< canonical
    Eigen::Vector3d from_reference_m = Eigen::Vector3d::Zero();
  };
  std::vector<Place> places;

  static constexpr int places_a_revolution = 96;
  /// Faces are found to the rounding of flights.
  static constexpr double rounding = 1e-6;
  /// Whether the deputy was never outside, on its ways back too.
  bool is_held() const { return farthest <= 1 + rounding; }
  /// The same with the thruster's burns, if there is one.
  bool is_kept() const { return is_held() && burns_failure().empty(); }
  double change_m_s() const;
  double change_a_day_m_s() const { return change_m_s() / days; }
  double burns_m_s() const;  ///< the sum of the changes of all burns that were found
  /// Which return burns cannot replace, or lead outside of the box where its impulses do not, and
  /// why; empty if there is none.
  std::string burns_failure() const;
};

/// Keeps the scene's deputy in its box: it coasts until it is outside, then the cheapest return of
/// those in the settings that stay inside (where none does, the one that goes least far outside) is
/// flown. The momenta of a return are those of the generating function F1 of the flow's jet, of the
/// scene's order, about the chief from where it is (PositionBoundaryValues); the flights are by the
/// full equations, with Taylor's method.
///
/// With a thruster each return is flown by burns too, as BoxBurns has them, to the same orbits.
///
/// Where a return goes outside the deputy was not kept, as BoxControl::is_held tells.
///
/// `member` is the state of the deputy that the box is about, where it is about one, and
/// `revolution` the chief's nodal period, canonical. A return that has begun is
/// flown to its end. Throws Error(numerical) where the deputy starts outside, where a return ends
/// outside, and where none of the settings has an answer.
BoxControl keep_in_box(const Scene& scene, const std::vector<double>& member, double revolution,
                       const ProgressCallback& progress = {});

}  // namespace hamjet
