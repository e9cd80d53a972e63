#include "many_flows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arcs.hpp"
#include "descriptions/method_description.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "integration.hpp"
#include "scene_trajectory.hpp"

namespace hamjet {
namespace {

constexpr const char* who = "many orbits";

void require_states(const Scene& scene, std::vector<std::vector<double>>& states, bool is_in_km) {
  const std::size_t size = scene.nominal.size();
  if (is_in_km && !is_orbit(scene.system.model)) {
    throw Error(ErrorKind::usage, fmt::format("{}: the model has no states in km, must be given "
                                              "canonical ones",
                                              who));
  }
  const double length = scene.units.length_km;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].size() != size) {
      throw Error(ErrorKind::usage, fmt::format("{}: state {} has {} numbers, must have {}", who, i,
                                                states[i].size(), size));
    }
    // Parameters behind positions and velocities have their own units.
    for (std::size_t k = 0; k < 6 && is_in_km; ++k) {
      states[i][k] /= k < 3 ? length : length / scene.units.time_s;
    }
  }
}

/// The problem with all degrees of freedom that at least one of the states needs. Each number of
/// its nominal is the largest magnitude that this number has in any of the states.
ComputedProblem problem_of(const Scene& scene, const std::vector<std::vector<double>>& states) {
  Scene of_all = scene;
  std::fill(of_all.nominal.begin(), of_all.nominal.end(), 0);
  for (const std::vector<double>& state : states) {
    for (std::size_t k = 0; k < state.size(); ++k) {
      if (std::isfinite(state[k])) {
        of_all.nominal[k] = std::max(of_all.nominal[k], std::abs(state[k]));
      }
    }
  }
  return make_problem(of_all);
}

}  // namespace

PropagationResult ManyFlows::result_of(std::size_t orbit) const {
  PropagationResult result;
  result.scene = scene;
  result.scene.nominal = states[orbit];
  result.problem = problem;
  for (std::size_t c = 0; c < problem.components.size(); ++c) {
    result.problem.nominal[c] = states[orbit][problem.components[c]];
  }
  RunResult run;
  run.settings = settings;
  run.statistics = outcomes[orbit].statistics;
  run.jet = convert_map<Extended>(outcomes[orbit].jet);
  run.nominal_final = full_state(run.jet, problem, scene.nominal.size());
  result.runs.push_back(std::move(run));
  return result;
}

ManyFlows study_many_flows(const Scene& scene, std::string_view label,
                           std::vector<std::vector<double>> states, bool is_in_km,
                           std::size_t threads, const ProgressCallback& progress) {
  require_unsplit(scene, who);
  if (scene.precision == Precision::extended) {
    throw Error(ErrorKind::scene, fmt::format("{}: precision: is extended, must be double", who));
  }
  if (scene.system.earth && scene.system.earth->sunlight) {
    throw Error(
        ErrorKind::scene,
        fmt::format("{}: system.shadow: is that of one orbit, got orbits that each have their "
                    "own, must be \"none\"",
                    who));
  }
  ManyFlows flows;
  flows.scene = scene;
  flows.settings = gauss_run_of(scene, label, who, "lanes for orbits");
  require_states(scene, states, is_in_km);
  flows.states = std::move(states);
  if (flows.states.empty()) {
    flows.problem = make_problem(scene);
    return flows;
  }
  flows.problem = problem_of(scene, flows.states);
  std::vector<std::vector<double>> starts;
  for (const std::vector<double>& state : flows.states) {
    std::vector<double>& start = starts.emplace_back();
    for (const std::size_t c : flows.problem.components) start.push_back(state[c]);
  }
  ManyFlowsSettings many;
  many.threads = threads;
  if (progress) {
    const auto count = static_cast<double>(starts.size());
    many.progress = [&progress, count](std::size_t done) {
      progress(who, static_cast<double>(done) / count);
    };
  }
  flows.outcomes =
      integrate_gauss_many(flow_problem<double>(flows.problem, scene.duration), starts,
                           std::get<GaussSettings>(splittable_method(flows.settings)), many);
  return flows;
}

}  // namespace hamjet
