#include "uncertainty.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "../checks/flight_checks.hpp"
#include "../formation/charts/deputy_flows.hpp"
#include "../formation/charts/free_coordinates.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "../nominal/nominal_period.hpp"
#include "../stopwatch.hpp"
#include "domain_moments.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/validity.hpp"
#include "initial_states.hpp"
#include "moments_in_coordinates.hpp"
#include "process_noise.hpp"
#include "quadrature.hpp"
#include "sample_memory.hpp"
#include "sampled_flights.hpp"
#include "standard_normals.hpp"
#include "uncertain_parameters.hpp"

namespace hamjet {
namespace {

/// Nodes of the quadrature through curved coordinates: most along what the flow stretches most.
const std::vector<int> finer_nodes = {15, 7, 5, 3, 3, 3};
const std::vector<int> coarser_nodes = {11, 5, 3, 3, 3, 3};

/// The distributions that a flow's polynomials up to each degree from 1 give, at the nodes of a
/// quadrature; none where one of them has no place in the coordinates.
std::vector<std::optional<Cumulants>> moments_through(const DeputyFlow& flow, int order,
                                                      const InitialState& start,
                                                      const Matrix<double>& factor,
                                                      const std::vector<int>& nodes) {
  constexpr std::size_t at_once = 512;  // few enough for their predictions to stay in the cache
  const std::vector<int> of_factor(nodes.begin(), nodes.begin() + factor.cols());
  const NormalQuadrature rule = product_quadrature(of_factor);
  const auto count = static_cast<std::size_t>(rule.weights.size());
  Matrix<double> initial = factor * rule.points;
  for (Eigen::Index k = 0; k < initial.cols(); ++k) {
    initial.col(k) = start.deviation(initial.col(k));
  }
  std::vector<int> degrees(static_cast<std::size_t>(order));
  std::iota(degrees.begin(), degrees.end(), 1);
  std::vector<Matrix<double>> points(degrees.size(), Matrix<double>(6, initial.cols()));
  DeputyPredictor predictor(flow);
  std::vector<SixNumbers<double>> deviations;
  std::vector<DeputyPrediction> predictions;
  for (std::size_t first = 0; first < count; first += at_once) {
    deviations.resize(std::min(at_once, count - first));
    predictions.resize(deviations.size() * degrees.size());
    for (std::size_t k = 0; k < deviations.size(); ++k) {
      std::copy_n(initial.col(static_cast<Eigen::Index>(first + k)).data(), 6,
                  deviations[k].begin());
    }
    predictor.predict(deviations, degrees, predictions);
    for (std::size_t p = 0; p < predictions.size(); ++p) {
      const auto column = static_cast<Eigen::Index>(first + p % deviations.size());
      std::copy_n(predictions[p].deviation.begin(), 6,
                  points[p / deviations.size()].col(column).data());
    }
  }
  std::vector<std::optional<Cumulants>> moments;
  for (const Matrix<double>& of_degree : points) {
    moments.emplace_back();
    if (of_degree.allFinite()) moments.back() = Cumulants::of_points(of_degree, rule.weights);
  }
  return moments;
}

/// The jets of one spacecraft about its own mean, from time to time; the problem is that of
/// scene_of_start.
JetPropagation own_jets(ComputedProblem problem, const IntegratorSettings& settings,
                        const InitialState& start) {
  for (std::size_t i = 0; i < 6; ++i) {
    problem.nominal[i] += start.mean[static_cast<Eigen::Index>(i)];
  }
  return {problem, settings};
}

/// Whether a spacecraft starts so far from the chief that coordinates about the chief say nothing
/// of it.
bool is_distant(const InitialState& start, const Scene& scene) {
  constexpr double part = 0.05;  // a part of the chief's distance from the centre
  return start.mean.head(3).norm() >= part * Eigen::Vector3d(scene.nominal.data()).norm();
}

void map_all(std::vector<Cumulants>& all, const Matrix<double>& map) {
  for (Cumulants& one : all) one = one.mapped(map);
}

/// Adds to every column what the noise of the acceleration adds at one time.
void add_noise(Matrix<double>& deviations, const Covariance& noise, StandardNormals& normals) {
  const Cumulants reduced(Vector<double>::Zero(6), noise);
  for (Eigen::Index k = 0; k < deviations.cols(); ++k) {
    for (Eigen::Index i = 0; i < reduced.rank(); ++i) {
      deviations.col(k) += normals() * reduced.axes().col(i);
    }
  }
}

/// The moments at one time, of canonical deviations from the chief, whose jet is `jet`; `own` is
/// that about the spacecraft's own mean, which is `between` from the chief. `flow`, `coordinates`
/// and `period_place` are those of the scene's other coordinates, if it has such.
UncertainState moments_of(const InitialState& start, const FlowJet<double>& jet,
                          const FlowJet<double>& own, bool keeps_volumes,
                          const Vector<double>& between, const DeputyFlow* flow,
                          const std::vector<Series<double>>& coordinates,
                          std::optional<std::size_t> period_place,
                          const std::optional<Covariance>& noise) {
  const int order = jet[0].order();
  UncertainState state;
  state.name = start.name;
  state.cartesian = moments_by_order(without_constants(own), {start.name, Vector<double>::Zero(6),
                                                              start.covariance, start.straight});
  const Matrix<double> linear = linear_part(own);
  const double change =
      keeps_volumes || linear.cols() != 6
          ? 0
          : std::log(std::abs(Eigen::PartialPivLU<Matrix<double>>(linear).determinant()));
  told_of_start(state.cartesian, start, change);
  if (between.norm() > 0) add_noise(state.cartesian, Cumulants(between, {}));
  if (flow) {
    state.charted = charted_moments(coordinates, period_place, start, jet, noise);
    const Matrix<double> factor = stretched_factor(start.covariance, linear_part(jet));
    if (factor.cols() > 0) {
      const auto fine = moments_through(*flow, order, start, factor, finer_nodes);
      const auto coarse = moments_through(*flow, order, start, factor, coarser_nodes);
      for (std::size_t n = 0; n < fine.size(); ++n) {
        if (!fine[n] || !coarse[n]) {
          state.through.clear();
          break;
        }
        state.through.push_back(*fine[n]);
        const MomentsDifference doubt = difference_of(*fine[n], *coarse[n]);
        state.through_doubt =
            std::max({state.through_doubt, doubt.deviation, doubt.skewness, doubt.kurtosis});
      }
    }
    told_of_start(state.through, start, change);
  }
  if (noise) {
    const Cumulants added(Vector<double>::Zero(6), *noise);
    add_noise(state.cartesian, added);
    add_noise(state.through, added);
  }
  return state;
}

/// The place of a start's mean at one of the times.
MeanOfStart mean_of(const InitialState& start, const FlowJet<double>& jet,
                    const FlowJet<double>& own, const Matrix<double>& to_frame) {
  MeanOfStart mean{Vector<double>(6), to_frame, {}};
  for (Eigen::Index i = 0; i < 6; ++i) {
    const auto c = static_cast<std::size_t>(i);
    mean.deviation[i] = own[c][0] - jet[c][0];
  }
  mean.standard_deviations =
      start.covariance.mapped(Matrix<double>(to_frame * linear_part(own))).standard_deviations();
  return mean;
}

/// The deputy less the chief, independent of each other.
UncertainState difference(const UncertainState& deputy, const UncertainState& chief) {
  UncertainState result;
  result.name = "relative";
  result.cartesian = difference_by_order(deputy.cartesian, chief.cartesian);
  result.through = difference_by_order(deputy.through, chief.through);
  result.through_doubt = std::max(deputy.through_doubt, chief.through_doubt);
  result.charted = difference_by_order(deputy.charted, chief.charted);
  if (deputy.flown && chief.flown) {
    result.flown_states = deputy.flown_states - chief.flown_states;
    result.flown = flown_moments(result.flown_states);
  }
  return result;
}

}  // namespace

MomentsDifference difference_of(const Cumulants& one, const Cumulants& other) {
  const auto worst = [](const Vector<double>& v) { return v.size() ? v.cwiseAbs().maxCoeff() : 0; };
  MomentsDifference result;
  result.skewness = worst(one.skewness() - other.skewness());
  result.kurtosis = worst(one.excess_kurtosis() - other.excess_kurtosis());
  const Vector<double> s = one.standard_deviations();
  const Vector<double> others = other.standard_deviations();
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    if (s[i] > 0) result.deviation = std::max(result.deviation, std::abs(others[i] / s[i] - 1));
  }
  return result;
}

double divergence_from_linear(const std::vector<Cumulants>& by_order) {
  return divergence_from_gaussian(by_order.back(), by_order.front());
}

UncertaintyResult study_uncertainty(const Scene& asked, const ProgressCallback& progress,
                                    std::size_t threads) {
  require_deviation_problem(asked, asked.uncertainty.has_value(), "uncertainty");
  require_states_alone(asked, "uncertainty");
  const Scene scene = with_free_coordinates(asked);
  require_sample_memory(scene);
  const UncertaintySettings& settings = *scene.uncertainty;
  // Before anything is computed that they would follow.
  if (settings.collision) require_known_parameters(scene, "uncertainty.collision");
  if (settings.safety) require_known_parameters(scene, "uncertainty.safety");
  UncertaintyResult result;
  result.scene = scene;
  const MetricUnits units = metric_units(scene);
  const std::vector<std::size_t> told = told_components(scene.system);
  const std::vector<InitialState> starts = initial_states(scene);
  for (const InitialState& start : starts) {
    if (!start.why_straight.empty()) result.start_notes.push_back(start.why_straight);
  }
  require_moments_of_parameters(scene, starts);
  const ComputedProblem problem = make_problem(scene);
  const IntegratorSettings& integrator = symplectic_integrator(scene);
  result.integrator = integrator.label;
  const bool have_own_flows =
      std::any_of(starts.begin(), starts.end(),
                  [&](const InitialState& start) { return takes_own_flow(scene, start); });
  const ChosenCoordinates coordinates_at_ends =
      have_own_flows ? ChosenCoordinates{} : measured_coordinates_of(scene);
  result.coordinates = coordinates_at_ends;
  result.coordinates.start = coordinates_at_ends.end;
  const bool is_charted = result.coordinates != JetCoordinates::cartesian;
  JetPropagation jets(problem, integrator);
  // The chief's mean is its nominal.
  std::vector<std::optional<JetPropagation>> own_flows(starts.size());
  std::vector<Scene> own_scenes(starts.size(), scene);
  std::vector<SharedSystem> own_systems(starts.size(), problem.system);
  for (std::size_t s = 0; s < starts.size(); ++s) {
    ComputedProblem own = problem;
    const bool has_own = takes_own_flow(scene, starts[s]);
    if (has_own) {
      own_scenes[s] = scene_of_start(scene, starts[s]);
      own = make_problem(own_scenes[s]);
      own_systems[s] = own.system;
    }
    const bool is_moved = (starts[s].mean.array() != 0).any();
    if (is_moved || has_own) own_flows[s].emplace(own_jets(std::move(own), integrator, starts[s]));
  }
  std::optional<DeputyFlowPropagation> charts;
  if (is_charted) charts.emplace(scene, problem, integrator, coordinates_at_ends);
  ComputedProblem linear = problem;
  linear.space = SeriesSpace::create(problem.variables.size(), 1);
  std::optional<ProcessNoise> noise;
  if (settings.acceleration_density_m2_s3 > 0) {
    const double density = settings.acceleration_density_m2_s3 * std::pow(units.time_s, 3) /
                           (units.length_m * units.length_m);
    noise.emplace(linear, integrator, density,
                  nominal_period(scene).value_or(2 * std::numbers::pi));
  }
  StandardNormals normals(settings.seed);
  std::vector<SampledFlights> flights;
  Matrix<double> common_normals;
  for (std::size_t s = 0; s < starts.size() && settings.samples >= 2; ++s) {
    flights.emplace_back(own_systems[s], own_scenes[s], starts[s], settings.samples, normals,
                         common_normals);
  }
  SampledFlights flown_chief = SampledFlights::of_nominal(problem.system, scene);

  FlowJet<double> jet_at_end;
  std::vector<Matrix<double>> linear_flows;  ///< at the time, along the frame
  std::vector<MeanOfStart> means(starts.size());
  std::optional<Covariance> noise_at_end;
  std::vector<TimeOfDomains> times_of_domains;
  std::vector<Matrix<double>> own_linear_parts;  ///< at the last time
  for (std::size_t t = 0; t < settings.times.size(); ++t) {
    const double time = settings.times[t];
    if (progress) {
      progress("moments", static_cast<double>(t) / static_cast<double>(settings.times.size()));
    }
    UncertaintyAt at{time, {}, {}};
    const FlowJet<double> jet = jets.advance_to(time);
    std::unique_ptr<DeputyFlow> flow;
    std::vector<Series<double>> coordinates;
    std::optional<std::size_t> period_place;
    if (charts) {
      flow = charts->advance_to(time);
      coordinates = charts->end_coordinates();
      at.charted_names = charts->end_coordinate_names();
      period_place = charts->end_period_place();
    }
    std::vector<double> chief;
    for (const Series<double>& component : jet) chief.push_back(component[0]);
    const Matrix<double> to_frame =
        relative_states_of_deviations(ChiefFrame(chief, units, settings.frame))(told, Eigen::all);
    std::optional<Covariance> added;
    if (noise) added = noise->at(time);
    if (!flights.empty()) flown_chief.advance_to(time, {});
    std::vector<FlowJet<double>> own_jets_at;
    for (std::size_t s = 0; s < starts.size(); ++s) {
      UncertainState state;
      {
        const Stopwatch watch(result.moments_seconds);
        FlowJet<double> own = own_flows[s] ? own_flows[s]->advance_to(time) : jet;
        own.erase(own.begin() + 6, own.end());  // the parameters, which stay
        means[s] = mean_of(starts[s], jet, own, to_frame);
        const bool has_charts =
            flow && !is_distant(starts[s], scene) &&
            miss_of_mean(*flow, scene.order, starts[s], means[s]) <= largest_miss;
        state = moments_of(starts[s], jet, own, problem.system->is_hamiltonian, means[s].deviation,
                           has_charts ? flow.get() : nullptr, coordinates, period_place, added);
        map_all(state.cartesian, to_frame);
        map_all(state.through, to_frame);
        own_jets_at.push_back(std::move(own));
      }
      if (s < flights.size()) {
        const Stopwatch watch(result.flight_seconds);
        flights[s].advance_to(time, progress);
        state.flown_states = flights[s].deviations(flown_chief.first());
        if (added) add_noise(state.flown_states, *added, normals);
        state.flown_states = to_frame * state.flown_states;
        if (!state.flown_states.allFinite()) {
          throw Error(
              ErrorKind::numerical,
              fmt::format("uncertainty: a sample of the {} flew {} before {:.6g} s; the "
                          "covariance is too large for its {}",
                          state.name,
                          is_orbit(scene.system.model) ? "into the centre"
                                                       : "where its equations have no value",
                          time * units.time_s, is_orbit(scene.system.model) ? "orbit" : "motion"));
        }
        state.flown = flown_moments(state.flown_states);
        const std::optional<double>& volume = state.cartesian.front().gaussian_log_volume();
        if (volume) state.flown->cumulants.carried_without_compression(*volume);
      }
      at.states.push_back(std::move(state));
    }
    if (at.states.size() == 2) at.states.push_back(difference(at.states[1], at.states[0]));
    if (at.states.size() == 3 && starts[0].common > 0) {
      const Stopwatch watch(result.moments_seconds);
      std::vector<Cumulants>& relative = at.states[2].cartesian;
      relative = relative_moments(without_constants(own_jets_at[1]), starts[1],
                                  without_constants(own_jets_at[0]), starts[0]);
      const Vector<double> between = means[1].deviation - means[0].deviation;
      add_noise(relative, Cumulants(between, added ? added->plus(*added) : Covariance()));
      map_all(relative, to_frame);
    }
    linear_flows.clear();
    own_linear_parts.clear();
    for (const FlowJet<double>& own : own_jets_at) {
      own_linear_parts.push_back(linear_part(own));
      linear_flows.push_back(to_frame * own_linear_parts.back());
    }
    times_of_domains.push_back(
        {Eigen::Map<const Vector<double>>(chief.data(), 6), to_frame, added});
    result.points.push_back(std::move(at));
    jet_at_end = jet;
    noise_at_end = added;
  }
  if (settings.domains) {
    const Stopwatch watch(result.moments_seconds);
    set_domains(result, starts, integrator, own_linear_parts, times_of_domains, progress);
  }
  result.parameter_effects = parameter_effects(starts, linear_flows);
  result.checks = flight_checks(scene, flights_of(scene, settings.times.back(), true));
  result.in_coordinates = moments_in_coordinates(scene, problem, integrator, starts, jet_at_end,
                                                 means, noise_at_end, progress);
  if (settings.collision) result.collision = study_collision(scene, threads, progress);
  if (settings.safety) result.safety = study_safety(scene, threads, progress);
  result.propagation_seconds =
      jets.statistics().wall_seconds + (charts ? charts->statistics().wall_seconds : 0);
  for (const auto& own : own_flows) {
    if (own) result.propagation_seconds += own->statistics().wall_seconds;
  }
  return result;
}

}  // namespace hamjet
