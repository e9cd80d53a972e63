#pragma once

#include <vector>

#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// The problem of an orbit with its costates, which are zero along it (see costate_system).
ComputedProblem costate_problem(const ComputedProblem& orbit, int order);

/// Integrals of a thrust along a flight, in SI units, and its largest size.
struct ThrustIntegrals {
  double energy_m2_s3 = 0;  ///< of |u|^2 / 2
  double change_m_s = 0;    ///< of |u|
  double largest_m_s2 = 0;
};

/// Where a system whose states hold a thrust has it: u = -scale * (three numbers from `first` on).
struct ThrustPlace {
  std::size_t first;
  double scale = 1;
};

/// The flights of a deputy from the scene's start to its end in one time, by the thrust of
/// costates. Scene and problem, one of costate_problem, must outlive it.
class ThrustedFlight {
 public:
  static constexpr std::size_t states = 6;
  using State = Eigen::Matrix<double, 6, 1>;

  ThrustedFlight(const Scene& scene, const ComputedProblem& problem, double time);

  double time() const { return time_; }
  /// Deviations from the orbit of the problem, of the start and of the wanted end.
  const std::vector<double>& start() const { return start_; }
  const std::vector<double>& end() const { return end_; }
  /// The state of that orbit at the end, with its costates.
  const std::vector<double>& orbit_end() const { return orbit_end_; }

  /// The state and costates of the deputy at the start, whose deviation is this share of the
  /// scene's.
  std::vector<double> deputy(const std::vector<double>& costates, double share = 1) const;
  /// The flown less the wanted state of the end, both with this share of the scene's deviations.
  State missing(const std::vector<double>& costates, double share = 1) const;
  /// A state at the end of a flight less the wanted one, with this share of the deviations.
  State missing_at(const std::vector<double>& flown, double share = 1) const;
  /// How the state of the end moves with the costates there.
  Eigen::Matrix<double, 6, 6> commanded(const std::vector<double>& costates, double share) const;
  /// Writes the misses of a flown less a wanted state.
  void set_misses(EnergyOptimalAnswer& answer, const State& miss) const;
  /// Flies with these costates, and writes the misses; returns the flown less the wanted state.
  State fly(EnergyOptimalAnswer& answer) const;

  /// Flies states and costates from one time to another, in `panels` parts of 8 nodes each, and
  /// adds to the integrals.
  void fly_on(std::vector<double>& z, double from, double to, int panels,
              ThrustIntegrals& integrals) const;
  /// The same with the states of another system, which hold the thrust at a place.
  void fly_on(const SharedSystem& system, const ThrustPlace& place, std::vector<double>& z,
              double from, double to, int panels, ThrustIntegrals& integrals) const;
  /// The integrals of the corrected answer, with 8 nodes between each two of the times, from 0 to
  /// the duration, and its thrust at both ends.
  void measure(EnergyOptimalTransfer& transfer, const std::vector<double>& times) const;
  /// The thrust of a flight with these costates at the ends of `intervals` equal parts of it.
  std::vector<ThrustSample> profile(const std::vector<double>& costates, int intervals) const;

  /// Chief and orbit at a time, six numbers each.
  std::vector<double> chief_at(double time) const;
  std::vector<double> orbit_at(double time) const;

 private:
  Eigen::Vector3d thrust(const std::vector<double>& z) const;
  Eigen::Vector3d along_frame(const std::vector<double>& chief, const std::vector<double>& z) const;

  const ComputedProblem& problem_;
  double time_;
  MetricUnits units_;
  RelativeFrame frame_;
  SharedSystem chief_system_;  ///< with costates, which are zero, if both are alike
  std::vector<double> chief_start_;
  std::vector<double> orbit_end_;  ///< of a spacecraft like the deputy, with its costates
  std::vector<double> chief_end_;
  std::vector<double> start_;
  std::vector<double> end_;
};

}  // namespace hamjet
