#include "hamjet/studies/transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "../../integrators/momentum_unit.hpp"
#include "../checks/flight_checks.hpp"
#include "../flights/paced_times.hpp"
#include "../formation_scale.hpp"
#include "../jets_along_time.hpp"
#include "../stopwatch.hpp"
#include "budget_windows.hpp"
#include "burns/finite_burns.hpp"
#include "charts/free_coordinates.hpp"
#include "coasting_transfer.hpp"
#include "flown_trajectory.hpp"
#include "formation_problem.hpp"
#include "hamjet/error.hpp"
#include "impulses/impulse_plan.hpp"
#include "least_time.hpp"
#include "other_revolutions.hpp"
#include "single_transfer.hpp"
#include "thrust/energy_optimal.hpp"
#include "thrust/fuel_optimal.hpp"
#include "transfer_points.hpp"
#include "waypoint_plan.hpp"

namespace hamjet {

std::optional<std::size_t> TransferResult::best_point() const {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].is_candidate()) continue;
    if (!best || points[i].change_m_s() < points[*best].change_m_s()) best = i;
  }
  return best;
}

std::vector<SingularTime> TransferResult::position_singularities() const {
  const GeneratingFunctionKind f1 = parse_kind("F1", 3);
  std::vector<SingularTime> found;
  for (const SingularTime& singular : singular_times) {
    if (singular.kind == f1) found.push_back(singular);
  }
  return found;
}

namespace {

/// The chief of an earlier jet may differ from the scene's by no more than integrators do, relative
/// to the size of its start.
constexpr double largest_chief_distance = 1e-6;

void require_same_chief(const Scene& scene, const EarlierJet& earlier, double distance_m) {
  const double start_m = size_of_nominal(scene) * metric_units(scene).length_m;
  if (distance_m <= largest_chief_distance * start_m) return;
  throw Error(ErrorKind::scene,
              fmt::format("transfer: the earlier jet {} is not of this scene: its chief comes to a "
                          "place {:.3g} km from where the scene's does",
                          earlier.label, distance_m / 1000));
}

}  // namespace

// Compiled once, so that command and Python module give the same digits.
double TransferAnswer::total_change_m_s() const {
  return start_change_m_s.norm() + end_change_m_s.norm();
}

TransferResult study_transfer(const Scene& asked, const ProgressCallback& progress,
                              const EarlierJet* given) {
  require_deviation_problem(asked, asked.transfer.has_value(), "transfer");
  require_states_alone(asked, "transfer");
  if (given != nullptr) require_one_spacecraft(asked, "transfer from an earlier jet");
  Scene scene = with_free_coordinates(asked);
  std::optional<EarlierJet> earlier;
  if (given != nullptr) {
    earlier = *given;
    if (scene.nominal.size() != asked.nominal.size()) {
      earlier->jet = with_free_coordinates(given->jet, given->time);
    }
    scene.order = earlier->jet.at(0).order();
    scene.transfer->times = {earlier->time};
  }
  const TransferSettings& settings = *scene.transfer;
  TransferResult result;
  result.scene = scene;
  const RelativeTransfer ends{settings.start, settings.end};
  // A wait that is too long is refused before the work starts.
  const ComputedProblem problem = make_problem(with_deputy_coefficients(scene));
  std::optional<CompanionFlow> waiting;
  if (settings.longest_coast) waiting = coasting_flow(scene, problem);
  TransferPoints points(scene, progress, result.seconds);
  result.conditions.kinds = points.kinds();
  result.coordinates = points.coordinates();
  const auto visit = [&](std::size_t index, const FlowJet<double>& jet) {
    const double time = settings.times[index];
    if (progress) {
      progress("transfers",
               static_cast<double>(index) / static_cast<double>(settings.times.size()));
    }
    // The flow grows and shrinks along an orbit; it is largest at a pericentre.
    result.flight_floor_m = std::max(result.flight_floor_m, points.flight_floor_m(jet));
    if (index + 1 == settings.times.size()) {
      result.chief_error_m = points.chief_error_m(time, jet);
    }
    const ChosenKind chosen = points.choose_kind(time, jet, {ends});
    result.points.push_back(points.answer(chosen, jet, ends));
    points.add_drift(ends, result.points.back(), false);
    result.conditions.times.push_back(time);
    result.conditions.values.push_back(chosen.conditions);
  };
  if (earlier) {
    result.integrator = earlier->label;
    require_same_chief(scene, *earlier, points.chief_error_m(earlier->time, earlier->jet));
    visit(0, earlier->jet);
  } else {
    const IntegratorSettings& integrator = symplectic_integrator(scene);
    result.integrator = integrator.label;
    result.statistics = visit_jets(points.jet_problem(), integrator, settings.times, visit);
    result.seconds.propagation = result.statistics.wall_seconds;
    find_least_between(result, points, integrator, ends, progress);
    if (settings.budget_m_s) {
      result.budget_windows = find_budget_windows(result, points, integrator, ends, progress);
    }
  }
  {
    const Stopwatch watch(result.seconds.impulses);
    if (const auto best = result.best_point()) {
      points.add_drift(ends, result.points[*best], true);
      // The primer is that of impulses at any times, which are planned along orbits alone.
      if (is_orbit(scene.system.model)) {
        result.primer =
            primer_history(scene, points.problem(), points.linear_flow(), result.points[*best]);
      }
    }
  }
  if (!settings.waypoints.empty()) {
    const Stopwatch watch(result.seconds.impulses);
    result.waypoints = waypoint_transfers(scene, points.problem(), points.linear_flow(), progress);
  }
  if (settings.longest_coast) {
    const Stopwatch watch(result.seconds.impulses);
    result.coasting = coasting_transfer(scene, problem, *waiting, progress);
  }
  if (!settings.revolutions.empty()) {
    const Stopwatch watch(result.seconds.impulses);
    result.revolutions = other_revolutions(scene, points.problem(), points.linear_flow(), progress);
  }
  if (settings.impulses == TransferImpulses::optimal) {
    const Stopwatch watch(result.seconds.impulses);
    result.optimal =
        optimal_impulses(scene, points.problem(), points.linear_flow(), result, progress);
  }
  if (settings.thrust != TransferThrust::impulses) {
    const Stopwatch watch(result.seconds.thrust);
    result.thrust = energy_optimal_transfers(scene, problem, progress);
  }
  const bool is_fuel_optimal = settings.thrust == TransferThrust::fuel_optimal;
  if (is_fuel_optimal) {
    const Stopwatch watch(result.seconds.fuel);
    result.fuel = fuel_optimal_transfers(scene, points.problem(), points.linear_flow(),
                                         *result.thrust, progress);
  }
  if (scene.thruster && !is_fuel_optimal) {
    const Stopwatch watch(result.seconds.burns);
    result.burns = finite_burns(scene, problem, result, progress);
  }
  // The validity is that of deputies about a chief with their own coefficients.
  if (scene.validity) result.validity = study_validity(with_deputy_coefficients(asked), progress);
  result.hamilton_jacobi_floor = points.hamilton_jacobi_floor();
  result.singular_times = points.singular_times();
  result.checks = flight_checks(scene, flights_of(scene, settings.times.back(), false));
  return result;
}

int exit_code(const TransferResult& result) {
  bool has_answer = false;
  bool has_fault = false;
  bool is_forbidden = false;
  for (const TransferPoint& point : result.points) {
    has_answer = has_answer || point.has_answer();
    is_forbidden = is_forbidden || (point.is_proved() && !point.is_allowed());
    if (point.is_near_singular) continue;
    has_fault = has_fault || !point.has_answer() || point.is_beyond_tolerance ||
                (point.refined && !point.is_refined());
  }
  if (!has_answer) return static_cast<int>(ErrorKind::numerical);
  // If the limits forbid two impulses at the listed times, another kind of transfer may keep them.
  const bool has_allowed =
      result.best_point() || (result.optimal && result.optimal->is_found()) ||
      (result.waypoints && result.waypoints->best_plan) ||
      (result.coasting && result.coasting->plan) ||
      (result.revolutions && result.revolutions->best) || (result.thrust && result.thrust->least) ||
      (result.fuel && result.fuel->least) || (result.burns && result.burns->least);
  if (is_forbidden && !has_allowed) return static_cast<int>(ErrorKind::check_failed);
  if (result.optimal && (!result.optimal->is_found() || !result.optimal->is_proved())) {
    return static_cast<int>(ErrorKind::check_failed);
  }
  const bool lacks_way = result.waypoints && !result.waypoints->best_plan;
  const bool lacks_revolutions = result.revolutions && !result.revolutions->best;
  const bool lacks_thrust = result.thrust && !result.thrust->least;
  const bool lacks_fuel = result.fuel && !result.fuel->least;
  const bool lacks_burns = result.burns && !result.burns->least;
  if (lacks_way || lacks_revolutions || lacks_thrust || lacks_fuel || lacks_burns ||
      (result.coasting && !result.coasting->plan)) {
    return static_cast<int>(ErrorKind::check_failed);
  }
  const bool is_failed = has_failed(result.checks) || (result.scene.transfer->strict && has_fault);
  return is_failed ? static_cast<int>(ErrorKind::check_failed) : 0;
}

namespace {

bool has_orbital_plane(const std::vector<double>& chief) {
  try {
    const ChiefFrame frame(chief, MetricUnits{}, RelativeFrame::rtn_rotating);
    return true;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    return false;
  }
}

}  // namespace

RelativeTrajectory fly_relative(const TransferResult& result, std::size_t point,
                                const std::vector<double>& times) {
  const Scene scene = with_deputy_parameters(result.scene);
  const std::vector<double>& chief = scene.nominal;
  const MetricUnits units = metric_units(scene);
  const RelativeFrame asked = scene.transfer->frame;
  const bool has_axes_of_chief = asked != RelativeFrame::coordinates &&
                                 !(asked == RelativeFrame::inertial && !has_orbital_plane(chief));
  const auto fly = [&](const RelativeState& start, const std::vector<double>& to) {
    std::vector<double> deviation =
        ChiefFrame(chief, units, scene.transfer->frame).deviation(start);
    for (const double difference : deputy_parameters(scene)) deviation.push_back(difference);
    return flown_trajectory(scene, deviation,
                            has_axes_of_chief ? RelativeFrame::rtn_rotating : asked, to);
  };
  RelativeState start = scene.transfer->start;
  const int intervals = interval_count(scene, scene.duration, drawn_path);
  std::vector<RelativeState> unchanged =
      fly(start, paced_times(scene, scene.duration, intervals)).states;
  start.velocity_m_s += result.points[point].best().start_change_m_s;
  RelativeTrajectory trajectory = fly(start, times);
  trajectory.unchanged = std::move(unchanged);
  return trajectory;
}

RelativeTrajectory fly_relative(const TransferResult& result, std::size_t point) {
  const double time = result.points[point].time;
  const int intervals = interval_count(result.scene, time, drawn_path);
  return fly_relative(result, point, paced_times(result.scene, time, intervals));
}

}  // namespace hamjet
