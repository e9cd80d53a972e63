#pragma once

#include <span>
#include <vector>

#include "bounded_formation.hpp"
#include "hamjet/charts/flow_section.hpp"
#include "hamjet/dynamics/clock_time.hpp"

namespace hamjet {

/// Deputies flown beside a chief with the full equations of motion, without any polynomial: their
/// relative orbits over the first and the last revolution of a window, and what they drift.
class CompanyFlight {
 public:
  /// `times` are those of the window, canonical, from 0 on at equal distances; the chief is flown
  /// over them. `mean_period` is its mean nodal period.
  CompanyFlight(const Scene& scene, const FlowSection<double>& section,
                const std::vector<double>& times, double nodal_period, double mean_period);

  double semi_major_axis() const { return semi_major_axis_; }
  double cosine() const { return cosine_; }  ///< cosine of the chief's inclination
  double sine() const;
  double mean_motion() const;  ///< radians a canonical unit of time, from node to node

  /// The state, which stands `since` after the start, after a time.
  std::vector<double> flown_on(const std::vector<double>& state, double since, double time) const;
  /// The deputy relative to the chief along the first revolution.
  std::vector<RelativeState> first_orbit(const std::vector<double>& deputy) const;
  /// Flies the deputy over the window: fills its first and last orbit, size, lowest point and
  /// drifts from its state.
  void fly(BoundedDeputy& deputy) const;

  /// The slope by which the deputy's passages through the chief's mean argument of latitude fall
  /// behind, a time a revolution, and that of its node, of the drifts over the window.
  std::array<double, 2> rates_of(const BoundedDeputy& deputy) const;

 private:
  /// When, after a state's moment, it passes the chief's angle, and the node that it has then.
  struct Passage {
    double delay = 0;
    double node = 0;
  };
  Passage passage_of(std::vector<double> state, double since,
                     const SixNumbers<double>& chief) const;
  void choose_times_of_orbit();
  std::vector<std::vector<double>> orbit_from(const std::vector<double>& start, double since) const;
  std::vector<RelativeState> relative_orbit(const std::vector<std::vector<double>>& chief,
                                            const std::vector<std::vector<double>>& deputy) const;
  /// The size and the lowest point of the revolution that begins at these states.
  void add_revolution(const std::vector<double>& chief, const std::vector<double>& state,
                      double since, BoundedDeputy& deputy) const;
  BoundedDrift drift_of(std::span<const std::size_t> places, const std::vector<double>& along,
                        const std::vector<double>& cross) const;
  double slope_of(std::span<const std::size_t> places, const std::vector<double>& values) const;

  const FlowSection<double>& section_;
  SharedSystem system_;
  ClockTime start_time_;
  MetricUnits units_;
  double mu_;
  double nodal_period_;
  double mean_period_;
  double cosine_;
  double semi_major_axis_;
  std::vector<double> times_;          ///< times of a tenth of the window, then of the window
  std::vector<std::size_t> in_tenth_;  ///< places among them
  std::vector<std::size_t> in_window_;
  std::vector<double> steps_of_orbit_;      ///< the steps of one revolution
  std::vector<std::vector<double>> chief_;  ///< at the times
  std::vector<std::vector<double>> chief_first_;
  std::vector<std::vector<double>> chief_last_;
};

}  // namespace hamjet
