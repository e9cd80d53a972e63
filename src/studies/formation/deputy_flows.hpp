#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../jets_along_time.hpp"
#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// An orbit's gravitational parameter in its canonical units.
inline constexpr double canonical_mu = 1;

/// The gravity field of a scene about an orbit, canonical.
ZonalGravity orbit_field(const Scene& scene);

/// The Gauss method of an integrator, which flow boxes are integrated by. Throws Error(scene) for
/// other methods.
GaussSettings gauss_settings_of(const IntegratorSettings& settings);

/// The six numbers of an orbit's state.
SixNumbers<double> six_numbers(std::span<const double> state);

/// The flow in coordinates of both ends, which are no flow boxes, of a jet in positions and momenta
/// about a start. Throws Error(numerical) where an end has not such coordinates.
std::unique_ptr<DeputyFlow> deputy_flow_of_jet(const FlowMap<double>& jet,
                                               const SixNumbers<double>& start,
                                               const CoordinatesAtEnds& coordinates);

/// What a scene's polynomials say of deputies, in some coordinates, from time to time.
class DeputyFlowPropagation {
 public:
  /// `scene` and `problem`, of an orbit in all six variables, must outlive it; `settings` are those
  /// of the integrator. `coordinates` must fit each other and not be automatic. Throws
  /// Error(numerical) where the orbit has not such coordinates at its start, and Error(scene) for
  /// flow-box coordinates with an integrator that is no Gauss method.
  DeputyFlowPropagation(const Scene& scene, const ComputedProblem& problem,
                        const IntegratorSettings& settings, const CoordinatesAtEnds& coordinates);

  /// The flow to a time, canonical, further on than the last one. Throws as the integrator, and as
  /// the constructor for the coordinates at the end.
  std::unique_ptr<DeputyFlow> advance_to(double time);

  /// The coordinates at the last time as series in the initial deviations, less the chief's: those
  /// of the chart, or of flow boxes (flow_box_coordinates).
  std::vector<Series<double>> end_coordinates() const;
  /// Their names.
  std::array<std::string, 6> end_coordinate_names() const;
  /// The place among them of the period's difference, which flow boxes of bound orbits have for the
  /// energy.
  std::optional<std::size_t> end_period_place() const;
  /// The names of the polynomials' variables, and of their values at the last time.
  std::vector<std::string> variable_names() const;
  std::vector<std::string> value_names() const;

  /// The map of the last time, of flow boxes; nothing of others.
  const std::optional<FlowBoxMap<double>>& flow_box() const noexcept { return last_box_; }

  const CoordinatesAtEnds& coordinates() const noexcept { return coordinates_; }
  /// Summed over the integrations.
  const IntegrationStatistics& statistics() const;

 private:
  ZonalGravity field_;
  SixNumbers<double> start_;
  CoordinatesAtEnds coordinates_;
  double time_s_;                       ///< the canonical unit, for messages
  std::optional<JetPropagation> jets_;  ///< unless of flow boxes
  std::optional<FlowBoxPropagation<double>> boxes_;
  std::optional<FlowMap<double>> last_jet_;     ///< unless of flow boxes
  std::optional<FlowBoxMap<double>> last_box_;  ///< of flow boxes
};

/// What is to be said of a scene whose flow boxes gain nothing: on an orbit that is no ellipse, or
/// hardly one, time and energy across its sections bend as much as positions do. Nothing elsewhere.
std::optional<std::string> escape_note(const Scene& scene);

/// The chart that coordinates other than flow boxes are of.
ChartName chart_of(JetCoordinates coordinates);

}  // namespace hamjet
