#pragma once

#include <functional>
#include <vector>

#include "../../../dynamics/burning_system.hpp"
#include "canonical_thruster.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// When a burn begins and ends, and the mass before it.
struct BurnSpan {
  double start = 0;
  double end = 0;
  double mass = 1;

  double length() const { return end - start; }
};

/// The flights of one deputy, from the scene's start to its end in one time, by burns in place of
/// impulses. Each burn has its impulse's time as the mean time of its change and is given by its
/// velocity change, a vector along the axes of the thruster's attitude. The deputy coasts back from
/// the start to a burn that begins earlier, and back to the end from one that ends later. All
/// arguments of the constructor must outlive it.
class BurnFlight {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Changes = std::vector<Eigen::Vector3d>;  ///< the velocity changes of all burns, canonical

  /// `burning` is the problem's system with the thrust of the scene's thruster.
  BurnFlight(const Scene& scene, const ComputedProblem& problem, const SharedSystem& burning,
             double duration);

  /// The impulses' changes along the axes of the thruster's attitude where the deputy is then.
  Changes changes_of(const std::vector<Impulse>& impulses) const;
  std::vector<BurnSpan> spans(const CanonicalThruster& thruster, const std::vector<Impulse>& at,
                              const Changes& changes) const;

  /// What is called with time and state of the deputy at the end of each part of a flight.
  using Look = std::function<void(double time, const std::vector<double>& deputy)>;
  /// The flown state at the end. `look` is called at the end of each part of at most `pace` of what
  /// is flown forward in time. Throws as exact_flow.
  std::vector<double> flown(const CanonicalThruster& thruster, const std::vector<Impulse>& at,
                            const Changes& changes, double pace = 0, const Look& look = {}) const;

  /// The wanted less the flown deviation from the chief at the end. Throws as exact_flow.
  Vector6 missing(const CanonicalThruster& thruster, const std::vector<Impulse>& at,
                  const Changes& changes) const;
  /// The derivatives of the flown state at the end by all changes, with those of the burns' times
  /// and masses.
  Eigen::Matrix<double, 6, Eigen::Dynamic> derivatives(const CanonicalThruster& thruster,
                                                       const std::vector<Impulse>& at,
                                                       const Changes& changes) const;

  const MetricUnits& units() const { return units_; }

 private:
  Eigen::Matrix3d axes(const std::vector<double>& state) const;
  std::vector<double> start_state() const;
  std::vector<double> burning_state(const CanonicalThruster& thruster, std::vector<double> state,
                                    const BurnSpan& span, const Eigen::Vector3d& change) const;

  const Scene& scene_;
  const ComputedProblem& problem_;
  const SharedSystem& burning_;
  double duration_;
  MetricUnits units_;
  SharedSystem chief_system_;  ///< `problem` is that of the deputy's coefficients
  std::vector<double> chief_end_;
  std::vector<double> end_;  ///< wanted deviation
};

}  // namespace hamjet
