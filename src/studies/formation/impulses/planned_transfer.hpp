#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "../companion_flow.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/transfer.hpp"
#include "impulse_search.hpp"

namespace hamjet {

/// Impulses that a linear theory chose.
struct LinearImpulses {
  TimedImpulses impulses;
  bool is_spaced = false;  ///< the impulses are at spaced times, none above the scene's limit
};

/// Impulses that were flown to the scene's end, or as far as they led.
struct FlownImpulses {
  TimedImpulses impulses;
  bool is_spaced = false;
  int flights = 0;
  double miss_m = 0;
  double velocity_miss_m_s = 0;
  std::string failure;  ///< if not empty, the reason why they do not lead to the end
};

/// The transfer of one deputy from the scene's start to its end in a given time by any number of
/// impulses. All arguments of the constructor must outlive it.
class PlannedTransfer {
 public:
  PlannedTransfer(const Scene& scene, const ComputedProblem& problem, const CompanionFlow& flow,
                  double duration);

  /// Converts a sum of impulses' magnitudes to m/s.
  double metres_per_second(double sum) const;
  /// The impulses of a plan in the units of the linear flow; impulses of zero size are left out.
  TimedImpulses in_flow_units(const std::vector<Impulse>& impulses) const;

  /// The least impulses of the linear theory about the chief, on a coarse grid, or on one that is
  /// refined about them. Throw as least_impulses, and Error(numerical) if impulses below the
  /// scene's limit do not suffice.
  LinearImpulses coarse() const;
  LinearImpulses by_linear_theory() const;
  /// The impulses, changed until the deputy that flies them arrives at the end. (Newton's method;
  /// its linear flow is that about the chief until this does not hold, and then that about the
  /// deputy.)
  FlownImpulses corrected(const LinearImpulses& impulses) const;
  /// A plan from flown impulses, made cheaper by the linear theory about its own trajectory as long
  /// as flights confirm it: its sum is never above the given one.
  ImpulsePlan plan(const FlownImpulses& given) const;

 private:
  /// A linear flow in which impulses are chosen and corrected.
  struct Linearization {
    MatrixAt at;
    ImpulseGrid grid;
    Eigen::Matrix<double, 6, 6> from_end;  ///< the flow from the end to the start
  };
  /// Impulses of the linear theory that make a change, and the proof that they are the least.
  struct FoundImpulses : LinearImpulses {
    ImpulseOptimum optimum;
  };
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  /// Called for each leg of the flight with the time at which it begins, its duration, and the
  /// state at its beginning.
  using OnLeg = std::function<void(double, double, const std::vector<double>&)>;

  ChiefFrame frame(const std::vector<double>& chief) const;
  Vector6 in_flow_units(const std::vector<double>& deviation) const;
  std::vector<double> start_state() const;
  Linearization about_chief() const;
  Linearization about(const TimedImpulses& impulses) const;

  Vector6 change_about_chief() const;
  void improve(FlownImpulses& flown, ImpulsePlan& plan) const;
  void tidy(FlownImpulses& flown, ImpulsePlan& plan) const;
  FoundImpulses find(const Linearization& linear, const Vector6& change) const;
  FoundImpulses within_limit(const Linearization& linear, ImpulseOptimum optimum,
                             const Vector6& change) const;
  TimedImpulses merged(const Linearization& linear, const ImpulseOptimum& optimum,
                       const Vector6& change) const;
  int spaces() const;
  double spaced_time(int k) const;

  std::vector<double> fly(const TimedImpulses& impulses, const OnLeg& on_leg = {}) const;
  FlownImpulses corrected(Linearization linear, TimedImpulses impulses, bool is_spaced) const;
  bool add_below_limit(const std::vector<ImpulseEffect>& effects,
                       std::vector<Eigen::Vector3d>& changes, const std::vector<double>& weights,
                       const Vector6& mend) const;
  void add_trims(TimedImpulses& impulses, std::vector<double>& weights, bool is_spaced) const;
  std::string forbidden_by_limits(const TimedImpulses& impulses) const;
  double flight_floor_m(const TimedImpulses& impulses) const;

  const Scene& scene_;
  const ComputedProblem& problem_;
  const CompanionFlow& flow_;
  double duration_;
  MetricUnits units_;
  double momentum_unit_;
  std::vector<double> orbit_end_;
  std::vector<double> start_;                              ///< canonical (dq, dp)
  std::vector<double> end_;                                ///< from the orbit of the flow
  double most_ = std::numeric_limits<double>::infinity();  ///< largest allowed impulse
  double gap_ = 0;  ///< time between impulses that the limit divides, in canonical units
};

}  // namespace hamjet
