#include "charted_jet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <utility>

#include "../../../algebra/raise_to.hpp"
#include "../../../charts/coordinate_units.hpp"
#include "../../../integrators/momentum_unit.hpp"
#include "../../largest_coefficient.hpp"
#include "../../stopwatch.hpp"
#include "deputy_flows.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/error.hpp"
#include "orbit_charts.hpp"

namespace hamjet {
namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();

/// A scene's flow box at its duration, integrated from this start.
FlowBoxMap<double> integrated_flow_box(const Scene& scene, const SixNumbers<double>& start,
                                       const GaussSettings& settings) {
  const ZonalGravity field = orbit_field(scene);
  return FlowBoxPropagation<double>(field, section_chart(start, field.mu), start, scene.order,
                                    settings)
      .advance_to(scene.duration);
}

/// The polynomials of a flow box in units that suit the chief, in which the coefficients of a
/// degree can be compared.
FlowJet<Extended> comparable_flow_box(const Scene& scene, ChartName section,
                                      const FlowJet<Extended>& jet) {
  const FlowBoxUnits units(section, initial_distance(scene.nominal), orbit_field(scene).mu);
  return in_units(jet, units.values, units.variables);
}

FlowJet<Extended> values_of_flow_box(const FlowBoxMap<double>& map) {
  std::vector<Series<double>> values = {map.time};
  values.insert(values.end(), map.coordinates.begin(), map.coordinates.end());
  return convert_map<Extended>(values);
}

void integrate_flow_box(const Scene& scene, const RunResult& run, ChartedJet& result) {
  const FlowBoxMap<double> map =
      integrated_flow_box(scene, six_numbers(scene.nominal), gauss_settings_of(run.settings));
  result.section = map.start->chart().name();
  result.jet = values_of_flow_box(map);
  const SixNumbers<double>& end = map.end->origin();
  result.nominal_final.assign(end.begin(), end.end());
  result.symplecticity = map.symplecticity();
}

/// The largest difference of two states: of positions relative to the largest position of the
/// second state, and of momenta likewise. So neither depends on the unit of length.
double relative_difference(std::span<const double> state, std::span<const double> other) {
  double result = 0;
  const std::size_t n = state.size() / 2;
  for (const std::size_t first : {std::size_t{0}, n}) {
    double difference = 0;
    double largest = 0;
    for (std::size_t i = first; i < first + n; ++i) {
      raise_to(difference, std::abs(state[i] - other[i]));
      raise_to(largest, std::abs(other[i]));
    }
    raise_to(result, difference / largest);
  }
  return result;
}

/// A start moved by a unit in the last place of its largest position and momentum, so that all
/// later roundings are different ones.
SixNumbers<double> moved_start(const Scene& scene, std::mt19937_64& generator) {
  SixNumbers<double> start = six_numbers(scene.nominal);
  for (const std::size_t first : {std::size_t{0}, std::size_t{3}}) {
    double largest = 0;
    for (std::size_t i = first; i < first + 3; ++i) raise_to(largest, std::abs(start[i]));
    for (std::size_t i = first; i < first + 3; ++i) {
      start[i] += ((generator() & 1) == 0 ? rounding : -rounding) * largest;
    }
  }
  return start;
}

void estimate_flow_box_error(const Scene& scene, ChartedJet& result) {
  std::vector<double> errors(static_cast<std::size_t>(scene.order) + 1, rounding);
  std::mt19937_64 generator(1);
  for (const int stages : {16, 15}) {
    GaussSettings settings;
    settings.stages = stages;
    settings.tolerance = 4 * rounding;
    settings.controls_all_degrees = true;
    const FlowBoxMap<double> map =
        integrated_flow_box(scene, moved_start(scene, generator), settings);
    const auto comparable = [&](const FlowJet<Extended>& jet) {
      return comparable_flow_box(scene, *result.section, jet);
    };
    std::vector<double> shown =
        relative_error_by_degree(comparable(result.jet), comparable(values_of_flow_box(map)));
    raise_to(shown[0], relative_difference(result.nominal_final, map.end->origin()));
    for (std::size_t d = 0; d < errors.size(); ++d) raise_to(errors[d], shown[d]);
  }
  result.error_estimate.by_degree = std::move(errors);
}

/// Does work that may be impossible for an orbit or a method; the failure then gives the reason.
template <class Work>
void record_failure_of_orbit(std::string& failure, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::scene) throw;
    failure = error.what();
  }
}

void change_charts(const Scene& scene, const RunResult& run, ChartedJet& result) {
  const OrbitCharts charts(scene.coordinates, scene.nominal, run.nominal_final);
  result.jet = charts.into(FlowMap<Extended>(run.jet)).jet();
  round_to(scene.precision, result.jet);
  result.nominal_final = run.nominal_final;
  result.symplecticity = symplecticity_by_degree(result.jet);
}

}  // namespace

bool DegreesWithoutDigits::are_behind(const SymplecticityDefect& defect) const {
  // Degree k of the brackets has products of slices a and b, where a + b = k + 2, from 1 to k + 1.
  if (defect.degree == 0) return false;
  for (int degree = 2; degree <= defect.degree + 1; ++degree) {
    if (std::find(negligible.begin(), negligible.end(), degree) == negligible.end()) return false;
  }
  return true;
}

DegreesWithoutDigits degrees_without_digits(const Scene& scene, const ChartedJet& charted) {
  constexpr double largest_negligible = 1e-6;
  constexpr double largest_defect = 0.1;
  DegreesWithoutDigits result;
  if (!charted.section || !charted.failure.empty()) return result;
  const FlowJet<Extended> jet = comparable_flow_box(scene, *charted.section, charted.jet);
  const auto& errors = charted.error_estimate.by_degree;
  const double linear = largest_coefficient(jet, 1);
  for (int degree = 2; degree <= scene.order; ++degree) {
    const double size = largest_coefficient(jet, degree);
    const double error = errors ? (*errors)[static_cast<std::size_t>(degree)] * size : 0;
    const bool has_defect = std::any_of(
        charted.symplecticity.begin(), charted.symplecticity.end(), [&](const auto& defect) {
          return defect.degree + 1 == degree && !(defect.scaled < largest_defect);
        });
    if (error < size && !has_defect) continue;
    const double share = std::max(size, error) / linear;
    if (share < largest_negligible) {
      result.negligible.push_back(degree);
      raise_to(result.largest_share, share);
    } else {
      result.wrong.push_back(degree);
    }
  }
  return result;
}

std::optional<std::string> reason_without_charted_jet(const Scene& scene) {
  if (scene.coordinates == JetCoordinates::cartesian) return std::nullopt;
  if (scene.coordinates == JetCoordinates::automatic) {
    return "which reach furthest is measured by validity, motion, transfer, assign and eval; a run "
           "takes them by name";
  }
  if (scene.variables.size() != scene.nominal.size()) {
    return "coordinates are of orbits expanded in all six variables";
  }
  if (scene.coordinates == JetCoordinates::flow_box && scene.system.earth) {
    return "flow boxes of forces that depend on the time are made where deputies are predicted, by "
           "eval, validity, motion, transfer, assign and uncertainty; a run keeps none";
  }
  if (scene.coordinates == JetCoordinates::flow_box && scene.precision == Precision::extended) {
    return "flow boxes are of double precision";
  }
  return std::nullopt;
}

ChartedJet charted_jet(const Scene& scene, const RunResult& run) {
  ChartedJet result;
  result.coordinates = scene.coordinates;
  const bool is_flow_box = scene.coordinates == JetCoordinates::flow_box;
  {
    const Stopwatch watch(result.seconds);
    record_failure_of_orbit(result.failure, [&] {
      if (is_flow_box) {
        integrate_flow_box(scene, run, result);
      } else {
        change_charts(scene, run, result);
      }
    });
  }
  JetErrorEstimate& estimate = result.error_estimate;
  if (!result.failure.empty()) {
    estimate.failure = "there are no polynomials";
  } else if (!is_flow_box) {
    estimate.failure = "they are composed of the run's jet, whose errors are theirs";
  } else if (!scene.checks[SelfCheckName::error_estimate].is_on) {
    estimate.failure = "the scene has turned it off";
  } else {
    const Stopwatch watch(estimate.seconds);
    record_failure_of_orbit(estimate.failure, [&] { estimate_flow_box_error(scene, result); });
  }
  return result;
}

}  // namespace hamjet
