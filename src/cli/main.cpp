#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <sstream>

#include "arithmetic.hpp"
#include "compare_command.hpp"
#include "eval_command.hpp"
#include "hamjet/error.hpp"
#include "hamjet/version.hpp"
#include "interruption.hpp"
#include "list_command.hpp"
#include "run_command.hpp"
#include "stability_command.hpp"
#include "standard_streams.hpp"
#include "transfer_command.hpp"
#include "usage.hpp"

namespace {

using hamjet::ErrorKind;

constexpr const char* examples = R"(Examples:
  hamjet demo                               the paper's Earth orbit; results in out/earth-orbit
  hamjet run scene.toml                     results in out/scene
  hamjet run scene.toml -o results --json   summary on standard output as JSON
  hamjet run scene.toml --set jet.order=6 --set integrator.gauss8.tolerance=1e-13
  hamjet compare scene.toml                 error against run time of many integrators; a report
  hamjet transfer scene.toml                velocity changes between relative positions; a report
  hamjet validity scene.toml                how far from the chief the polynomials are right
  hamjet assign scene.toml                  deputies to slots at the least total velocity change
  hamjet eval out/scene --deviation 100,0,0,0,0.1,0
                                            a relative state (RTN: m, m/s) through the stored jet
  hamjet stability                          the suite of stiff and extreme cases; a report
  hamjet check scene.toml                   what would be computed, and the memory it takes
  hamjet list integrators

Exit codes: 0 all well; 1 a check failed; 2 usage; 3 scene; 4 numerical failure; 5 input or output;
6 refused as too large; 130 or 143 interrupted.

Taylor maps and generating functions of Hamiltonian flows.
)";

void add_run_options(CLI::App& command, hamjet::cli::RunOptions& options) {
  command.add_option("-o,--output", options.output,
                     "directory for the results (default: out/<scene name>)");
  command.add_flag("--json", options.json, "print summary.json instead of the table");
  command.add_flag("-q,--quiet", options.quiet, "print nothing but errors");
}

void add_override_option(CLI::App& command, hamjet::cli::RunOptions& options) {
  command
      .add_option("--set", options.overrides,
                  "key=value: change a key of the scene, for example jet.order=3 or "
                  "integrator.gauss8.tolerance=1e-12; key=null removes it; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
}

CLI::App* add_eval_command(CLI::App& app, hamjet::cli::EvalOptions& options) {
  CLI::App* eval = app.add_subcommand(
      "eval",
      "map relative states at the start through a stored jet to the end of its duration\n"
      "Example: hamjet eval out/scene --deviations start.csv -o end.csv");
  eval->add_option("directory", options.directory, "results of hamjet run")->required();
  eval->add_option("--deviation", options.deviation,
                   "one deviation, x,y,z,vx,vy,vz along the axes of the frame in m and m/s; in the "
                   "frame canonical one number a variable of the jet")
      ->type_name("NUMBERS");
  eval->add_option("--deviations", options.deviations,
                   "CSV file of many; its first line names the columns: R_m, T_m, N_m, vR_m_s, "
                   "vT_m_s, vN_m_s (RTN), x_m, y_m, z_m, vx_m_s, vy_m_s, vz_m_s (inertial), or the "
                   "jet's variables (canonical)")
      ->type_name("FILE");
  eval->add_option("--run", options.run, "label of the run (default: the first with a result)")
      ->type_name("LABEL");
  eval->add_option("--frame", options.frame,
                   "RTN (default: radial, transverse, normal of the chief), inertial, or canonical")
      ->type_name("FRAME");
  eval->add_option("--derivatives", options.derivatives,
                   "of RTN: rotating (default: velocities as seen from the turning axes) or "
                   "inertial")
      ->type_name("KIND");
  eval->add_option("--degree", options.degree, "leave out terms above this degree")->type_name("K");
  eval->add_option("-o,--output", options.output,
                   "CSV file of the final states with estimates of the miss (default: standard "
                   "output)")
      ->type_name("FILE");
  eval->add_flag("--json", options.json,
                 "print statistics and, of up to 100 deviations, the final states as JSON");
  eval->add_flag("-q,--quiet", options.quiet, "no time and counts on standard error");
  return eval;
}

/// A word as a shell takes it literally.
std::string in_shell_quotes(const std::string& word) {
  constexpr const char* plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./=:,+@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

int dispatch(int argc, char** argv) {
  CLI::App app(examples, "hamjet");
  app.set_version_flag("--version", std::string("hamjet ") + hamjet::version);
  app.require_subcommand(1);

  hamjet::cli::RunOptions options;
  CLI::App* run = app.add_subcommand("run", "run a scene and write its results");
  run->add_option("scene", options.scene_file, "scene file (TOML)")->required();
  add_run_options(*run, options);
  add_override_option(*run, options);

  CLI::App* check = app.add_subcommand("check", "read a scene and say what would be computed");
  check->add_option("scene", options.scene_file, "scene file (TOML)")->required();
  add_override_option(*check, options);

  CLI::App* demo = app.add_subcommand("demo", "run the paper's Earth orbit, which is built in");
  add_run_options(*demo, options);
  add_override_option(*demo, options);

  hamjet::cli::CompareOptions comparison;
  CLI::App* compare =
      app.add_subcommand("compare", "measure error against run time of many integrators");
  compare->add_option("scene", comparison.scene.scene_file, "scene file (TOML)")->required();
  add_run_options(*compare, comparison.scene);
  add_override_option(*compare, comparison.scene);
  compare->add_flag("--resume", comparison.resume,
                    "take up a comparison that was interrupted, from the output directory");
  std::string plots;
  compare->add_option("--plots", plots, "the report's plots as files too: pdf or png")
      ->check(CLI::IsMember({"pdf", "png"}));

  const auto add_study = [&](const char* name, const char* description) {
    CLI::App* study = app.add_subcommand(name, description);
    study->add_option("scene", options.scene_file, "scene file (TOML)")->required();
    add_run_options(*study, options);
    add_override_option(*study, options);
    return study;
  };
  hamjet::cli::TransferOptions transfers;
  CLI::App* transfer = add_study(
      "transfer", "velocity changes from one relative position to another, for every time");
  CLI::Option* jet =
      transfer->add_option("--jet", transfers.directory,
                           "directory with the results of `hamjet run`: take the jet stored there "
                           "instead of computing; its duration is the transfer time");
  transfer->add_option("--run", transfers.run, "whose jet: the label of the integrator")
      ->needs(jet);
  const CLI::App* validity =
      add_study("validity", "how far from the chief the polynomials are right, along time");
  const CLI::App* assign =
      add_study("assign", "send deputies to slots at the least total velocity change");

  std::optional<std::string> suite;
  CLI::App* stability = app.add_subcommand(
      "stability", "run the stiff and extreme cases: right, refused, marked, or wrong");
  stability
      ->add_option("--suite", suite, "folder of cases, or one case (default: data/scenes/extreme)")
      ->type_name("SCENES");
  stability->add_option("-o,--output", options.output,
                        "directory for the report (default: out/stability)");
  stability->add_flag("--json", options.json, "print a list of one object a case");
  stability->add_flag("-q,--quiet", options.quiet, "print nothing but errors");

  hamjet::cli::EvalOptions evaluation;
  const CLI::App* eval = add_eval_command(app, evaluation);

  std::string what;
  CLI::App* list = app.add_subcommand("list", "list systems, integrators or kinds");
  list->add_option("what", what, "systems, integrators or kinds")
      ->required()
      ->check(CLI::IsMember({"systems", "integrators", "kinds"}));

  if (argc <= 1) {
    std::fputs(app.help().c_str(), stderr);
    return static_cast<int>(ErrorKind::usage);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_request = error.get_exit_code() == 0;  // --help, --version
    if (!is_request) throw hamjet::Error(ErrorKind::usage, hamjet::cli::usage_message(app, error));
    std::ostringstream text;
    app.exit(error, text, text);
    hamjet::cli::print(text.str());
    return 0;
  }
  for (int i = 0; i < argc; ++i) options.command += (i == 0 ? "" : " ") + in_shell_quotes(argv[i]);
  if (*list) return hamjet::cli::list(what);
  if (*eval) return hamjet::cli::eval(evaluation);
  if (*check) return hamjet::cli::check(options);
  if (*compare) {
    comparison.scene.command = options.command;
    if (plots == "pdf") comparison.plots = hamjet::io::PlotFormat::pdf;
    if (plots == "png") comparison.plots = hamjet::io::PlotFormat::png;
    return hamjet::cli::compare(comparison);
  }
  if (*transfer) return hamjet::cli::transfer(options, transfers);
  if (*stability) return hamjet::cli::stability(options, suite);
  if (*validity) return hamjet::cli::validity(options);
  if (*assign) return hamjet::cli::assign(options);
  return hamjet::cli::run(options);
}

}  // namespace

int main(int argc, char** argv) {
  hamjet::cli::catch_signals();
  std::set_terminate(hamjet::cli::end_after_unhandled_exception);
  try {
    hamjet::cli::reset_arithmetic();
    return dispatch(argc, argv);
  } catch (const hamjet::cli::Interrupted& interrupted) {
    hamjet::cli::print_error("interrupted; nothing was written");
    return interrupted.exit_code();
  } catch (const hamjet::Error& error) {
    hamjet::cli::print_error(error.what());
    return error.exit_code();
  } catch (const std::bad_alloc&) {
    hamjet::cli::print_error(hamjet::cli::out_of_memory);
    return static_cast<int>(ErrorKind::too_large);
  } catch (const std::exception& error) {
    hamjet::cli::print_error(error.what());
    return static_cast<int>(ErrorKind::numerical);
  }
}
