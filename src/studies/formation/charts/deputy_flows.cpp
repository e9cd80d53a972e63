#include "deputy_flows.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <variant>

#include "../../descriptions/method_description.hpp"
#include "../formation_problem.hpp"
#include "../jets_about_time.hpp"
#include "hamjet/charts/charted_map.hpp"
#include "hamjet/charts/flow_box_states.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Does work that needs coordinates at a time; if the orbit does not have them, the error, of the
/// kind `lack`, names the coordinates.
template <class Work>
auto in_coordinates(JetCoordinates coordinates, const std::string& when, ErrorKind lack,
                    const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical || coordinates == JetCoordinates::cartesian) throw;
    throw Error(
        lack, fmt::format("jet.coordinates: {} {}: {}", name_of(coordinates), when, error.what()));
  }
}

}  // namespace

GaussSettings gauss_settings_of(const IntegratorSettings& settings) {
  const auto splittable = description_of(settings.method).splittable(settings);
  const GaussSettings* gauss = splittable ? std::get_if<GaussSettings>(&*splittable) : nullptr;
  if (gauss == nullptr) {
    throw Error(ErrorKind::scene,
                fmt::format("jet.coordinates: flow-box is integrated by Gauss methods, got the "
                            "integrator {}, must be gauss, or other coordinates",
                            settings.label));
  }
  return *gauss;
}

ZonalGravity orbit_field(const Scene& scene) {
  if (!make_system(scene).is_autonomous()) {
    throw Error(
        ErrorKind::scene,
        fmt::format("system.model: its forces depend on the time, got {}, must be zonal-gravity or "
                    "kepler for flow boxes, nodal sections and frozen orbits, which need a flow "
                    "that is the same at every start",
                    model_name(scene.system.model)));
  }
  return {canonical_mu, scene.canonical_radius, scene.system.J};
}

SixNumbers<double> six_numbers(std::span<const double> state) {
  SixNumbers<double> result;
  std::copy_n(state.begin(), result.size(), result.begin());
  return result;
}

std::optional<std::string> escape_note(const Scene& scene) {
  constexpr double nearly_escaping = 0.95;
  if (scene.coordinates != JetCoordinates::flow_box) return std::nullopt;
  const Eigen::Map<const Eigen::Vector3d> position(scene.nominal.data());
  const Eigen::Map<const Eigen::Vector3d> velocity(scene.nominal.data() + 3);
  const double energy = velocity.squaredNorm() / 2 - canonical_mu / position.norm();
  const double eccentricity =
      std::sqrt(std::max(0.0, 1 + 2 * energy * position.cross(velocity).squaredNorm() /
                                      (canonical_mu * canonical_mu)));
  const bool is_nearly_escaping =
      eccentricity >= nearly_escaping ||
      section_chart(six_numbers(scene.nominal), canonical_mu) == ChartName::spherical;
  if (!is_nearly_escaping) return std::nullopt;
  return fmt::format(
      "the orbit escapes or nearly does (osculating e = {:.4g}), where flow-box "
      "coordinates may reach less far than Cartesian ones; `hamjet validity "
      "--coordinates all` measures it, and jet.coordinates = \"auto\" takes what "
      "reaches furthest",
      eccentricity);
}

ChartName chart_of(JetCoordinates coordinates) {
  return chart_of(name_of(coordinates)).value_or(ChartName::cartesian);
}

std::unique_ptr<DeputyFlow> deputy_flow_of_jet(const FlowMap<double>& jet,
                                               const SixNumbers<double>& start,
                                               const CoordinatesAtEnds& coordinates,
                                               std::span<const double> parameters) {
  if (coordinates == JetCoordinates::cartesian) return cartesian_deputy_flow(jet, parameters);
  SixNumbers<double> end;
  for (std::size_t i = 0; i < end.size(); ++i) end[i] = jet.jet()[i][0];
  const CanonicalChart<double> first(chart_of(coordinates.start), start, canonical_mu);
  const CanonicalChart<double> last(chart_of(coordinates.end), end, canonical_mu);
  return charted_deputy_flow(first, start, last, end, in_charts(jet, first, start, last));
}

std::shared_ptr<const DrivenFlowBox> driven_flow_box(const Scene& scene,
                                                     const ComputedProblem& problem, double time,
                                                     const FlowJet<double>& jet) {
  if (jet.size() < 6 || jet[0].space().variables() != jet.size()) {
    throw Error(ErrorKind::scene,
                "jet.variables: flow boxes of forces that depend on the time are expanded in all "
                "numbers of the state, got fewer variables, should be left out");
  }
  const SixNumbers<double> start = six_numbers(problem.nominal);
  const double oblateness = scene.system.J[2] * scene.canonical_radius * scene.canonical_radius;
  return std::make_shared<const DrivenFlowBox>(
      start, jets_about_time(*problem.system, problem.start_time + time, jet), time, canonical_mu,
      oblateness);
}

DeputyFlowPropagation::DeputyFlowPropagation(const Scene& scene, const ComputedProblem& problem,
                                             const IntegratorSettings& settings,
                                             const CoordinatesAtEnds& coordinates)
    : scene_(scene),
      problem_(problem),
      start_(six_numbers(problem.nominal)),
      coordinates_(coordinates),
      parameters_(deputy_parameters(scene)),
      time_s_(scene.units.time_s) {
  if (!coordinates.fit_each_other()) {
    throw Error(
        ErrorKind::usage,
        fmt::format("jet.end_coordinates: {}: flow boxes are of both ends", name_of(coordinates)));
  }
  // What the scene's own start lacks was asked for by the scene.
  in_coordinates(coordinates.start, "at the start", ErrorKind::scene, [&] {
    if (coordinates.start == JetCoordinates::flow_box && !problem.system->is_autonomous()) {
      CanonicalChart<double>(driven_flow_box_elements(start_, canonical_mu), start_, canonical_mu);
      jets_.emplace(problem, settings);
    } else if (coordinates.start == JetCoordinates::flow_box) {
      field_ = orbit_field(scene);
      boxes_.emplace(field_, section_chart(start_, canonical_mu), start_, scene.order,
                     gauss_settings_of(settings));
    } else {
      CanonicalChart<double>(chart_of(coordinates.start), start_,
                             canonical_mu);  // throws if there is none
      jets_.emplace(problem, settings);
    }
  });
}

std::unique_ptr<DeputyFlow> DeputyFlowPropagation::advance_to(double time) {
  const std::string when = fmt::format("after {:.6g} s", time * time_s_);
  if (boxes_) {
    return in_coordinates(coordinates_.end, when, ErrorKind::numerical, [&] {
      last_box_ = boxes_->advance_to(time);
      return flow_box_deputy_flow(field_, *last_box_);
    });
  }
  if (coordinates_.start == JetCoordinates::flow_box) {
    const FlowJet<double> at_end = jets_->advance_to(time);
    return in_coordinates(coordinates_.end, when, ErrorKind::numerical, [&] {
      last_driven_ = driven_flow_box(scene_, problem_, time, at_end);
      DeputyParameters parameters = {{problem_.nominal.begin() + 6, problem_.nominal.end()},
                                     parameters_};
      for (std::size_t i = 0; i < parameters_.size(); ++i) parameters.values[i] += parameters_[i];
      return driven_flow_box_deputy_flow(problem_.system, problem_.start_time + time, last_driven_,
                                         std::move(parameters));
    });
  }
  const FlowMap<double>& jet = last_jet_.emplace(jets_->advance_to(time));
  return in_coordinates(coordinates_.end, when, ErrorKind::numerical,
                        [&] { return deputy_flow_of_jet(jet, start_, coordinates_, parameters_); });
}

std::vector<Series<double>> DeputyFlowPropagation::end_coordinates() const {
  if (last_box_) return flow_box_coordinates(field_, *last_box_);
  if (last_driven_) return last_driven_->end_coordinates();
  const std::vector<Series<double>>& z = last_jet_->jet();
  if (coordinates_.end == JetCoordinates::cartesian) return without_constants(z);
  SixNumbers<double> end;
  for (std::size_t i = 0; i < end.size(); ++i) end[i] = z[i][0];
  const auto coordinates = CanonicalChart<double>(chart_of(coordinates_.end), end, canonical_mu)
                               .coordinates({z[0], z[1], z[2], z[3], z[4], z[5]});
  return without_constants(std::vector<Series<double>>(coordinates.begin(), coordinates.end()));
}

std::array<std::string, 6> DeputyFlowPropagation::end_coordinate_names() const {
  if (last_driven_) return last_driven_->end_coordinate_names();
  return last_box_ ? flow_box_coordinate_names(*last_box_->end)
                   : coordinate_names(chart_of(coordinates_.end));
}

std::optional<std::size_t> DeputyFlowPropagation::end_period_place() const {
  if (last_driven_) return 1;
  if (!last_box_ || !last_box_->end->is_bound()) return std::nullopt;
  return 1;
}

std::vector<std::string> DeputyFlowPropagation::variable_names() const {
  if (!last_box_) {
    const auto names = last_driven_ ? last_driven_->variable_names()
                                    : coordinate_names(chart_of(coordinates_.start));
    return {names.begin(), names.end()};
  }
  // The time since the section and the ignored coordinate bypass the polynomials.
  const auto names = flow_box_coordinate_names(*last_box_->start);
  return {names.begin() + 1,
          names.begin() + 1 + static_cast<std::ptrdiff_t>(last_box_->start->variables())};
}

std::vector<std::string> DeputyFlowPropagation::value_names() const {
  const std::array<std::string, 6> names =
      last_driven_ ? last_driven_->value_names() : end_coordinate_names();
  std::vector<std::string> result(names.begin(), names.end());
  // The period is that of the start, so that it is no coordinate of the end.
  if (last_box_) result.erase(result.begin() + 1);
  return result;
}

const IntegrationStatistics& DeputyFlowPropagation::statistics() const {
  return boxes_ ? boxes_->statistics() : jets_->statistics();
}

}  // namespace hamjet
