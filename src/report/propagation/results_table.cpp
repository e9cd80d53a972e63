#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "../../formats/results_names.hpp"
#include "../../studies/checks/kept_tolerance.hpp"
#include "../../studies/checks/run_warnings.hpp"
#include "../../studies/formation/charts/charted_jet.hpp"
#include "../../studies/reference.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../own_units_text.hpp"
#include "forces_text.hpp"
#include "hamjet/report/results.hpp"

namespace hamjet::io {
namespace {

/// A column of the table of runs. An empty cell was not computed.
struct Column {
  std::string heading;
  std::string explanation;  ///< empty: said with another column
  std::function<std::string(const RunResult&)> cell;
  bool is_of_failed_runs = false;  ///< whether the column also says something of failed runs
};

std::string size_text(double value) { return fmt::format("{:.1e}", value); }

/// A run's largest relative error over all degrees; what the reference cannot vouch for is not
/// stated.
std::string relative_error(const PropagationResult& result, const RunResult& run) {
  if (!run.error_by_degree) return "";
  const double error = *std::max_element(run.error_by_degree->begin(), run.error_by_degree->end());
  const double claimed = result.reference->smallest_claimed_error();
  return error < claimed ? fmt::format("< {:.0e}", claimed) : size_text(error);
}

std::string largest_of(const std::vector<SymplecticityDefect>& defects) {
  double worst = 0;
  for (const SymplecticityDefect& entry : defects) worst = std::max(worst, entry.scaled);
  return defects.empty() ? "" : size_text(worst);
}

/// The largest defect; where its check has passed though one is beyond every limit, as those of
/// degrees that are rounding alone are, the largest that it judged.
std::string largest_defect(const RunResult& run) {
  constexpr double beyond_every_limit = 1e-6;
  const auto check = std::find_if(run.checks.begin(), run.checks.end(), [](const SelfCheck& one) {
    return one.name == SelfCheckName::symplecticity && one.state == SelfCheckState::passed;
  });
  if (check == run.checks.end() || !check->value) return largest_of(run.symplecticity);
  const double most = std::max(beyond_every_limit, check->limit.value_or(0));
  const bool has_unjudged =
      std::any_of(run.symplecticity.begin(), run.symplecticity.end(),
                  [&](const SymplecticityDefect& defect) { return defect.scaled > most; });
  return has_unjudged ? size_text(*check->value) : largest_of(run.symplecticity);
}

/// What came of the polynomials in the scene's coordinates, if it has others than Cartesian.
std::string charted_line(const Scene& scene, const RunResult& run) {
  if (!run.charted) return "";
  const ChartedJet& charted = *run.charted;
  const std::string coordinates = name_of(charted.coordinates);
  if (!charted.failure.empty()) {
    return fmt::format("NOT COMPUTED: {}: {} coordinates: {}\n", run.settings.label, coordinates,
                       charted.failure);
  }
  const DegreesWithoutDigits without = degrees_without_digits(scene, charted);
  std::vector<SymplecticityDefect> defects = charted.symplecticity;
  std::erase_if(defects, [&](const auto& defect) { return without.are_behind(defect); });
  const JetErrorEstimate& estimate = charted.error_estimate;
  std::string error = "not estimated: " + estimate.failure;
  if (estimate.by_degree) {
    std::vector<double> errors = *estimate.by_degree;
    for (const int degree : without.negligible) errors[static_cast<std::size_t>(degree)] = 0;
    error = "estimate " + size_text(*std::max_element(errors.begin(), errors.end()));
  }
  std::string text = fmt::format(
      "{}: polynomials in {} coordinates too, in {}, time {}; symplecticity in them {}, error {}",
      run.settings.label, coordinates, counted(charted.jet.front().space().variables(), "variable"),
      duration_text(charted.seconds), largest_of(defects), error);
  if (!without.negligible.empty()) {
    text += fmt::format("; without degree {}, errors alone, of at most {:.1e} of degree 1",
                        fmt::join(without.negligible, ", "), without.largest_share);
  }
  return text + "\n";
}

/// A word that says what came of a run; the lines below the table say more.
std::string verdict(const Scene& scene, const RunResult& run, bool shows_forces) {
  if (!run.failure.empty()) return "failed";
  if (!run.failed_checks.empty()) return "check failed";
  if (!no_digits_warning(run).empty()) return "no digit";
  if (!charted_digits_warning(scene, run).empty()) return "no digit";
  if (!near_singular_warning(scene, run).empty()) return "near singular";
  const bool is_incomplete = std::any_of(run.kinds.begin(), run.kinds.end(),
                                         [](const auto& kind) { return !kind.failure.empty(); });
  if (is_incomplete) return "incomplete";
  const std::vector<KeptTolerance> tolerance = kept_tolerance(scene, run);
  const std::size_t kept = degrees_kept(tolerance);
  if (kept == tolerance.size()) return shows_forces ? "not symplectic" : "ok";
  return kept == 0 ? "tolerance not kept" : fmt::format("ok to degree {}", kept - 1);
}

/// The degrees whose exactness the table shows: the first and the last.
std::vector<std::size_t> shown_degrees(const Scene& scene) {
  if (scene.order == 1) return {0};
  return {0, static_cast<std::size_t>(scene.order) - 1};
}

std::string residual_text(const KindResult& kind, std::size_t degree) {
  if (!kind.failure.empty()) return "none";
  if (degree >= kind.by_degree.size()) return "";
  const ExactnessEntry& entry = kind.by_degree[degree];
  return size_text(entry.residual.absolute) + (is_at_floor(entry) ? "*" : "");
}

bool has_kinds(const PropagationResult& result) {
  return result.scene.kinds && !result.scene.kinds->empty() && result.problem.is_full_jet;
}

/// Whether exactness is that of forces which are none of a Hamiltonian.
bool shows_forces(const PropagationResult& result) {
  return has_kinds(result) && !result.problem.system->is_hamiltonian;
}

Column error_column(const PropagationResult& result) {
  return {"relative error",
          "relative error: of the jet, the largest over all degrees, relative to the largest "
          "coefficient of the degree.",
          [&result](const RunResult& run) { return relative_error(result, run); }};
}

Column estimate_column(const PropagationResult& result) {
  return {"error estimate",
          result.reference
              ? "error estimate: the relative error from independent runs along a few directions, "
                "without the reference."
              : "error estimate: of the jet, the largest over all degrees, relative to the largest "
                "coefficient of the degree, from independent runs along a few directions.",
          [](const RunResult& run) {
            return run.error_estimate.by_degree ? size_text(run.error_estimate.largest()) : "";
          }};
}

Column symplecticity_column(const PropagationResult& result) {
  const bool has_drag = !result.problem.system->is_hamiltonian;
  return {"symplecticity",
          has_drag
              ? "symplecticity: the largest scaled defect of the Poisson brackets over all "
                "degrees. It is not judged: the system, in which a force such as drag acts, is "
                "not Hamiltonian, and its true map has such a defect too."
              : "symplecticity: the largest scaled defect of the Poisson brackets over all "
                "degrees.",
          largest_defect};
}

/// The exactness of the first kind at the highest degree; the other kinds and degrees stand among
/// the further columns.
Column exactness_column(const PropagationResult& result) {
  const std::string& kind = result.scene.kinds->front();
  const std::size_t degree = shown_degrees(result.scene).back();
  return {fmt::format("{} exactness", kind),
          fmt::format("{} exactness: the absolute exactness residual of degree {}{}", kind, degree,
                      shows_forces(result) ? ", which the forces make."
                      : result.reference ? "; * at its floor, where round-off hides the integrator."
                                         : "."),
          [degree](const RunResult& run) { return residual_text(run.kinds.front(), degree); }};
}

std::vector<Column> main_columns(const PropagationResult& result) {
  std::vector<Column> columns = {
      {"time", "", [](const RunResult& run) { return duration_text(run.statistics.wall_seconds); }},
      result.reference ? error_column(result) : estimate_column(result),
      symplecticity_column(result)};
  if (has_kinds(result)) columns.push_back(exactness_column(result));
  columns.push_back(
      {"verdict",
       shows_forces(result)
           ? "verdict: what the checks came to; not symplectic says that they passed, "
             "and that exactness is the residual of the forces."
           : "verdict: what the checks came to; ok says nothing of the size of the "
             "error.",
       [&result](const RunResult& run) { return verdict(result.scene, run, shows_forces(result)); },
       true});
  return columns;
}

/// What the main table leaves out.
std::vector<Column> further_columns(const PropagationResult& result) {
  std::vector<Column> columns = {
      {"steps", "", [](const RunResult& run) { return std::to_string(run.statistics.steps); }},
      {"rejected", "",
       [](const RunResult& run) { return std::to_string(run.statistics.rejected_steps); }},
      {"position error", "position error: of the nominal at the end, against the reference.",
       [](const RunResult& run) {
         return run.position_error_m ? length_text(*run.position_error_m) : "";
       }},
      {"energy error", "energy error: the largest along the nominal, relative.",
       [](const RunResult& run) { return size_text(run.energy_error); }}};
  if (result.reference) columns.push_back(estimate_column(result));
  if (!has_kinds(result)) return columns;
  for (std::size_t k = 0; k < result.scene.kinds->size(); ++k) {
    for (const std::size_t d : shown_degrees(result.scene)) {
      const std::string& kind = (*result.scene.kinds)[k];
      std::string explanation;
      if (k == 0 && d == 0) {
        explanation = fmt::format(
            "{} degree 0, ...: the absolute exactness residual of that degree{}", kind,
            shows_forces(result) ? ", which the forces make."
            : result.reference   ? "; * at its floor, where round-off hides the integrator."
                                 : ".");
      }
      columns.push_back({fmt::format("{} degree {}", kind, d), explanation,
                         [k, d](const RunResult& run) { return residual_text(run.kinds[k], d); }});
    }
  }
  return columns;
}

/// The table of all runs, and below it what its columns are.
std::string table_of(const PropagationResult& result, const std::vector<Column>& columns) {
  std::vector<std::vector<std::string>> rows = {{"integrator"}};
  for (const Column& column : columns) rows[0].push_back(column.heading);
  for (const RunResult& run : result.runs) {
    rows.push_back({run.settings.label});
    for (const Column& column : columns) {
      const bool is_known = run.failure.empty() || column.is_of_failed_runs;
      rows.back().push_back(is_known ? column.cell(run) : "");
    }
  }
  std::string explanation;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const bool is_shown = std::any_of(rows.begin() + 1, rows.end(),
                                      [&](const auto& row) { return !row[c + 1].empty(); });
    if (is_shown && !columns[c].explanation.empty()) {
      explanation += (explanation.empty() ? "" : " ") + columns[c].explanation;
    }
  }
  return aligned_table(rows) + "\n" + explanation + (explanation.empty() ? "" : "\n");
}

std::string reference_line(const PropagationResult& result) {
  if (!result.reference_failure.empty()) {
    return fmt::format("FAILED: {}; errors and floors are not computed\n",
                       result.reference_failure);
  }
  if (!result.reference) {
    return "no reference: the scene has no [reference] table, so errors are estimated\n";
  }
  return fmt::format(
      "reference: Gauss, {} stages, {} bits, steps: {}, time: {}; its own uncertainty is {:.0e} "
      "at worst\n",
      result.reference->stages,
      reference_arithmetic(result.scene.precision, result.reference->tolerance).bits,
      result.reference->statistics.steps, duration_text(result.reference->statistics.wall_seconds),
      result.reference->largest_uncertainty());
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
  const double duration_s = scene.duration * scene.units.time_s;
  std::string text = fmt::format(
      "{}\norder {} in {} of {}, {} a component\n"
      "duration {:.10g} s{}, which is {:.10g} canonical\n",
      scene.title, scene.order, scene.variables.size(), counted(scene.nominal.size(), "variable"),
      counted(result.problem.space->size(), "coefficient"), duration_s, days_behind(duration_s),
      scene.duration);
  if (const std::string units = own_units_text(scene); !units.empty()) text += units + "\n";
  text += own_mass_line(scene);
  if (result.problem.components.size() < scene.nominal.size()) {
    text +=
        "the nominal stays in an invariant subspace: the components outside it are not computed\n";
  }
  if (!scene.jet_times.empty()) {
    text += fmt::format("jets at {} before the duration too, from {:.10g} s to {:.10g} s\n",
                        counted(scene.jet_times.size(), "time"),
                        scene.jet_times.front() * scene.units.time_s,
                        scene.jet_times.back() * scene.units.time_s);
  }
  text += reference_line(result) + "\n";
  text += table_of(result, main_columns(result));
  text += checks_line(scene);
  text += arcs_lines(result);
  if (!result.relative_hamiltonian_failure.empty()) {
    text += fmt::format("FAILED: {}\n", result.relative_hamiltonian_failure);
  }
  for (const RunResult& run : result.runs) {
    if (!run.failure.empty()) {
      text += fmt::format("FAILED: {}: {}\n", run.settings.label, run.failure);
    }
    for (const std::string& warning : run_warnings(scene, run)) {
      text += fmt::format("WARNING: {}: {}\n", run.settings.label, warning);
    }
    for (const std::string& check : run.failed_checks) {
      text += fmt::format("CHECK FAILED: {}: {}\n", run.settings.label, check);
    }
    if (run.failure.empty()) text += forces_lines(result, run);
    text += charted_line(scene, run);
    for (const KindResult& kind : run.kinds) {
      if (!kind.failure.empty()) {
        text += fmt::format("NOT COMPUTED: {}: {}\n", run.settings.label, kind.failure);
      }
    }
  }
  return fitted(text);
}

std::string summary_details(const PropagationResult& result) {
  std::string text = "\n" + table_of(result, further_columns(result));
  for (const RunResult& run : result.runs) {
    for (const KindResult& kind : run.kinds) {
      if (kind.failure.empty() && kind.requested == "auto") {
        text += fmt::format("{}: auto took {} (condition {:.3g})\n", run.settings.label,
                            kind.kind.name(), kind.condition);
      }
    }
  }
  return fitted(text);
}

}  // namespace hamjet::io
