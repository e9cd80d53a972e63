#pragma once

#include <limits>
#include <vector>

#include "../../../dynamics/burning_system.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// A thruster in canonical units; masses are parts of the full spacecraft.
struct CanonicalThruster {
  double acceleration = 0;  ///< the acceleration of the full spacecraft
  /// Speed of the exhaust; infinite if the mass does not fall.
  double exhaust = std::numeric_limits<double>::infinity();

  CanonicalThruster(const ThrusterSettings& settings, const MetricUnits& units);
  bool mass_falls() const { return exhaust < std::numeric_limits<double>::infinity(); }
  /// How long a velocity change takes from a mass on, by the rocket equation.
  double length(double change, double mass) const;
  double mass_after(double change, double mass) const;
  /// How long after its beginning the mean time of a burn's change is, and how fast this grows with
  /// the change. As the thrust grows, such a burn acts as an impulse at that time up to the square
  /// of its length.
  double centre(double change, double mass) const;
  double centre_rate(double change, double mass) const;
};

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
