#include "collision_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "../../integrators/taylor_flow.hpp"
#include "../../uncertainty/cut_passage.hpp"
#include "../../uncertainty/encounter_trajectories.hpp"
#include "../../uncertainty/entry_sampler.hpp"
#include "../flights/manoeuvred_flight.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "along_track_bend.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/map_evaluator.hpp"
#include "initial_states.hpp"
#include "uncertain_parameters.hpp"

namespace hamjet {
namespace {

/// The number of deviations that are flown to each closest approach.
constexpr std::size_t flown_deviations = 64;
/// The fractions of the samples for which a least separation is reported; the smallest contains ten
/// samples.
constexpr std::array<double, 4> separation_shares = {0.001, 0.01, 0.05, 0.5};
constexpr long separation_samples = 10000;
constexpr long flown_separation_samples = 32;

EncounterProblem encounter_problem(const Scene& scene, const CollisionWatch& watch,
                                   const MetricUnits& units) {
  const EncounterSystems systems(scene);
  EncounterProblem problem =
      empty_encounter(scene, systems.chief, watch.from, watch.to, watch.radius_m / units.length_m);
  if (const auto& domains = scene.uncertainty->domains) {
    problem.tolerance = domains->tolerance_m / units.length_m;
    problem.most_parts = static_cast<std::size_t>(domains->most_domains);
  }
  bool is_uncertain = false;
  for (const InitialState& start : initial_states(scene)) {
    UncertainSpacecraft& craft = problem.spacecraft[start.is_chief() ? 0 : 1];
    craft = uncertain_spacecraft(scene, systems, start);
    is_uncertain = is_uncertain || craft.factor.norm() > 0;
  }
  if (problem.spacecraft[0].state.empty()) problem.spacecraft[0].state = scene.nominal;
  if (!is_uncertain) {
    throw Error(ErrorKind::scene,
                "uncertainty.collision: both states are known exactly, must have a covariance of "
                "the chief, the deputy or a burn");
  }
  return problem;
}

/// The relative states of pairs that deviate from the means by standard normal numbers; each pair
/// is flown with the full equations to a time of its own.
std::vector<SixNumbers<double>> flown_pairs(const EncounterProblem& problem,
                                            const std::vector<EncounterDeviation>& deviations,
                                            const std::vector<double>& times) {
  std::vector<SixNumbers<double>> result(deviations.size());
  for (std::size_t craft = 0; craft < 2; ++craft) {
    TaylorFlow flow(problem.system_of(craft));
    std::vector<double> states;
    for (const EncounterDeviation& xi : deviations) {
      const auto start =
          problem.spacecraft[craft].deviated(xi.segment<6>(static_cast<Eigen::Index>(6 * craft)));
      states.insert(states.end(), start.begin(), start.end());
    }
    flow.advance(states, problem.start_time, times);
    for (std::size_t k = 0; k < deviations.size(); ++k) {
      for (std::size_t i = 0; i < 6; ++i) {
        result[k][i] += (craft == 0 ? -1 : 1) * states[6 * k + i];
      }
    }
  }
  return result;
}

/// collision_probability, whose refusals name the key of the scene that causes them.
CollisionProbability probability_of(const EncounterProblem& problem,
                                    const CollisionSettings& settings,
                                    const CollisionWatch& watch) {
  try {
    return collision_probability(problem, settings);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::too_large) {
      throw Error(ErrorKind::too_large,
                  fmt::format("uncertainty.collision.radius_m: too small beside the window, got "
                              "{:.6g}, must be larger, or window_s shorter: {}",
                              watch.radius_m, error.what()));
    }
    if (error.kind() == ErrorKind::usage && watch.sampling == CollisionSampling::entries) {
      throw Error(ErrorKind::scene,
                  fmt::format("uncertainty.collision.sampling: not possible for this encounter, "
                              "got \"entries\", must be \"automatic\" or \"plain\": {}",
                              error.what()));
    }
    throw;
  }
}

std::vector<EncounterDeviation> random_deviations(std::uint64_t seed, std::size_t count) {
  RandomStream random(seed, 0);
  std::vector<EncounterDeviation> deviations(count);
  for (EncounterDeviation& deviation : deviations) {
    for (double& x : deviation) x = random.normal();
  }
  return deviations;
}

double norm_of_slice(const Series<double>& series) {
  double square = 0;
  for (const double c : series.slice(1)) square += c * c;
  return std::sqrt(square);
}

/// Compares with flights to the times that the polynomials give.
void fly(const EncounterProblem& problem, const ClosestApproach& approach, std::uint64_t seed,
         const MetricUnits& units, UncertainApproach& result) {
  const std::vector<EncounterDeviation> deviations = random_deviations(seed, flown_deviations);
  std::vector<Series<double>> map = approach.state;
  map.push_back(approach.delay);
  const MapEvaluator evaluator(map);
  std::vector<double> points(encounter_variables * flown_deviations);
  std::vector<double> values(map.size() * flown_deviations);
  for (std::size_t k = 0; k < flown_deviations; ++k) {
    for (std::size_t i = 0; i < encounter_variables; ++i) {
      points[i * flown_deviations + k] = deviations[k][static_cast<Eigen::Index>(i)];
    }
  }
  evaluator.evaluate(points, {.values = values, .last = {}, .last_but_one = {}});
  std::vector<double> times;
  for (std::size_t k = 0; k < flown_deviations; ++k) {
    times.push_back(approach.time + values[6 * flown_deviations + k]);
  }
  // Where the polynomials are meaningless, they give times that no flight would reach.
  const double span = problem.to - problem.from;
  for (const double time : times) {
    if (!(time > problem.from - span && time < problem.to + span)) return;
  }
  const auto flown = flown_pairs(problem, deviations, times);
  for (std::size_t k = 0; k < flown_deviations; ++k) {
    double square = 0;
    double rate = 0;
    double speed = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      square += std::pow(flown[k][i] - values[i * flown_deviations + k], 2);
      rate += flown[k][i] * flown[k][i + 3];
      speed += std::pow(flown[k][i + 3], 2);
    }
    // For a flight that ends in the centre, polynomials cannot be right.
    if (!std::isfinite(square + rate) || !(speed > 0)) return;
    result.position_error_m = std::max(result.position_error_m, std::sqrt(square) * units.length_m);
    result.time_error_s = std::max(result.time_error_s, std::abs(rate) / speed * units.time_s);
  }
  result.flights = static_cast<int>(flown_deviations);
}

std::array<ApproachingSpacecraft, 2> both_at(const EncounterProblem& problem,
                                             const EncounterTrajectories& linear, double time,
                                             const MetricUnits& units) {
  std::array<ApproachingSpacecraft, 2> result;
  for (std::size_t craft = 0; craft < 2; ++craft) {
    const FlowJet<double> jet = linear.jet(craft, time);
    for (const Series<double>& component : jet) result[craft].state.push_back(component[0]);
    const ChiefFrame own(result[craft].state, units, RelativeFrame::rtn_inertial);
    result[craft].covariance = Covariance::of_factor(
        relative_states_of_deviations(own) * linear_part(jet) * problem.spacecraft[craft].factor);
  }
  return result;
}

UncertainApproach uncertain_approach(const EncounterProblem& problem,
                                     const ClosestApproach& approach, std::uint64_t seed,
                                     const MetricUnits& units) {
  UncertainApproach result;
  const auto norm_of = [&](std::size_t first) {
    return std::sqrt(std::pow(approach.state[first][0], 2) +
                     std::pow(approach.state[first + 1][0], 2) +
                     std::pow(approach.state[first + 2][0], 2));
  };
  const double distance = norm_of(0);
  result.time = approach.time;
  result.time_s = approach.time * units.time_s;
  result.distance_m = distance * units.length_m;
  result.speed_m_s = norm_of(3) * units.velocity_m_s();
  result.time_deviation_s = norm_of_slice(approach.delay) * units.time_s;
  // d|rho| = d(|rho|^2) / (2 |rho|).
  if (distance > 0) {
    result.distance_deviation_m =
        norm_of_slice(approach.squared_distance) / (2 * distance) * units.length_m;
  }
  fly(problem, approach, seed, units, result);
  try {
    ShortEncounter plane = short_encounter(problem, approach.time);
    plane.time *= units.time_s;
    plane.passage *= units.time_s;
    plane.speed *= units.velocity_m_s();
    plane.distance *= units.length_m;
    for (double& x : plane.offset) x *= units.length_m;
    for (double& x : plane.deviation) x *= units.length_m;
    result.plane = plane;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    result.refusal = error.what();
  }
  return result;
}

/// Converts to metres and seconds.
CollisionProbability in_si(CollisionProbability probability, const MetricUnits& units) {
  for (double& time : probability.times) time *= units.time_s;
  probability.path_error *= units.length_m;
  for (auto* radius : {&probability.sampled_radius, &probability.largest_difference}) {
    if (*radius) **radius *= units.length_m;
  }
  return probability;
}

/// The warning about the whole passage, if an edge of the scene's own window cuts it.
std::string cut_warning(const CollisionResult& result) {
  return fmt::format(
      "an edge of the window {:.9g} s to {:.9g} s cuts a passage: of the whole of it, {:.9g} s to "
      "{:.9g} s, the probability is {:.4e}, not {:.4e}",
      result.from_s, result.to_s, result.whole_from_s, result.whole_to_s,
      result.of_whole_passage->probability, result.probability.probability);
}

}  // namespace

const CollisionProbability& probability_of_passage(const CollisionResult& result) {
  return result.of_whole_passage ? *result.of_whole_passage : result.probability;
}

const UncertainApproach* nearest_approach(const CollisionResult& result) {
  const auto nearest = std::min_element(
      result.approaches.begin(), result.approaches.end(),
      [](const auto& one, const auto& other) { return one.distance_m < other.distance_m; });
  return nearest == result.approaches.end() ? nullptr : &*nearest;
}

bool has_whole_passage(const CollisionResult& result) {
  if (result.of_whole_passage || !result.watch.has_window) return true;
  const UncertainApproach* const nearest = nearest_approach(result);
  return nearest == nullptr || !nearest->is_cut;
}

CollisionResult study_collision(const Scene& scene, std::size_t threads,
                                const ProgressCallback& progress) {
  require_coasting(scene);
  const bool is_asked_for = scene.uncertainty && scene.uncertainty->collision;
  require_formation_problem(scene, is_asked_for, "uncertainty.collision");
  require_known_parameters(scene, "uncertainty.collision");
  CollisionResult result;
  const auto began = std::chrono::steady_clock::now();
  result.watch = *scene.uncertainty->collision;
  result.order = scene.order;
  const MetricUnits units = metric_units(scene);
  EncounterProblem problem = encounter_problem(scene, result.watch, units);
  for (std::size_t craft = 0; craft < 2; ++craft) {
    const GaussianIn in =
        problem.spacecraft[craft].straight ? GaussianIn::elements : GaussianIn::positions;
    result.gaussian_in[craft] = gaussian_in_names[static_cast<std::size_t>(in)];
  }
  std::optional<EncounterProblem> whole = with_whole_passages(problem);
  // Before a burn that ends at the start, the trajectory is a different one.
  if (whole && scene.uncertainty->burn && problem.from >= 0 && whole->from < 0) {
    result.is_cut_by_burn = true;
    result.warnings.push_back(
        "the burn at the start lies inside a passage, before which the trajectory is a different "
        "one: the probability is of what follows the burn, not of the encounter");
    whole->from = 0;
    if (problem.from == 0 && whole->to == problem.to) whole.reset();
  }
  if (whole && !result.watch.has_window) {
    problem = *whole;
    result.is_widened = true;
  }
  result.from_s = problem.from * units.time_s;
  result.to_s = problem.to * units.time_s;

  CollisionSettings settings;
  settings.event = result.watch.event;
  settings.sampling = result.watch.sampling;
  settings.samples = result.watch.samples;
  settings.confidence = result.watch.confidence;
  settings.seed = scene.uncertainty->seed;
  settings.threads = threads;
  if (progress) {
    settings.progress = [&](double fraction) { progress("collision", fraction); };
  }
  result.probability = in_si(probability_of(problem, settings, result.watch), units);
  if (whole && !result.is_widened) {
    result.of_whole_passage = in_si(probability_of(*whole, settings, result.watch), units);
    result.whole_from_s = whole->from * units.time_s;
    result.whole_to_s = whole->to * units.time_s;
    result.warnings.push_back(cut_warning(result));
  }
  const double path_error_m = probability_of_passage(result).path_error;
  if (problem.tolerance && path_error_m > scene.uncertainty->domains->tolerance_m) {
    result.warnings.push_back(fmt::format(
        "distances along a path are right to {:.2g} m and not to tolerance_m: a higher jet.order "
        "or most_domains would be needed",
        path_error_m));
  }
  settings.samples = separation_samples;
  if (progress) {
    settings.progress = [&](double fraction) { progress("separations", fraction); };
  }
  result.separations =
      least_separations(problem, settings, {separation_shares.begin(), separation_shares.end()},
                        flown_separation_samples);
  result.separations.scale(units.length_m);
  // Series in twelve variables grow fast, and a deviation of the time does not need the third
  // order.
  constexpr int highest_order = 3;
  EncounterProblem lower = whole.value_or(problem);
  EncounterProblem first_order = lower;
  lower.order = std::min(problem.order, highest_order);
  first_order.order = 1;
  const EncounterTrajectories linear(first_order);
  std::vector<ClosestApproach> approaches;
  if (problem.system->is_autonomous()) {
    approaches = closest_approaches(lower);
  } else {
    result.warnings.emplace_back(
        "closest approaches are not computed: the forces depend on the time, and the polynomials "
        "know them at the nominal's times alone");
  }
  for (const ClosestApproach& approach : approaches) {
    if (progress) progress("closest approaches", 0);
    result.approaches.push_back(
        uncertain_approach(lower, approach, scene.uncertainty->seed, units));
    UncertainApproach& told = result.approaches.back();
    told.spacecraft = both_at(lower, linear, approach.time, units);
    // Approaches of whole passages, which the conjunction data message tells of, may be outside of
    // the window.
    told.is_in_window = told.time >= problem.from && told.time <= problem.to;
    if (told.plane) {
      told.is_cut = told.time_s - told.plane->passage < result.from_s ||
                    told.time_s + told.plane->passage > result.to_s;
    }
  }
  const UncertainApproach* const nearest = nearest_approach(result);
  if (!has_whole_passage(result)) {
    result.warnings.push_back(fmt::format(
        "the approach at {:.6g} s is slow and not over within the window {:.9g} s to {:.9g} s: the "
        "probability is of this window, not of the encounter",
        nearest->time_s, result.from_s, result.to_s));
  }
  const EncounterDeviation of_collisions = nearest
                                               ? deviation_of_meeting(linear.linear(nearest->time))
                                               : EncounterDeviation(EncounterDeviation::Zero());
  if (const auto warning =
          along_track_warning(along_track_bend(problem, of_collisions), problem.radius,
                              {"chief", "deputy"}, "the probability", units)) {
    result.warnings.push_back(*warning);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return result;
}

}  // namespace hamjet
