#include "periodic_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "../bounded/scene_gauss.hpp"
#include "../exact_flow.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/jet_trajectory.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {
namespace {

using Kind = OrbitQuantity::Kind;

constexpr double most_periodic_tolerance = 1e-13;
constexpr std::string_view parameter_head = "parameters.";

/// The scene's system for values of one of its parameters, of which the last ones are kept.
class ParametrisedSystem {
 public:
  ParametrisedSystem(const SystemText& text, const std::string& name) : text_(text) {
    for (place_ = 0; place_ < text_.parameters.size(); ++place_) {
      if (text_.parameters[place_].name == name) break;
    }
  }

  SharedSystem operator()(double value) {
    if (const auto kept = kept_.find(value); kept != kept_.end()) return kept->second;
    constexpr std::size_t most_kept = 16;
    if (kept_.size() == most_kept) kept_.clear();
    text_.parameters[place_].text = fmt::format("{:.17g}", value);
    return kept_.emplace(value, SharedSystem(make_system("own", text_))).first->second;
  }

 private:
  SystemText text_;
  std::size_t place_ = 0;
  std::map<double, SharedSystem> kept_;
};

/// The value of a parameter, which may be an expression of others.
double parameter_value(const SystemText& text, const std::string& name) {
  FunctionText function;
  function.parameters = text.parameters;
  function.outputs = {{"value", name}};
  return convert<double>(evaluate_function(function, {})[0]);
}

PeriodicProblem problem_of(const Scene& scene, const SharedSystem& system) {
  PeriodicProblem problem;
  problem.system = [system](double) { return system; };
  problem.gauss = scene_gauss(scene, most_periodic_tolerance);
  problem.arcs = static_cast<std::size_t>(scene.periodic->arcs);
  problem.tolerance = scene.periodic->tolerance;
  problem.held = orbit_quantity(scene, scene.periodic->hold);
  return problem;
}

/// Points of a turn for a drawing.
PeriodicStudy::Path path_of(const Scene& scene, const PeriodicProblem& problem,
                            const PeriodicOrbit& orbit, std::size_t member) {
  constexpr int parts = 240;
  const Vector<double>& start = orbit.start();
  const JetTrajectory<double> trajectory(
      trajectory_problem(problem.system(orbit.nodes.parameter), {start.begin(), start.end()},
                         ClockTime::epoch(), orbit.nodes.period),
      problem.gauss);
  const CanonicalFactors told = told_factors(scene);
  const bool is_plane = start.size() == 2;
  PeriodicStudy::Path path{member, {}};
  for (int k = 0; k <= parts; ++k) {
    // The last quotient may round beyond the end.
    const double time = k == parts ? orbit.nodes.period : orbit.nodes.period * k / parts;
    const std::vector<double> state = nominal_of(trajectory.at(time));
    path.points.emplace_back(state[0] * told.length,
                             state[1] * (is_plane ? told.momentum : told.length));
  }
  return path;
}

}  // namespace

OrbitQuantity orbit_quantity(const Scene& scene, const std::string& name) {
  if (name == "energy") return {Kind::energy};
  if (name == "period") return {Kind::period};
  const std::vector<std::string_view> variables = variable_names(scene.system);
  const auto place = std::ranges::find(variables, name);
  if (place != variables.end()) {
    return {Kind::variable, static_cast<std::size_t>(place - variables.begin())};
  }
  return {Kind::parameter};
}

double PeriodicStudy::told_factor(const OrbitQuantity& quantity) const {
  const CanonicalFactors told = told_factors(scene);
  switch (quantity.kind) {
    case Kind::energy:
      return told.momentum * told.momentum;
    case Kind::period:
      return told.time;
    case Kind::variable:
      return quantity.variable < scene.nominal.size() / 2 ? told.length : told.momentum;
    case Kind::parameter:
      break;
  }
  return 1;
}

PeriodicStudy study_periodic(const Scene& scene, const ProgressCallback& progress) {
  if (!scene.periodic)
    throw Error(ErrorKind::scene, "periodic: missing, the scene has no such table");
  const SharedSystem system(make_system(scene));
  if (!system->is_autonomous() || !system->is_hamiltonian || system->parameters != 0) {
    throw Error(ErrorKind::scene,
                "periodic: the system has no Hamiltonian, depends on the time or has parameters, "
                "must be an autonomous Hamiltonian system");
  }
  const PeriodicSettings& settings = *scene.periodic;
  PeriodicStudy study{scene, {}, {}};
  PeriodicProblem problem = problem_of(scene, system);
  if (progress) progress("orbit", 0);
  const Vector<double> start = Eigen::Map<const Vector<double>>(
      scene.nominal.data(), static_cast<Eigen::Index>(scene.nominal.size()));
  OrbitNodes guess{{start}, settings.period, 0};
  problem.value = settings.value ? *settings.value / study.told_factor(problem.held)
                                 : quantity_of(problem, problem.held, guess);
  if (problem.held.kind == Kind::period) guess.period = problem.value;
  guess = flown_nodes(problem, guess.states.front(), guess.period, 0);
  PeriodicOrbit first = find_periodic_orbit(problem, guess);
  if (!settings.family) {
    study.family.members.push_back({first, 0});
  } else {
    const PeriodicFamilySettings& family = *settings.family;
    FamilyPath path;
    path.along = orbit_quantity(scene, family.along);
    if (path.along.kind == Kind::parameter) {
      const std::string name = family.along.substr(parameter_head.size());
      first.nodes.parameter = parameter_value(*scene.system.own_text, name);
      problem.has_parameter = true;
      problem.system = [made = std::make_shared<ParametrisedSystem>(*scene.system.own_text, name)](
                           double value) { return (*made)(value); };
    }
    path.to = family.to / study.told_factor(path.along);
    const double from = quantity_of(problem, path.along, first.nodes);
    if (path.to == from) {
      throw Error(ErrorKind::scene,
                  fmt::format("periodic.family.to: got {:.10g}, which the first orbit has, must be "
                              "another value of {}",
                              family.to, family.along));
    }
    constexpr double twentieth = 0.05;
    path.step = family.step
                    ? std::copysign(*family.step / study.told_factor(path.along), path.to - from)
                    : twentieth * (path.to - from);
    path.most_members = static_cast<std::size_t>(family.members);
    study.family = follow_family(problem, first, path, [&](double part) {
      if (progress) progress("family", std::clamp(part, 0.0, 1.0));
    });
  }
  constexpr std::size_t most_paths = 12;
  const std::vector<FamilyMember>& members = study.family.members;
  const std::size_t count = std::min(members.size(), most_paths);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t member = count == 1 ? 0 : k * (members.size() - 1) / (count - 1);
    study.paths.push_back(path_of(scene, problem, members[member].orbit, member));
  }
  return study;
}

}  // namespace hamjet
