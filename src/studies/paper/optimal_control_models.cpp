#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../../optimal_control/double_integrator.hpp"
#include "../../optimal_control/heisenberg_problem.hpp"
#include "hamjet/error.hpp"
#include "optimal_control_study.hpp"

namespace hamjet {
namespace {

/// The components that the end conditions fix, for a model with this number of states.
template <std::size_t States>
std::array<std::optional<double>, States> end_of(const OptimalControlStudy& study) {
  std::array<std::optional<double>, States> end;
  for (std::size_t i = 0; i < States; ++i) end[i] = study.end[i];
  return end;
}

void require_size(std::string_view what, std::size_t found, std::size_t right) {
  if (found == right) return;
  throw Error(ErrorKind::usage, fmt::format("optimal control: wrong size of the {}, got {}, must "
                                            "be {}",
                                            what, found, right));
}

}  // namespace

const std::vector<std::string_view>& control_model_names() {
  static const std::vector<std::string_view> names = {"heisenberg", "double-integrator"};
  return names;
}

const std::vector<std::string_view>& state_names(ControlModel model) {
  static const std::vector<std::string_view> heisenberg = {"x", "y", "z"};
  static const std::vector<std::string_view> double_integrator = {"position", "velocity"};
  return model == ControlModel::heisenberg ? heisenberg : double_integrator;
}

std::size_t control_count(ControlModel model) {
  return model == ControlModel::heisenberg ? HeisenbergFunctions::controls
                                           : DoubleIntegratorFunctions::controls;
}

OptimalControlProblem make_problem(const OptimalControlStudy& study) {
  const std::size_t n = state_names(study.model).size();
  require_size("start", study.start.size(), n);
  require_size("end", study.end.size(), n);
  std::vector<std::size_t> fixed;
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) {
    if (!study.end[i]) continue;
    fixed.push_back(i);
    values.push_back(*study.end[i]);
  }
  const auto make = [&](const auto& functions) {
    return make_optimal_control_problem(
        std::string(control_model_names()[static_cast<std::size_t>(study.model)]), n,
        control_count(study.model), functions, fixed_state(study.start),
        fixed_components(n, fixed, values));
  };
  return study.model == ControlModel::heisenberg ? make(HeisenbergFunctions{})
                                                 : make(DoubleIntegratorFunctions{});
}

std::optional<ClosedFormCost> closed_form_cost(const OptimalControlStudy& study,
                                               std::size_t steps) {
  if (study.model == ControlModel::heisenberg) {
    return heisenberg_cost(study.start, end_of<3>(study), study.duration, steps);
  }
  return double_integrator_cost(study.discretization, study.start, end_of<2>(study), study.duration,
                                steps);
}

std::vector<double> guessed_costate(const OptimalControlStudy& study) {
  if (study.model == ControlModel::double_integrator) return {0, 0};
  constexpr double full_turn = 6;  // radians; the controls turn at the rate 2 p_z
  const HeisenbergChange change = heisenberg_change(study.start, study.end);
  const double size = std::sqrt(std::abs(change.a));
  const double chord = std::hypot(change.dx, change.dy);
  const double share = change.a == 0 ? 0 : 1 / (1 + (chord / size) * (chord / size));
  const double turn = -std::copysign(full_turn * share, change.a);
  const double direction = std::atan2(change.dy, change.dx) - turn / 2;
  const double speed = (chord + size) / study.duration;
  const double pz = turn / (2 * study.duration);
  // u_1 = -(p_x + p_z y), u_2 = -(p_y - p_z x)
  return {-speed * std::cos(direction) - pz * study.start[1],
          -speed * std::sin(direction) + pz * study.start[0], pz};
}

std::vector<double> typical_sizes(const OptimalControlStudy& study) {
  const double t = study.duration;
  const auto positive = [](double size) { return size > 0 ? size : 1; };
  if (study.model == ControlModel::heisenberg) {
    const HeisenbergChange change = heisenberg_change(study.start, study.end);
    const double length =
        positive(std::max(std::hypot(change.dx, change.dy), std::sqrt(std::abs(change.a))));
    return {length, length, length * length, length / t, length / t, 1 / t};
  }
  const auto change = [&](std::size_t i) {
    return std::max(std::abs(study.start[i]), std::abs(study.end[i].value_or(study.start[i])));
  };
  const double length = positive(std::max(change(0), t * change(1)));
  return {length, length / t, length / (t * t * t), length / (t * t)};
}

}  // namespace hamjet
