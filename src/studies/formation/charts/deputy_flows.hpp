#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../../../charts/driven_flow_box.hpp"
#include "../../jets_along_time.hpp"
#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The gravitational parameter of an orbit in its canonical units.
inline constexpr double canonical_mu = 1;

/// The gravity field of a scene about an orbit, in canonical units.
ZonalGravity orbit_field(const Scene& scene);

/// The Gauss method of an integrator, which integrates flow boxes. Throws Error(scene) for other
/// methods.
GaussSettings gauss_settings_of(const IntegratorSettings& settings);

/// The six numbers of an orbit's state.
SixNumbers<double> six_numbers(std::span<const double> state);

/// The flow, in coordinates of both ends that are not flow boxes, made from a jet in positions and
/// momenta about a start. `parameters` are the deputies' less the chief's, of a jet that is
/// expanded in them. Throws Error(numerical) if an end does not have these coordinates.
std::unique_ptr<DeputyFlow> deputy_flow_of_jet(const FlowMap<double>& jet,
                                               const SixNumbers<double>& start,
                                               const CoordinatesAtEnds& coordinates,
                                               std::span<const double> parameters = {});

/// The flow box of forces that depend on the time, about a problem's start: from the jet a time
/// after it. The scene tells the field's oblateness. Throws as DrivenFlowBox.
std::shared_ptr<const DrivenFlowBox> driven_flow_box(const Scene& scene,
                                                     const ComputedProblem& problem, double time,
                                                     const FlowJet<double>& jet);

/// Predictions of a scene's polynomials for deputies, in some coordinates, from time to time.
class DeputyFlowPropagation {
 public:
  /// `scene` and `problem`, of an orbit in all six variables, must outlive this object; `settings`
  /// are those of the integrator. `coordinates` must fit each other and not be automatic. Throws
  /// Error(numerical) if the orbit does not have these coordinates at its start, and Error(scene)
  /// for flow boxes with an integrator that is not a Gauss method.
  DeputyFlowPropagation(const Scene& scene, const ComputedProblem& problem,
                        const IntegratorSettings& settings, const CoordinatesAtEnds& coordinates);

  /// The flow to a canonical time, later than the last one. Throws as the integrator, and as the
  /// constructor for the coordinates at the end.
  std::unique_ptr<DeputyFlow> advance_to(double time);

  /// The coordinates at the last time as series in the initial deviations, minus the chief's: those
  /// of the chart, or of flow boxes (flow_box_coordinates).
  std::vector<Series<double>> end_coordinates() const;
  /// The names of these coordinates.
  std::array<std::string, 6> end_coordinate_names() const;
  /// The index among these of the period's difference, which replaces the energy in flow boxes of
  /// bound orbits.
  std::optional<std::size_t> end_period_place() const;
  /// The names of the polynomials' variables, and of their values at the last time.
  std::vector<std::string> variable_names() const;
  std::vector<std::string> value_names() const;

  /// The flow-box map at the last time; no value for other coordinates, and where the forces depend
  /// on the time.
  const std::optional<FlowBoxMap<double>>& flow_box() const noexcept { return last_box_; }

  const CoordinatesAtEnds& coordinates() const noexcept { return coordinates_; }
  /// Statistics summed over all integrations.
  const IntegrationStatistics& statistics() const;

 private:
  const Scene& scene_;
  const ComputedProblem& problem_;
  ZonalGravity field_;
  SixNumbers<double> start_;
  CoordinatesAtEnds coordinates_;
  std::vector<double> parameters_;      ///< the deputy's less the chief's
  double time_s_;                       ///< the canonical unit of time, for messages
  std::optional<JetPropagation> jets_;  ///< absent for flow boxes of a field
  std::optional<FlowBoxPropagation<double>> boxes_;
  std::optional<FlowMap<double>> last_jet_;           ///< absent for flow boxes
  std::shared_ptr<const DrivenFlowBox> last_driven_;  ///< where the forces depend on the time
  std::optional<FlowBoxMap<double>> last_box_;        ///< for flow boxes only
};

/// A note about a scene whose flow boxes bring no advantage: on an orbit that is not an ellipse, or
/// hardly one, time and energy across its sections are as nonlinear as positions. Otherwise no
/// value.
std::optional<std::string> escape_note(const Scene& scene);

/// The chart that belongs to coordinates other than flow boxes.
ChartName chart_of(JetCoordinates coordinates);

}  // namespace hamjet
