#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../text/quantity_text.hpp"
#include "../drawing/study_figure.hpp"
#include "hamjet/version.hpp"
#include "optimal_control_charts.hpp"
#include "paper_reports.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

std::string_view model_of(const OptimalControlResult& result) {
  return control_model_names()[static_cast<std::size_t>(result.study.model)];
}

std::string_view method_of(const OptimalControlResult& result) {
  return discretization_names()[static_cast<std::size_t>(result.study.discretization)];
}

/// The trajectory as CSV, one row a node; the controls of a step stand in the row of its start.
std::string trajectory_csv(const OptimalControlResult& result) {
  const OptimalControlStudy& study = result.study;
  const DiscreteTrajectory& trajectory = result.solution.trajectory;
  fmt::memory_buffer out;
  const auto write = std::back_inserter(out);
  fmt::format_to(write, "step,time");
  for (const auto name : state_names(study.model)) fmt::format_to(write, ",{}", name);
  for (const auto name : state_names(study.model)) fmt::format_to(write, ",p_{}", name);
  const std::size_t controls = control_count(study.model);
  for (std::size_t j = 1; j <= controls; ++j) fmt::format_to(write, ",u_{}", j);
  fmt::format_to(write, "\n");
  for (std::size_t k = 0; k < trajectory.states.size(); ++k) {
    const double time =
        study.duration * static_cast<double>(k) / static_cast<double>(trajectory.steps());
    fmt::format_to(write, "{},{:.17g}", k, time);
    for (const double x : trajectory.states[k]) fmt::format_to(write, ",{:.17g}", x);
    for (const double p : trajectory.costates[k]) fmt::format_to(write, ",{:.17g}", p);
    for (std::size_t j = 0; j < controls; ++j) {
      if (k == trajectory.steps()) {
        fmt::format_to(write, ",");
      } else {
        fmt::format_to(write, ",{:.17g}", trajectory.controls[k](static_cast<Eigen::Index>(j)));
      }
    }
    fmt::format_to(write, "\n");
  }
  return fmt::to_string(out);
}

std::string field(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

std::string convergence_csv(const OptimalControlResult& result) {
  std::string text = "steps,cost,continuous_error,discrete_error,reason\n";
  for (const ControlConvergencePoint& point : result.convergence) {
    const std::string cost = point.failure.empty() ? fmt::format("{:.17g}", point.cost) : "";
    std::string reason = point.failure;
    if (!reason.empty()) reason = '"' + reason + '"';
    text += fmt::format("{},{},{},{},{}\n", point.steps, cost, field(point.continuous_error),
                        field(point.discrete_error), reason);
  }
  return text;
}

Json routes_json(const OptimalControlResult& result) {
  if (!result.routes) return nullptr;
  const RouteComparison& routes = *result.routes;
  return {{"states", routes.difference.states},
          {"costates", routes.difference.costates},
          {"controls", routes.difference.controls},
          {"cost", routes.cost},
          {"karush_kuhn_tucker_iterations", routes.karush_kuhn_tucker_iterations},
          {"reduced_hamiltonian_iterations", routes.reduced_hamiltonian_iterations}};
}

Json numbers(const Eigen::VectorXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

std::vector<double> conjugate_time_bounds(const OptimalControlResult& result) {
  std::vector<double> times;
  for (const std::size_t steps : result.conjugate.passed_after) {
    times.push_back(result.study.duration * static_cast<double>(steps) /
                    static_cast<double>(result.study.steps));
  }
  return times;
}

/// What shooting finds fulfils the necessary conditions of the first order, and may be a saddle.
std::string second_order_text(const OptimalControlResult& result) {
  if (!result.conjugate.is_resolved) {
    return "not decided, for the steps are too few; only the necessary conditions of the first "
           "order hold";
  }
  const std::vector<double> times = conjugate_time_bounds(result);
  if (!times.empty()) {
    return fmt::format(
        "no local least: a conjugate time before t = {:.6g}{}; another costate_guess "
        "may lead to a lesser cost",
        times.front(), times.size() > 1 ? fmt::format(", {} in all", times.size()) : "");
  }
  if (result.is_local_least()) return "a local least: no conjugate time up to the end";
  return "no conjugate time before the end, which is itself conjugate or not fixed: a least is not "
         "excluded, and not shown";
}

std::string failure_text(const OptimalControlResult& result) {
  if (!result.routes_failure.empty()) return result.routes_failure;
  for (const ControlConvergencePoint& point : result.convergence) {
    if (!point.failure.empty()) {
      return fmt::format("convergence, {} steps: {}", point.steps, point.failure);
    }
  }
  return result.failed_checks.empty() ? "" : "a check failed: " + result.failed_checks.front();
}

std::string summary(const OptimalControlResult& result) {
  const OptimalControlStudy& study = result.study;
  const ShootingSolution& solution = result.solution;
  Json end = Json::array();
  for (const auto& value : study.end) end.push_back(or_null(value));
  Json json = {{"scene", study.name},
               {"title", study.title},
               {"version", version},
               {"study", "optimal-control"},
               {"problem", model_of(result)},
               {"method", method_of(result)},
               {"duration", study.duration},
               {"steps", study.steps},
               {"start", study.start},
               {"end", end},
               {"cost", result.cost},
               {"squared_control", result.squared_control},
               {"closed_form_continuous", nullptr},
               {"closed_form_discrete", nullptr},
               {"continuous_error", or_null(result.continuous_error)},
               {"discrete_error", or_null(result.discrete_error)}};
  if (result.closed_form) {
    json["closed_form_continuous"] = result.closed_form->continuous;
    json["closed_form_discrete"] = result.closed_form->discrete;
  }
  json["initial_costate"] = numbers(solution.trajectory.costates.front());
  json["final_costate"] = numbers(solution.trajectory.costates.back());
  json["initial_multipliers"] = numbers(solution.trajectory.initial_multipliers);
  json["final_multipliers"] = numbers(solution.trajectory.final_multipliers);
  json["shooting_intervals"] = study.shooting_intervals;
  json["shooting_unknowns"] = solution.unknowns;
  json["shooting_rank"] = solution.rank;
  json["shooting_nullity"] = solution.unknowns - solution.rank;
  json["end_point_rank"] = result.end_point_rank;
  json["newton_iterations"] = solution.iterations;
  json["residual"] = solution.residual;
  json["conjugate_times_below"] = conjugate_time_bounds(result);
  json["local_least"] = or_null(result.is_local_least());
  json["symplecticity_defect"] = result.symplecticity_defect;
  json["route_difference"] = result.routes ? Json(result.routes->largest()) : Json(nullptr);
  json["routes"] = routes_json(result);
  json["routes_error"] = text_or_null(result.routes_failure);
  json["order"] = result.fit ? Json(result.fit->order) : Json(nullptr);
  json["order_steps"] = result.fit ? Json(result.fit->steps) : Json(nullptr);
  json["convergence"] = Json::array();
  for (const ControlConvergencePoint& point : result.convergence) {
    json["convergence"].push_back(
        {{"steps", point.steps},
         {"cost", point.failure.empty() ? Json(point.cost) : Json(nullptr)},
         {"continuous_error", or_null(point.continuous_error)},
         {"discrete_error", or_null(point.discrete_error)},
         {"error", text_or_null(point.failure)}});
  }
  json["failed_checks"] = result.failed_checks;
  json["exit_code"] = result.exit_code();
  return json_text(json) + "\n";
}

std::string error_text(const std::optional<double>& error) {
  return error ? fmt::format("{:.2e}", *error) : "no closed form";
}

std::string table(const OptimalControlResult& result) {
  const OptimalControlStudy& study = result.study;
  const ShootingSolution& solution = result.solution;
  std::string text = fmt::format(
      "{}\n"
      "  problem            {}, {}, {} over {:g}\n"
      "  cost               {:.15g}   (sum of tau <u, u>: {:.15g})\n",
      study.title, model_of(result), method_of(result), counted(study.steps, "step"),
      study.duration, result.cost, result.squared_control);
  if (result.closed_form) {
    text += fmt::format(
        "  closed forms       {:.15g} continuous, {:.15g} with these steps\n"
        "  relative errors    {} from the continuous one, {} from that with these steps\n",
        result.closed_form->continuous, result.closed_form->discrete,
        error_text(result.continuous_error), error_text(result.discrete_error));
  } else {
    text += "  closed forms       none for these ends\n";
  }
  text += fmt::format(
      "  shooting           {}, residual {:.1e}; rank {} of {}, nullity {}\n"
      "  dx(T)/dp(0)        rank {} of {}\n"
      "  second order       {}\n"
      "  symplecticity      {:.1e}, the advance map's largest scaled defect\n",
      counted(solution.iterations, "iteration"), solution.residual, solution.rank,
      solution.unknowns, solution.unknowns - solution.rank, result.end_point_rank,
      study.start.size(), second_order_text(result), result.symplecticity_defect);
  if (result.routes) {
    text += fmt::format(
        "  both routes        differ by {:.1e} (states), {:.1e} (costates), {:.1e} (controls), "
        "{:.1e} (cost), relative\n",
        result.routes->difference.states, result.routes->difference.costates,
        result.routes->difference.controls, result.routes->cost);
  } else {
    text += fmt::format("  both routes        not compared: {}\n", result.routes_failure);
  }
  for (const ControlConvergencePoint& point : result.convergence) {
    text += point.failure.empty()
                ? fmt::format("  {:6} steps       cost {:.15g}, errors {} and {}\n", point.steps,
                              point.cost, error_text(point.continuous_error),
                              error_text(point.discrete_error))
                : fmt::format("  {:6} steps       {}\n", point.steps, point.failure);
  }
  if (result.fit) {
    text += fmt::format("  order              {:.3f}, fitted through the steps", result.fit->order);
    for (const std::size_t steps : result.fit->steps) text += fmt::format(" {}", steps);
    text += "\n";
  } else if (!result.convergence.empty()) {
    text +=
        "  order              none: no closed form, or fewer than three errors between the "
        "rounding floor and 1e-2\n";
  }
  for (const std::string& failed : result.failed_checks) {
    text += fmt::format("  check failed       {}\n", failed);
  }
  return text;
}

}  // namespace

template <>
StudyReport study_report(const OptimalControlResult& result, Figure figure) {
  StudyReport report;
  report.files = {{"trajectory.csv", trajectory_csv(result)},
                  {"convergence.csv", convergence_csv(result)}};
  if (figure == Figure::drawn) add_figure(report, optimal_control_charts(result));
  report.files.push_back({"summary.json", summary(result)});
  report.table = table(result);
  report.exit_code = result.exit_code();
  report.failure = failure_text(result);
  return report;
}

}  // namespace hamjet::io
