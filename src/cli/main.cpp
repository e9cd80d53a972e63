#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iterator>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "../app/arithmetic.hpp"
#include "../formats/output_formats.hpp"
#include "../report/study_description.hpp"
#include "../text/shell_text.hpp"
#include "compare_command.hpp"
#include "completion/completion.hpp"
#include "convert_command.hpp"
#include "evaluation/eval_command.hpp"
#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/error.hpp"
#include "hamjet/version.hpp"
#include "help_formatter.hpp"
#include "init_command.hpp"
#include "list_command.hpp"
#include "output_option.hpp"
#include "override_option.hpp"
#include "process/interruption.hpp"
#include "process/stack_limit.hpp"
#include "process/standard_streams.hpp"
#include "run_command.hpp"
#include "stability_command.hpp"
#include "study_command.hpp"
#include "sweep_command.hpp"
#include "transfer_command.hpp"
#include "usage.hpp"
#include "validity_command.hpp"

namespace {

using hamjet::ErrorKind;

constexpr const char* examples = R"(Examples:
  hamjet init leo                           a commented scene to start from; writes leo.toml
  hamjet demo                               the paper's Earth orbit; results in out/earth-orbit
  hamjet run scene.toml                     results in out/scene
  hamjet run - < scene.toml                 the same from standard input; results in
                                            out/standard-input
  hamjet run scene.toml -o results --json   summary on standard output as JSON
  hamjet run scene.toml --set jet.order=6 --set integrator.gauss8.tolerance=1e-13
                                            the same with two keys changed
  hamjet compare scene.toml                 error against run time of many integrators; a report
{}  hamjet eval out/scene --deviation 100,0,0,0,0.1,0
                                            a relative state (RTN: m, m/s) through the stored jet
  hamjet convert out/scene scene.h5         a stored jet as HDF5, DACE text or CSV
  hamjet stability                          the suite of stiff and extreme cases; a report
  hamjet sweep study.toml                   a scene over a grid of values; a table and a map
  hamjet check scene.toml                   what would be computed, and the memory it takes
  hamjet list integrators                   the methods of this build
  hamjet help transfer                      what hamjet transfer --help prints
  hamjet help deputy                        the keys of a scene's table [deputy]

Exit codes:
  0 all well; 1 a check failed; 2 usage; 3 scene; 4 numerical failure; 5 input or output;
  6 refused as too large; 129, 130, 131 or 143 interrupted.

Taylor maps and generating functions of Hamiltonian flows.
)";

void add_scene_argument(CLI::App& command, hamjet::cli::RunOptions& options) {
  command
      .add_option("scene", options.scene_file,
                  "scene file (TOML); - reads standard input, whose scene is named "
                  "standard-input and names files as seen from the current folder")
      ->required()
      ->type_name("SCENE");
}

/// `results` names what the command writes, and `directory` where it does unless it is told.
void add_run_options(CLI::App& command, hamjet::cli::RunOptions& options,
                     const std::string& results, const std::string& directory,
                     const char* json = "print summary.json instead of the table") {
  hamjet::cli::add_output_option(
      command, options.output, fmt::format("directory for {} (default: {})", results, directory),
      "DIRECTORY", "but results are a folder; --json prints their summary on standard output");
  command.add_flag("--json", options.json, json);
  command.add_flag("-q,--quiet", options.quiet, "print nothing but errors");
  command.add_flag("--verbose", options.verbose, "print more columns and lines of the results");
}

void add_threads_option(CLI::App& command, hamjet::cli::RunOptions& options) {
  command
      .add_option("--threads", options.threads,
                  "threads for the arcs of a scene with jet.arcs; the results do not depend on it "
                  "(default: as many as the machine runs at once)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

CLI::App* add_sweep_command(CLI::App& app, hamjet::cli::RunOptions& run,
                            hamjet::cli::SweepOptions& options) {
  CLI::App* sweep =
      app.add_subcommand("sweep",
                         "a scene many times with other values of some keys: one table, and a map\n"
                         "Example: hamjet sweep study.toml");
  sweep
      ->add_option("study", options.study,
                   "study (TOML): base scene, command, axes or items, columns")
      ->type_name("SCENE");
  add_run_options(*sweep, run, "rows, table.csv, map.svg and summary.json", "out/<study name>");
  sweep->add_option("--threads", options.threads, "items at a time (default: all cores)")
      ->type_name("N");
  sweep
      ->add_option("--shard", options.shard,
                   "compute part k of n alone, without a table (default in an array of Slurm: the "
                   "task)")
      ->type_name("K/N");
  sweep->add_flag("--resume", options.resume, "leave out the items whose rows are there, whole");
  sweep->add_flag("--merge", options.merge,
                  "compute nothing: the table of the rows that are there; with -o alone, of the "
                  "study in that directory");
  return sweep;
}

int dispatch(int argc, char** argv) {
  std::string of_studies;
  for (const std::string_view command : hamjet::io::study_commands()) {
    of_studies += fmt::format("  {:<42}{}\n", fmt::format("hamjet {} scene.toml", command),
                              hamjet::io::first_study_of(command).example);
  }
  CLI::App app(fmt::format(examples, of_studies), "hamjet");
  app.set_version_flag("--version", std::string("hamjet ") + hamjet::version);
  app.require_subcommand(1);
  app.formatter(std::make_shared<hamjet::cli::HelpFormatter>());

  hamjet::cli::InitOptions start;
  const CLI::App* init = hamjet::cli::add_init_command(app, start);

  hamjet::cli::RunOptions options;
  CLI::App* run = app.add_subcommand("run", "run a scene and write its results");
  add_scene_argument(*run, options);
  add_run_options(*run, options, "summary.json and a folder of each integrator",
                  "out/<scene name>");
  add_threads_option(*run, options);
  hamjet::cli::add_override_option(*run, options.overrides);

  CLI::App* check = app.add_subcommand(
      "check", "read a scene and say what would be computed; nothing is written");
  add_scene_argument(*check, options);
  check->add_flag("--time", options.has_time,
                  "measure how long each command would take, for a second each at most");
  check->add_flag(
      "--json", options.json,
      "print it as JSON, with the names of summary.json; what is wrong too: file, line, "
      "column, key, message, exit code");
  hamjet::cli::add_override_option(*check, options.overrides);

  CLI::App* demo = app.add_subcommand("demo", "run the paper's Earth orbit, which is built in");
  add_run_options(*demo, options, "summary.json and a folder of each integrator",
                  "out/earth-orbit");
  hamjet::cli::add_override_option(*demo, options.overrides);

  hamjet::cli::CompareOptions comparison;
  CLI::App* compare =
      app.add_subcommand("compare", "measure error against run time of many integrators");
  add_scene_argument(*compare, comparison.scene);
  add_run_options(*compare, comparison.scene, "report.html, compare.csv and compare.json",
                  "out/<scene name>");
  hamjet::cli::add_override_option(*compare, comparison.scene.overrides);
  compare->add_flag("--resume", comparison.resume,
                    "take up a comparison that was interrupted, from the output directory");
  std::string plots;
  compare->add_option("--plots", plots, "the report's plots as files too: pdf or png")
      ->check(CLI::IsMember({"pdf", "png"}));

  const auto add_study = [&](std::string_view command) {
    const auto& study = hamjet::io::first_study_of(command);
    CLI::App* subcommand = app.add_subcommand(std::string(command), std::string(study.purpose));
    add_scene_argument(*subcommand, options);
    add_run_options(*subcommand, options, std::string(study.files),
                    "out/<scene name>" + study.suffix());
    hamjet::cli::add_override_option(*subcommand, options.overrides);
  };
  for (const std::string_view command : hamjet::io::study_commands()) add_study(command);
  app.get_subcommand("uncertainty")
      ->add_option_function<std::string>(
          "--radius_m",
          [&](const std::string& metres) {
            options.of_options.push_back({"uncertainty.collision.radius_m", metres, "--radius_m"});
          },
          "the sum of the radii of both spacecraft, of a conjunction data message in place of a "
          "scene")
      ->type_name("METRES");
  hamjet::cli::StoredJetChoice stored;
  CLI::App& transfer = *app.get_subcommand("transfer");
  CLI::Option* jet =
      transfer
          .add_option("--jet", stored.directory,
                      "directory with the results of `hamjet run`, or a file .h5 of them: take the "
                      "jet stored there instead of computing; its duration is the transfer time")
          ->type_name("FILE");
  transfer.add_option("--run", stored.run, "label of the integrator whose jet is taken")
      ->needs(jet)
      ->type_name("LABEL");
  constexpr const char* all_coordinates = "all";
  std::string coordinates;
  std::vector<std::string> coordinates_names(hamjet::jet_coordinates_names.begin(),
                                             hamjet::jet_coordinates_names.end());
  coordinates_names.emplace_back(all_coordinates);
  app.get_subcommand("validity")
      ->add_option("--coordinates", coordinates,
                   "coordinates of the polynomials at both ends, in place of jet.coordinates; all: "
                   "a table and a plot of the reach in each of them")
      ->check(CLI::IsMember(coordinates_names));

  std::optional<std::string> suite;
  CLI::App* stability = app.add_subcommand(
      "stability", "run the stiff and extreme cases: right, refused, marked, or wrong");
  stability
      ->add_option("--suite", suite, "folder of cases, or one case (default: data/scenes/extreme)")
      ->type_name("SCENES");
  add_run_options(*stability, options, "stability.html, stability.csv and summary.json",
                  "out/stability", "print a list of one object a case");

  hamjet::cli::EvalOptions evaluation;
  const CLI::App* eval = hamjet::cli::add_eval_command(app, evaluation);

  hamjet::cli::ConvertOptions conversion;
  const CLI::App* convert = hamjet::cli::add_convert_command(app, conversion);
  hamjet::cli::SweepOptions sweeps;
  const CLI::App* sweep = add_sweep_command(app, options, sweeps);

  std::optional<std::string> what;
  const CLI::App* list = hamjet::cli::add_list_command(app, what);

  std::string shell;
  const CLI::App* completion = hamjet::cli::add_completion_command(app, shell);

  std::optional<std::string> topic;
  CLI::App* help = app.add_subcommand(
      "help", "what --help prints of a command, or of the program; or the keys of a table");
  help->add_option("command", topic,
                   "a command (default: the program), or a table or key of scenes, as deputy, "
                   "uncertainty.collision or order")
      ->type_name("COMMAND");

  // The command's options come behind its name; a -- before it ends those of the program.
  const int first = argc > 1 && std::string_view(argv[1]) == "--" ? 2 : 1;
  if (argc <= first) {
    std::fputs(app.help().c_str(), stderr);
    return static_cast<int>(ErrorKind::usage);
  }
  try {
    // CLI11 takes the words from the last to the first.
    app.parse(std::vector<std::string>(std::reverse_iterator(argv + argc),
                                       std::reverse_iterator(argv + first)));
  } catch (const CLI::ParseError& error) {
    const bool is_request = error.get_exit_code() == 0;  // --help, --version
    if (!is_request) throw hamjet::Error(ErrorKind::usage, hamjet::cli::usage_message(app, error));
    std::ostringstream text;
    app.exit(error, text, text);
    hamjet::cli::print(text.str());
    return 0;
  }
  for (int i = 0; i < argc; ++i)
    options.command += (i == 0 ? "" : " ") + hamjet::io::in_shell_quotes(argv[i]);
  for (auto* given : {&options, &comparison.scene}) hamjet::cli::take_standard_input(*given);
  if (*help) {
    hamjet::cli::print(hamjet::cli::help_text(app, topic));
    return 0;
  }
  if (*init) {
    start.program = hamjet::io::in_shell_quotes(argv[0]);
    return hamjet::cli::init(start);
  }
  if (*list) return hamjet::cli::list(what);
  if (*completion) return hamjet::cli::completion(app);
  if (*eval) return hamjet::cli::eval(evaluation);
  if (*convert) return hamjet::cli::convert(conversion);
  if (*check) return hamjet::cli::check(options);
  if (*compare) {
    comparison.scene.command = options.command;
    if (plots == "pdf") comparison.plots = hamjet::io::PlotFormat::pdf;
    if (plots == "png") comparison.plots = hamjet::io::PlotFormat::png;
    return hamjet::cli::compare(comparison);
  }
  if (*stability) return hamjet::cli::stability(options, suite);
  if (*sweep) return hamjet::cli::sweep(options, sweeps);
  if (*run || *demo) return hamjet::cli::run(options);
  if (stored.directory) return hamjet::cli::transfer_by_stored_jet(options, stored);
  if (coordinates == all_coordinates) return hamjet::cli::validity_in_all_coordinates(options);
  if (!coordinates.empty()) {
    options.of_options = {{"jet.end_coordinates", "null", "--coordinates"},
                          {"jet.coordinates", fmt::format("\"{}\"", coordinates), "--coordinates"}};
  }
  return hamjet::cli::study(options, app.get_subcommands().front()->get_name());
}

}  // namespace

int main(int argc, char** argv) {
  hamjet::cli::open_standard_streams();
  hamjet::cli::catch_signals();
  std::set_terminate(hamjet::cli::end_after_unhandled_exception);
  try {
    hamjet::cli::require_stack();
    hamjet::cli::reset_arithmetic();
    return dispatch(argc, argv);
  } catch (const hamjet::cli::Interrupted& interrupted) {
    return hamjet::cli::end_interrupted(interrupted, "interrupted; nothing was written");
  } catch (const hamjet::Error& error) {
    hamjet::cli::print_error(error.what());
    return error.exit_code();
  } catch (const std::bad_alloc&) {
    hamjet::cli::print_error(hamjet::cli::out_of_memory);
    return static_cast<int>(ErrorKind::too_large);
  } catch (const std::system_error& error) {
    // What the system refuses: a thread where memory or the number of processes is limited, or else
    // a file.
    const bool lacks_resources = error.code() == std::errc::resource_unavailable_try_again ||
                                 error.code() == std::errc::not_enough_memory;
    hamjet::cli::print_error(lacks_resources ? hamjet::cli::out_of_memory : error.what());
    return static_cast<int>(lacks_resources ? ErrorKind::too_large : ErrorKind::input_output);
  } catch (const std::exception& error) {
    hamjet::cli::print_error(error.what());
    return static_cast<int>(ErrorKind::numerical);
  }
}
