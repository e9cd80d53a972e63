#include "skipped_work.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formation/charts/charted_jet.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {
namespace {

/// The names of the model's variables for which `is_left_out(index)` holds.
template <class IsLeftOut>
std::vector<std::string_view> names_of(const Scene& scene, const IsLeftOut& is_left_out) {
  std::vector<std::string_view> result;
  const auto names = variable_names(scene.system);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (is_left_out(i)) result.push_back(names[i]);
  }
  return result;
}

bool contains(const std::vector<std::size_t>& list, std::size_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// Adds zonal coefficients that are absent; those above all others form one entry.
void add_zonals(const ZonalCoefficients& J, std::vector<SkippedWork>& skipped) {
  constexpr int last = ZonalCoefficients::highest;
  const std::string why = "the scene has none: no term of the force";
  const int highest = J.highest_present();
  const int alone = std::max(highest, 3);
  for (int n = ZonalCoefficients::lowest; n <= alone; ++n) {
    if (J[n] != 0) continue;
    // The recursion cannot skip a degree.
    const std::string passed =
        n < highest ? fmt::format(", but J{} needs the steps through its degree", highest) : "";
    skipped.push_back({fmt::format("J{}", n), why + passed});
  }
  if (alone == last) return;
  skipped.push_back(
      {alone + 1 == last ? fmt::format("J{}", last) : fmt::format("J{} to J{}", alone + 1, last),
       why});
}

void add_dynamics(const PropagationResult& result, std::vector<SkippedWork>& skipped) {
  const Scene& scene = result.scene;
  const ComputedProblem& problem = result.problem;
  if (scene.system.model == SystemModel::zonal_gravity) add_zonals(scene.system.J, skipped);
  const auto still =
      names_of(scene, [&](std::size_t i) { return !contains(problem.components, i); });
  if (!still.empty()) {
    skipped.push_back({fmt::format("components {}", fmt::join(still, ", ")),
                       "they stay zero, and the jet is not expanded in them"});
  }
  const auto fixed = names_of(scene, [&](std::size_t i) {
    return contains(problem.components, i) && !contains(scene.variables, i);
  });
  if (!fixed.empty()) {
    skipped.push_back(
        {fmt::format("variables {}", fmt::join(fixed, ", ")), "the scene does not expand in them"});
  }
  const int degrees = working_order(*problem.system, scene.order);
  if (degrees < scene.order) {
    skipped.push_back({fmt::format("degrees {} to {}", degrees + 1, scene.order),
                       "the system is linear: its flow has none"});
  }
}

/// The labels of the runs that left out a symmetry that satisfies `is_meant`.
template <class IsMeant>
std::vector<std::string> labels_of(const PropagationResult& result, const IsMeant& is_meant) {
  std::vector<std::string> labels;
  for (const RunResult& run : result.runs) {
    if (is_meant(run.statistics.left_out)) labels.push_back(run.settings.label);
  }
  return labels;
}

/// The loss of exactness of a run through a shift in time that was left out and put back.
std::string cost_of_time_shift(const RunResult& run) {
  if (run.time_shift_difference.empty()) return "what that costs was not measured";
  std::vector<std::string> numbers;
  for (const double x : run.time_shift_difference) numbers.push_back(fmt::format("{:.2g}", x));
  return fmt::format(
      "which its numerical map does not commute with: the coefficients differ from those of the "
      "same steps in all variables by {} of the largest at degrees 0 to {}",
      fmt::join(numbers, ", "), numbers.size() - 1);
}

void add_symmetry(const PropagationResult& result, std::vector<SkippedWork>& skipped) {
  const std::size_t all = result.scene.variables.size();
  const auto turned = labels_of(result, [](FlowSymmetry symmetry) {
    return symmetry == FlowSymmetry::rotation || symmetry == FlowSymmetry::rotation_and_time;
  });
  if (!turned.empty()) {
    skipped.push_back({"the variable of the rotation about the axis",
                       fmt::format("the field is symmetric: {} of {} variables were integrated and "
                                   "the rotation put back, by {}",
                                   all - 1, all, fmt::join(turned, ", "))});
  }
  for (const RunResult& run : result.runs) {
    if (!has_time_shift(run.statistics.left_out)) continue;
    skipped.push_back({"the variable of the shift in time",
                       fmt::format("the flow commutes with it: {} of {} variables were integrated "
                                   "by {} and the shift put back, {}",
                                   all - variables_less(run.statistics.left_out), all,
                                   run.settings.label, cost_of_time_shift(run))});
  }
}

void add_parts(const PropagationResult& result, std::vector<SkippedWork>& skipped) {
  const Scene& scene = result.scene;
  if (!scene.reference) {
    skipped.push_back({"reference", "the scene has no table [reference]: no errors, no floors"});
  }
  if (!result.problem.is_full_jet) {
    const bool has_parameters = !state_parameters(scene.system).empty();
    skipped.push_back({"Poisson brackets", has_parameters
                                               ? "the jet is expanded in parameters beside (q, p)"
                                               : "the jet is not expanded in all variables"});
  }
  if (!scene.kinds) {
    skipped.push_back({"generating functions", "the scene has no table [generating_function]"});
  }
  if (scene.relative_hamiltonian_times.empty()) {
    skipped.push_back({"relative Hamiltonian", "the scene has no table [relative_hamiltonian]"});
  }
  if (!scene.figure) skipped.push_back({"figure", "the scene has no table [figure]"});
  for (std::size_t i = 0; i < self_check_names().size(); ++i) {
    const auto name = static_cast<SelfCheckName>(i);
    if (scene.checks[name].is_on) continue;
    skipped.push_back({fmt::format("check {}", name_of(name)), "turned off in the scene"});
  }
}

}  // namespace

std::optional<SkippedWork> unwritten_coordinates(const Scene& scene) {
  const auto reason = reason_without_charted_jet(scene);
  if (!reason) return std::nullopt;
  return SkippedWork{fmt::format("{} coordinates", name_of(scene.coordinates)), *reason};
}

std::optional<SkippedWork> uncompared_coordinates(const Scene& scene) {
  if (scene.coordinates == JetCoordinates::cartesian) return std::nullopt;
  return SkippedWork{fmt::format("{} coordinates", name_of(scene.coordinates)),
                     "what is compared are jets in positions and momenta, which every method "
                     "integrates and which have a reference; `hamjet validity --coordinates all` "
                     "compares coordinates by flown deputies"};
}

std::vector<SkippedWork> skipped_work(const PropagationResult& result) {
  std::vector<SkippedWork> skipped;
  if (const auto coordinates = unwritten_coordinates(result.scene)) skipped.push_back(*coordinates);
  add_dynamics(result, skipped);
  add_symmetry(result, skipped);
  add_parts(result, skipped);
  return skipped;
}

}  // namespace hamjet
