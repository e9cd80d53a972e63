#include <CLI/CLI.hpp>
#include <string>

#include "../../formats/output_formats.hpp"
#include "../output_option.hpp"
#include "../override_option.hpp"
#include "eval_command.hpp"

namespace hamjet::cli {

CLI::App* add_eval_command(CLI::App& app, EvalOptions& options) {
  CLI::App* eval =
      app.add_subcommand("eval",
                         "map relative states through a stored jet, from its start to its end\n"
                         "Example: hamjet eval out/scene --deviations start.csv -o end.csv");
  eval->add_option("directory", options.directory,
                   "results of hamjet run, or one of their files " + io::jet_file_endings() +
                       "; or a scene (.toml, or - for standard input): its polynomials are "
                       "integrated now, in "
                       "jet.coordinates")
      ->required()
      ->type_name("FILE");
  std::string columns;
  std::string frames;
  for (const DeputyForm form : forms()) {
    std::string names;
    for (const auto& component : components_of(form)) {
      names += (names.empty() ? "" : ", ") + std::string(component.name);
    }
    columns += names + " (" + std::string(name_of(form)) + "), ";
    frames += std::string(name_of(form)) + ",";
  }
  const std::string frame_type = "{" + frames + std::string(canonical_frame) + "}";
  eval->add_option("--deviation", options.deviation,
                   "one deviation, the six numbers of the frame (see --deviations); in the frame "
                   "canonical one number a variable of the jet")
      ->type_name("NUMBERS");
  eval->add_option("--deviations", options.deviations,
                   "CSV file of many (- for standard input); its first line names the columns: " +
                       columns + "or the jet's variables (canonical)")
      ->type_name("FILE");
  eval->add_option("--deputy", options.deputy,
                   "a scene of the same chief (- for standard input): the deputy of its table "
                   "[deputy]")
      ->type_name("SCENE");
  eval->add_option("--run", options.run, "label of the run (default: the first with a result)")
      ->type_name("LABEL");
  eval->add_option("--frame", options.frames.frame,
                   "RTN (default: radial, transverse, normal of the chief), inertial, curvilinear, "
                   "relative-elements (D'Amico), element-differences (Gim and Alfriend; both of "
                   "osculating elements), or canonical")
      ->type_name(frame_type);
  eval->add_option("--to", options.frames.to,
                   "the frame of the results (default: that of the deviations)")
      ->type_name(frame_type);
  eval->add_option(
          "--derivatives", options.frames.derivatives,
          "velocities in RTN: rotating (default: as seen from the turning axes) or inertial")
      ->type_name("{rotating,inertial}");
  eval->add_option("--time", options.time,
                   "jets at these times that jet.times_s (or _orbits, _canonical, count) of the "
                   "scene asked for, and a column time_s (default: the end alone, without it)")
      ->type_name("SECONDS,...|all");
  eval->add_option("--degree", options.degree, "leave out terms above this degree")->type_name("K");
  eval->add_option("--threads", options.threads,
                   "threads for coordinates other than Cartesian (default: all cores); the results "
                   "do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  add_override_option(*eval, options.overrides);
  add_output_option(
      *eval, options.output,
      "CSV file of the final states with estimates of the miss (default: standard output)", "FILE",
      "but standard output is what it is without -o");
  eval->add_flag(
      "--strict", options.strict,
      "exit code 1 if a row is marked outside or unknown: beyond the polynomial's reach");
  eval->add_flag("--json", options.json,
                 "print statistics and, of up to 100 deviations, the final states as JSON");
  eval->add_flag("-q,--quiet", options.quiet, "no time and counts on standard error");
  return eval;
}

}  // namespace hamjet::cli
