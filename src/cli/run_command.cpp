#include "run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "../formats/relative_frame_text.hpp"
#include "../report/formation/drift_view.hpp"
#include "../report/paper/paper_reports.hpp"
#include "../report/propagation/force_table.hpp"
#include "../report/propagation/orbit_summary.hpp"
#include "../report/study_description.hpp"
#include "../store/text_file.hpp"
#include "../studies/arcs.hpp"
#include "../studies/checks/force_sizes.hpp"
#include "../studies/checks/run_warnings.hpp"
#include "../studies/descriptions/method_description.hpp"
#include "../studies/flights/manoeuvred_flight.hpp"
#include "../studies/flights/relative_drift.hpp"
#include "../studies/integration.hpp"
#include "../studies/skipped_work.hpp"
#include "../studies/uncertainty/sample_memory.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "../text/terminal_text.hpp"
#include "check_json.hpp"
#include "hamjet/error.hpp"
#include "hamjet/report/results.hpp"
#include "hamjet/store/output_directory.hpp"
#include "hamjet/studies/propagation.hpp"
#include "measured_time.hpp"
#include "process/guarded_output.hpp"
#include "process/interruption.hpp"
#include "process/standard_streams.hpp"
#include "progress.hpp"
#include "study_command.hpp"

namespace hamjet::cli {
namespace {

int run_flow_jet(const RunOptions& options, const Scene& scene) {
  const std::filesystem::path directory = output_path(options, scene.name);
  GuardedOutput guarded(directory);
  io::OutputDirectory& output = guarded.directory();
  note_unused(options, unwritten_coordinates(scene));
  PropagationResult result;
  {
    Progress progress(!options.quiet);
    result = propagate(
        scene,
        [&](const std::string& task, double fraction) {
          stop_if_interrupted();
          progress.update(task, fraction);
        },
        thread_count(options));
  }
  std::optional<std::string> drawing_problem;
  const std::string figure = io::figure_svg(result, drawing_problem);
  const int code = exit_code(result);
  const bool has_results = std::any_of(result.runs.begin(), result.runs.end(),
                                       [](const RunResult& run) { return run.failure.empty(); });
  const bool is_kept = !has_results && keeps_earlier(directory, code);
  std::string summary;
  {
    const UninterruptedWriting guard;
    summary = is_kept ? io::summary_json(result) : io::write_results(result, figure, output);
  }
  if (drawing_problem) print_error(*drawing_problem);
  if (options.json || options.quiet) {
    for (const RunResult& run : result.runs) {
      for (const std::string& warning : run_warnings(scene, run)) {
        print_error(fmt::format("{}{}: {}", io::warning_head, run.settings.label, warning));
      }
    }
  }
  if (options.json) {
    print(summary);
  } else if (!options.quiet) {
    const std::string folder = io::printable_path(directory);
    const std::string drawn =
        figure.empty() ? ""
                       : fmt::format("figure: {}\n", io::printable_path(directory / "figure.svg"));
    print_table(options, io::summary_table(result), io::summary_details(result),
                is_kept ? "" : fmt::format("results: {}\n{}", folder, drawn));
  }
  if (code != 0) {
    print_error(
        fmt::format("{}{}",
                    code == static_cast<int>(ErrorKind::check_failed)
                        ? "a check failed"
                        : "a numerical failure left part of the results out",
                    is_kept ? "" : "; see " + io::printable_path(directory / "summary.json")));
  }
  if (is_kept) note_kept(directory);
  return code;
}

}  // namespace

int run(const RunOptions& options) {
  return std::visit(
      [&](const auto& study) {
        if constexpr (std::is_same_v<std::decay_t<decltype(study)>, Scene>) {
          return run_flow_jet(options, study);
        } else {
          return report_study(options, study.name, [&](const ProgressCallback& progress) {
            return io::study_report(run_study(study, progress));
          });
        }
      },
      read_study(options));
}

namespace {

/// What the check of a scene says of the symmetry that an integrator leaves out.
std::string left_out_text(FlowSymmetry symmetry, std::size_t all) {
  if (symmetry == FlowSymmetry::none) return "";
  const std::string text =
      fmt::format("; integrates {} of {} variables, ", all - variables_less(symmetry), all);
  const std::string rotation = "the rotation about the axis put back";
  if (symmetry == FlowSymmetry::rotation) return text + rotation;
  return text + (symmetry == FlowSymmetry::time ? "" : rotation + ", ") +
         "the shift in time put back to about the error of integration";
}

/// What the gravity field of a file is made of; empty for a scene without one.
std::string field_text(const SystemSettings& system) {
  if (!system.gravity_file) return "";
  const GravityFile& file = *system.gravity_file;
  std::string text =
      fmt::format("  field        {} ({}) from {}:",
                  file.model_name.empty() ? "a model without a name" : file.model_name,
                  file.tide_system, io::printable(file.file));
  for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) {
    if (system.J[n] != 0) text += fmt::format(" J{}", n);
  }
  if (!file.epoch.empty())
    text += fmt::format("; coefficients that vary with time are taken at {}", file.epoch);
  if (file.origin_offset_m.value_or(0) != 0) {
    text += fmt::format("; its C(1,0), which is left out, puts the centre of mass at z = {:.4g} m",
                        *file.origin_offset_m);
  }
  return text + "\n";
}

void check_flow_jet(const RunOptions& options, const std::string& file, const Scene& scene) {
  const std::size_t threads = thread_count(options);
  const ComputedProblem problem = make_problem(without_manoeuvres(scene), threads);
  const auto names = variable_names(scene.system);
  std::string components;
  for (const std::size_t c : problem.components) components += fmt::format(" {}", names[c]);
  std::string text = fmt::format(
      "{}: the scene is good\n"
      "  title        {}\n"
      "  units        length {:.10g} km, time {:.10g} s\n"
      "  nominal     ",
      io::printable(file, std::string::npos), scene.title, scene.units.length_km,
      scene.units.time_s);
  for (const double x : scene.nominal) text += fmt::format(" {:.17g}", x);
  text += "\n" + field_text(scene.system) + io::force_text(scene, force_sizes(scene));
  if (const auto orbit = io::orbit_summary(scene)) text += io::orbit_text(*orbit);
  text += fmt::format(
      "  duration     {:.17g} canonical = {:.10g} s\n"
      "  jet          order {} in {}: {} for each of{}\n"
      "  memory       about {:.0f} MB\n",
      scene.duration, scene.duration * scene.units.time_s, scene.order,
      counted(scene.variables.size(), "variable"), counted(problem.space->size(), "coefficient"),
      components, estimate_memory(scene, *problem.system, scene.variables.size(), threads) / 1e6);
  if (scene.coordinates != JetCoordinates::cartesian) {
    const auto unwritten = unwritten_coordinates(scene);
    text += fmt::format("  coordinates  {}; {}\n", name_of(scene.coordinates),
                        unwritten ? "hamjet run does not write them: " + unwritten->why
                                  : "hamjet run writes polynomials in them beside its jets");
  }
  if (!scene.jet_times.empty()) {
    text += fmt::format("  jets         at {} to {:.10g} s too\n",
                        counted(scene.jet_times.size(), "time"),
                        scene.jet_times.back() * scene.units.time_s);
  }
  for (const IntegratorSettings& settings : scene.integrators) {
    text += fmt::format("  integrator   {}: {}", settings.label, method_name(settings.method));
    for (const MethodSetting& setting : description_of(settings.method).settings) {
      const std::string words = setting.text(settings);
      if (!words.empty()) text += ", " + words;
    }
    if (settings.tolerance) text += fmt::format(", tolerance {:g}", *settings.tolerance);
    if (settings.step_canonical)
      text += fmt::format(", step {:g} canonical", *settings.step_canonical);
    text += left_out_text(left_out(scene, problem, settings), scene.variables.size());
    text += "\n";
    if (scene.arcs == std::optional<std::size_t>(1)) continue;
    const ArcPlan plan = plan_arcs(scene, problem, settings,
                                   [](const std::string&, double) { stop_if_interrupted(); });
    text += fmt::format("  arcs         {}: {}\n", settings.label, io::arcs_text(scene, plan));
  }
  if (scene.deputy) {
    const auto letters = io::axis_letters(scene.deputy->frame);
    const Eigen::Vector3d& place = scene.deputy->start.position_m;
    text += fmt::format("  deputy       {} away: {} {:.7g} m, {} {:.7g} m, {} {:.7g} m\n",
                        length_text(place.norm()), letters[0], place[0], letters[1], place[1],
                        letters[2], place[2]);
    const auto drift = deputy_drift(scene);
    text += fmt::format("               velocity {} m/s; {}\n",
                        io::vector_text(scene.deputy->start.velocity_m_s, 4),
                        io::drift_text(scene, drift, scene.deputy->start, scene.deputy->frame));
    if (const std::string elements = io::elements_text(drift); !elements.empty()) {
      text += fmt::format("               relative elements {}\n", elements);
    }
  }
  if (scene.transfer) {
    text += fmt::format("  transfer     {} to {:.6g} s, kind {}\n",
                        counted(scene.transfer->times.size(), "time"),
                        scene.transfer->times.back() * scene.units.time_s, scene.transfer->kind);
  }
  if (scene.validity) {
    text += fmt::format("  validity     {} to {:.6g} s, {}\n",
                        counted(scene.validity->times.size(), "time"),
                        scene.validity->times.back() * scene.units.time_s,
                        counted(scene.validity->samples, "sample"));
  }
  if (scene.uncertainty) {
    text += fmt::format("  uncertainty  {} flown, about {:.0f} MB\n",
                        counted(scene.uncertainty->samples, "sample"), sample_memory(scene) / 1e6);
  }
  if (scene.bounded) {
    text += fmt::format("  bounded      {}, {}\n", counted(scene.bounded->sizes_m.size(), "size"),
                        counted(scene.bounded->revolutions, "revolution"));
  }
  if (scene.assignment) {
    text += fmt::format("  assignment   {} to {}\n",
                        counted(scene.assignment->deputies.size(), "deputy"),
                        counted(scene.assignment->slots.size(), "slot"));
  }
  const std::vector<std::string_view> commands = io::commands_of(scene);
  text += fmt::format("  commands     {}\n",
                      commands.empty() ? "none: no table [deputy] for the manoeuvres to be flown in"
                                       : fmt::format("{}", fmt::join(commands, ", ")));
  text += fmt::format("  inversions   {}\n  reference    {}\n",
                      scene.kinds ? counted(scene.kinds->size(), "kind") : "none",
                      scene.reference ? "in extended precision" : "none");
  text += fmt::format("  time         {}\n", options.has_time
                                                 ? measured_times(scene) + "; pictures apart"
                                                 : "hamjet check --time measures it");
  print(io::fitted(text));
}

}  // namespace

int check(const RunOptions& options) {
  if (options.json) return check_as_json(options);
  std::visit(
      [&](const auto& study) {
        if constexpr (std::is_same_v<std::decay_t<decltype(study)>, Scene>) {
          check_flow_jet(options, *options.scene_file, study);
        } else {
          print(io::fitted(fmt::format("{}: the scene is good\n  title        {}\n",
                                       io::printable(*options.scene_file, std::string::npos),
                                       study.title)));
        }
      },
      read_study(options));
  return 0;
}

}  // namespace hamjet::cli
