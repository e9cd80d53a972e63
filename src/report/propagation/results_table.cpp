#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "../../formats/results_names.hpp"
#include "../../studies/checks/run_warnings.hpp"
#include "../../text/html_text.hpp"
#include "hamjet/report/results.hpp"

namespace hamjet::io {
namespace {

using Row = std::vector<std::string>;

constexpr const char* not_computed = "-";

template <class Values, class Get>
std::string largest(const Values& values, Get get) {
  if (values.empty()) return not_computed;
  double worst = 0;
  for (const auto& value : values) worst = std::max(worst, get(value));
  return fmt::format("{:.1e}", worst);
}

/// A run's largest relative error over all degrees; what the reference cannot vouch for is not
/// stated.
std::string relative_error(const PropagationResult& result, const RunResult& run) {
  if (!run.error_by_degree) return not_computed;
  const double error = *std::max_element(run.error_by_degree->begin(), run.error_by_degree->end());
  const double claimed = result.reference->smallest_claimed_error();
  return error < claimed ? fmt::format("< {:.0e}", claimed) : fmt::format("{:.1e}", error);
}

std::string residual_text(const KindResult& kind, std::size_t degree) {
  if (!kind.failure.empty()) return "none";
  if (degree >= kind.by_degree.size()) return not_computed;
  const ExactnessEntry& entry = kind.by_degree[degree];
  return fmt::format("{:.1e}{}", entry.residual.absolute, is_at_floor(entry) ? "*" : "");
}

/// The degrees whose exactness the table shows: the first and the last.
std::vector<std::size_t> shown_degrees(const Scene& scene) {
  if (scene.order == 1) return {0};
  return {0, static_cast<std::size_t>(scene.order) - 1};
}

Row header(const PropagationResult& result) {
  Row row = {"integrator",     "steps",          "rejected",      "time",        "position error",
             "relative error", "error estimate", "symplecticity", "energy error"};
  if (!result.scene.kinds || !result.problem.is_full_jet) return row;
  for (const std::string& kind : *result.scene.kinds) {
    for (const std::size_t d : shown_degrees(result.scene)) {
      row.push_back(fmt::format("{} degree {}", kind, d));
    }
  }
  return row;
}

Row run_row(const PropagationResult& result, const RunResult& run) {
  if (!run.failure.empty()) return {run.settings.label, "FAILED: " + run.failure};
  Row row = {run.settings.label, std::to_string(run.statistics.steps),
             std::to_string(run.statistics.rejected_steps),
             duration_text(run.statistics.wall_seconds),
             run.position_error_m ? length_text(*run.position_error_m) : not_computed};
  row.push_back(relative_error(result, run));
  row.push_back(run.error_estimate.by_degree ? fmt::format("{:.1e}", run.error_estimate.largest())
                                             : not_computed);
  row.push_back(largest(run.symplecticity, [](const auto& entry) { return entry.scaled; }));
  row.push_back(fmt::format("{:.1e}", run.energy_error));
  for (const KindResult& kind : run.kinds) {
    for (const std::size_t d : shown_degrees(result.scene)) row.push_back(residual_text(kind, d));
  }
  return row;
}

/// The width in characters, not bytes: times and lengths may have a micro sign.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    if (row.size() < rows[0].size()) continue;  // a failure's text does not widen the column
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  for (const Row& row : rows) widths[0] = std::max(widths[0], width(row[0]));
  std::string text;
  for (const Row& row : rows) {
    std::string line = fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t i = 1; i < row.size(); ++i) line += fmt::format("  {:>{}}", row[i], widths[i]);
    text += line + "\n";
  }
  return text;
}

std::string reference_line(const PropagationResult& result) {
  if (!result.reference_failure.empty()) {
    return fmt::format("FAILED: {}; errors and floors are not computed\n",
                       result.reference_failure);
  }
  if (!result.reference) {
    return "no reference: the scene has no [reference] table, so errors and floors are not "
           "computed\n";
  }
  return fmt::format(
      "reference: Gauss, {} stages, 113 bits, steps: {}, time: {}; its own uncertainty is {:.0e} "
      "at worst\n",
      result.reference->stages, result.reference->statistics.steps,
      duration_text(result.reference->statistics.wall_seconds),
      result.reference->largest_uncertainty());
}

std::string explanation(const PropagationResult& result) {
  std::string text =
      "position error: of the nominal at the end. relative error: largest over all degrees, "
      "relative "
      "to the\nlargest coefficient of the degree. error estimate: the same, from independent runs "
      "along a few directions,\nwithout a reference. symplecticity: largest scaled Poisson-bracket "
      "defect over all degrees.\n";
  if (result.scene.kinds && result.problem.is_full_jet) {
    text += "F1, auto, ... degree d: absolute exactness residual";
    text += result.reference ? "; * at its floor, where round-off hides the integrator.\n" : ".\n";
  }
  return text;
}

/// Which self-checks the scene turned off.
std::string checks_line(const Scene& scene) {
  std::vector<std::string_view> off;
  for (std::size_t i = 0; i < self_check_names().size(); ++i) {
    const auto name = static_cast<SelfCheckName>(i);
    if (!scene.checks[name].is_on) off.push_back(name_of(name));
  }
  if (off.empty()) return "";
  return fmt::format("checks that the scene turned off: {}\n", fmt::join(off, ", "));
}

/// How the runs were split.
std::string arcs_lines(const PropagationResult& result) {
  std::string text;
  for (const RunResult& run : result.runs) {
    if (!run.arcs || !run.failure.empty()) continue;
    text += fmt::format("{}: {}", run.settings.label, arcs_text(result.scene, run.arcs->plan));
    if (run.arcs->plan.arcs > 1) {
      text += fmt::format("; ran on {} {}", run.arcs->threads,
                          run.arcs->threads == 1 ? "thread" : "threads");
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string arcs_text(const Scene& scene, const ArcPlan& plan) {
  std::string text = fmt::format("{} {} ({}{})", plan.arcs, plan.arcs == 1 ? "arc" : "arcs",
                                 scene.arcs ? "" : "auto: ", plan.reason);
  if (plan.arcs == 1) return text;
  text += ", estimated speed-up";
  for (std::size_t i = 0; i < plan.speed_ups.size(); ++i) {
    text += fmt::format("{} {:.2f} on {}", i == 0 ? "" : ",", plan.speed_ups[i],
                        ArcPlan::thread_counts[i]);
  }
  return text + " threads";
}

std::string summary_table(const PropagationResult& result) {
  const Scene& scene = result.scene;
  std::string text = fmt::format(
      "{}\norder {} in {} of {} variables, {} coefficients a component; duration {:.10g} canonical "
      "= "
      "{:.10g} s\n",
      scene.title, scene.order, scene.variables.size(), scene.nominal.size(),
      result.problem.space->size(), scene.duration, scene.duration * scene.units.time_s);
  if (result.problem.components.size() < scene.nominal.size()) {
    text +=
        "the nominal stays in an invariant subspace: the components outside it are not computed\n";
  }
  text += reference_line(result) + "\n";
  std::vector<Row> rows = {header(result)};
  for (const RunResult& run : result.runs) rows.push_back(run_row(result, run));
  text += aligned(rows) + "\n" + explanation(result);
  text += checks_line(scene);
  text += arcs_lines(result);
  if (!result.relative_hamiltonian_failure.empty()) {
    text += fmt::format("FAILED: {}\n", result.relative_hamiltonian_failure);
  }
  for (const RunResult& run : result.runs) {
    for (const std::string& warning : run_warnings(scene, run)) {
      text += fmt::format("WARNING: {}: {}\n", run.settings.label, warning);
    }
    for (const std::string& check : run.failed_checks) {
      text += fmt::format("CHECK FAILED: {}: {}\n", run.settings.label, check);
    }
    for (const KindResult& kind : run.kinds) {
      if (!kind.failure.empty()) {
        text += fmt::format("NOT COMPUTED: {}: {}\n", run.settings.label, kind.failure);
      } else if (kind.requested == "auto") {
        text += fmt::format("{}: auto took {} (condition {:.3g})\n", run.settings.label,
                            kind.kind.name(), kind.condition);
      }
    }
  }
  return text;
}

}  // namespace hamjet::io
