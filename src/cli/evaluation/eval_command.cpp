#include "eval_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>

#include "../../app/deputy_evaluation.hpp"
#include "../../app/eval_coordinates.hpp"
#include "../../app/jet_evaluation.hpp"
#include "../../app/parameter_range.hpp"
#include "../../app/refusal.hpp"
#include "../../formats/relative_frame_text.hpp"
#include "../../report/study_checks.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../store/spooled_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/scene_message.hpp"
#include "../output_file.hpp"
#include "../process/interruption.hpp"
#include "../process/standard_streams.hpp"
#include "deviation_rows.hpp"
#include "eval_output.hpp"
#include "eval_source.hpp"
#include "evaluation_work.hpp"
#include "hamjet/error.hpp"

namespace hamjet::cli {
namespace {

using Json = nlohmann::ordered_json;

void check_options(const EvalOptions& options) {
  refuse_empty(options.directory, "directory", "the results of hamjet run");
  refuse_empty(options.deviations, "--deviations", "a file");
  refuse_empty(options.deputy, "--deputy", "a scene");
  refuse_empty(options.run, "--run", "a run");
  refuse_empty(options.time, "--time", "a time");
  refuse_empty(options.output, "--output", "a file");
  options.frames.check();
  if (!options.overrides.empty() && !is_of_scene(options) && !options.deputy) {
    refuse(
        "--set: changes a key of a scene, and none is given; of stored results run the scene "
        "anew");
  }
  const int given = int(options.deviation.has_value()) + int(options.deviations.has_value()) +
                    int(options.deputy.has_value());
  if (given > 1) {
    refuse("--deviation, --deviations and --deputy: must not be given together, but one of them");
  }
  if (options.output) {
    std::error_code none;
    const auto replaces = [&](const std::filesystem::path& file) {
      return std::filesystem::equivalent(file, *options.output, none);
    };
    if ((options.deviations && replaces(*options.deviations)) ||
        (std::filesystem::is_regular_file(*options.output, none) && replaces(options.directory))) {
      refuse("--output: is a file that this command reads; choose another");
    }
  }
  if (options.deviations == standard_input && options.directory == standard_input) {
    refuse("--deviations: got -, and the scene is read from standard input already");
  }
  if (given == 0) {
    refuse(
        "nothing to evaluate; give --deviation with numbers, --deviations with a CSV file or "
        "--deputy with a scene");
  }
}

/// What an estimate of the miss is made of.
std::string miss_covers(const EvalSource& jet) {
  if (jet.scene && !jet.scene->error.is_known()) {
    return fmt::format("missing degrees and rounding; not errors of the {}",
                       jet.scene->seconds > 0
                           ? "integration, which independent ones could not follow"
                           : "coefficients, of which the results say nothing");
  }
  if (jet.scene) {
    return fmt::format("missing degrees, rounding, and errors of {}",
                       jet.scene->seconds > 0
                           ? "the integration, by two others of the chief and of degree 1"
                           : "degrees 0 and 1 as the results state them");
  }
  const io::StoredJet& stored = jet.stored;
  return fmt::format("missing degrees, rounding of coefficients and evaluation{}",
                     stored.error_by_degree.empty()
                         ? "; not errors of the coefficients, of which the results say nothing"
                         : ", and errors of the coefficients as the results state them");
}

/// The same text for jets at several times, of which the last may be in coordinates of its own.
std::string miss_covers(const std::vector<EvalSource>& jets) {
  const std::string last = miss_covers(jets.back());
  const std::string first = miss_covers(jets.front());
  return first == last ? last : fmt::format("{}; before the end {}", last, first);
}

/// The self-checks of a scene in place of results.
std::vector<SelfCheck> checks_of(const std::vector<EvalSource>& jets) {
  const auto& scene = jets.front().scene;
  return scene ? scene->checks : std::vector<SelfCheck>{};
}

/// Whether the polynomials are of spacecraft that are not like the chief.
bool has_companion(const EvalSource& jet) {
  const auto& scene = jet.scene;
  return scene && scene->companion != SixNumbers<double>{};
}

Json domains_json(const std::optional<EvalDomains>& domains) {
  if (!domains) return nullptr;
  Json splits = Json::object();
  for (std::size_t i = 0; i < domains->splits.size(); ++i) {
    splits[std::string(EvalDomains::coordinates[i])] = domains->splits[i];
  }
  Json list = Json::array();
  for (const EvalDomain& domain : domains->domains) {
    list.push_back({{"centre_m", std::span(domain.centre).first<3>()},
                    {"centre_m_s", std::span(domain.centre).last<3>()},
                    {"half_widths_m", std::span(domain.half_widths).first<3>()},
                    {"half_widths_m_s", std::span(domain.half_widths).last<3>()},
                    {"deputies", domain.deputies},
                    {"miss_estimate_m", io::json_number(domain.miss_m)}});
  }
  return {{"tolerance_m", domains->tolerance_m},
          {"count", domains->count},
          {"most", domains->most},
          {"is_limited", domains->is_limited},
          {"not_right", domains->not_right},
          {"largest_miss_estimate_m", io::json_number(domains->largest_miss_m)},
          {"maps", domains->maps},
          {"seconds", domains->seconds},
          {"splits", splits},
          {"first", list}};
}

std::string summary(const EvalOptions& options, const std::vector<EvalSource>& jets,
                    const EvaluationWork& work, const EvalOutput& output) {
  const io::StoredJet& stored = jets.front().stored;
  const bool is_rtn = options.frames.frame == "RTN" || options.frames.final_frame() == "RTN";
  const auto points = static_cast<double>(output.rows());
  const Json json = {{"scene", stored.scene},
                     {"run", stored.label},
                     {"model", model_name(stored.model)},
                     {"coordinates", name_of(jets.back().coordinates().start)},
                     {"end_coordinates", name_of(jets.back().coordinates().end)},
                     {"order", jets.front().order()},
                     {"degree", work.degree},
                     {"frame", options.frames.frame},
                     {"final_frame", options.frames.final_frame()},
                     {"derivatives", is_rtn ? Json(options.frames.derivatives.value_or("rotating"))
                                            : Json(nullptr)},
                     {"duration_s", jets.back().stored.duration * stored.units.time_s},
                     {"times", jets.size()},
                     {"points", output.rows()},
                     {"outside", output.outside()},
                     {"unknown", output.unknown()},
                     {"undefined", output.undefined()},
                     {"miss_estimate_covers", miss_covers(jets)},
                     {"largest_miss_estimate_m",
                      output.largest_miss() ? Json(*output.largest_miss()) : Json(nullptr)},
                     {"domains", domains_json(work.domains)},
                     {"evaluation",
                      {{"seconds", work.seconds},
                       {"nanoseconds_per_point", work.seconds / points * 1e9},
                       {"chart_seconds", work.chart_seconds},
                       {"chart_nanoseconds_per_point", work.chart_seconds / points * 1e9},
                       {"multiply_adds_per_point", work.multiply_adds_per_point},
                       {"products_per_point", work.products_per_point},
                       {"multiply_adds_per_second", work.multiply_adds_per_second()}}},
                     {"rows", output.json_rows()},
                     {"checks", io::checks_json(checks_of(jets))}};
  return io::json_text(json) + "\n";
}

/// What deputies were split into, across what, and which of them are not right.
void report(const EvalDomains& domains) {
  std::string across;
  for (std::size_t i = 0; i < domains.splits.size(); ++i) {
    if (domains.splits[i] == 0) continue;
    across += fmt::format("{}{} across {}", across.empty() ? "" : ", ", domains.splits[i],
                          EvalDomains::coordinates[i]);
  }
  std::string text = counted(domains.count, "domain");
  if (std::isfinite(domains.largest_miss_m)) {
    text += fmt::format(", estimates of the miss up to {}", length_text(domains.largest_miss_m));
  }
  if (!across.empty()) {
    text += fmt::format(", split {}; {} integrated in {}", across, counted(domains.maps, "map"),
                        duration_text(domains.seconds));
  }
  print_note(text);
  if (domains.not_right == 0) return;
  print_note(fmt::format(
      "{} not right to {}, and marked outside: {}", counted(domains.not_right, "deputy"),
      length_text(domains.tolerance_m),
      domains.is_limited
          ? fmt::format("the limit of {} was met; a larger eval.most_domains may do",
                        counted(domains.most, "domain"))
          : "rounding and integration alone are more, or orbits that cannot be flown are near"));
}

void report(const EvalCoordinates& coordinates, const std::vector<EvalSource>& jets,
            const EvaluationWork& work, const EvalOutput& output) {
  const EvalSource& jet = jets.back();
  const bool is_linear = jet.order() < 2;
  const auto points = static_cast<double>(output.rows());
  // What it costs is of interest where there is much of it; --json has it in any case.
  constexpr std::size_t many = 1000;
  const bool has_cost = output.rows() >= many;
  if (has_cost) {
    print_note(fmt::format(
        "points {}, evaluation alone {:.3g} s, {:.3g} ns a point, {} multiply-adds a point, "
        "{:.3g} multiply-adds a second",
        output.rows(), work.seconds, work.seconds / points * 1e9, work.multiply_adds_per_point,
        work.multiply_adds_per_second()));
  }
  if (jet.scene) {
    if (has_cost) {
      print_note(fmt::format(
          "{} coordinates, {}; of a point's time {:.3g} ns are the polynomials, with the lower "
          "degrees that estimates need, and {:.3g} ns the coordinates at both ends",
          name_of(jet.coordinates()),
          jet.scene->seconds > 0 ? "integrated in " + duration_text(jet.scene->seconds) : "stored",
          (work.seconds - work.chart_seconds) / points * 1e9, work.chart_seconds / points * 1e9));
    }
    const std::string choice = io::choice_text(jet.coordinates());
    if (!choice.empty()) {
      print_note(fmt::format("{} coordinates, {}", name_of(jet.coordinates()), choice));
    }
  }
  if (jets.front().coordinates() != jet.coordinates()) {
    print_note(fmt::format(
        "{} coordinates are of the end alone; before it the jets are in positions and momenta",
        name_of(jet.coordinates())));
  }
  if (has_companion(jet)) {
    print_note("all rows are of spacecraft like the scene's deputy in drag and radiation");
  }
  print_note(fmt::format("frame {}; the estimates of the miss cover {}", coordinates.text(),
                         miss_covers(jets)));
  if (work.domains) report(*work.domains);
  if (work.beyond_tolerance > 0) {
    print_note(fmt::format(
        "{} not right to {}, the tolerance of the scene's table [eval], and marked outside: "
        "results "
        "have one centre; hamjet eval with the scene in their place splits",
        counted(work.beyond_tolerance, "row"), length_text(*jet.stored.eval_tolerance_m)));
  } else if (output.outside() > 0 && !work.domains) {
    print_note(fmt::format(
        "{} of {} marked outside, beyond the polynomial's reach: its degrees do not decay at "
        "such deviations, and the numbers are sizes alone",
        output.outside(), counted(output.rows(), "row")));
  }
  if (output.undefined() > 0) {
    print_note(fmt::format(
        "{} of {} without numbers: their final state is no elliptic orbit with a node, or not "
        "finite, and has no coordinates of this kind",
        output.undefined(), counted(output.rows(), "row")));
  }
  if (output.unknown() > 0) {
    print_note(fmt::format("{} of {} marked unknown: {}", output.unknown(),
                           counted(output.rows(), "row"),
                           is_linear ? "degree 1 alone has no decay to judge by"
                                     : "they have no numbers, or some beyond double precision"));
  }
}

/// Marks outside what is not right to the tolerance of the scene's [eval], as a scene of one domain
/// does; returns whether it does so.
bool is_beyond(const std::optional<double>& tolerance_m, MissEstimate& estimate) {
  if (!tolerance_m || (estimate.is_inside() && estimate.miss_m() <= *tolerance_m)) return false;
  if (estimate.is_inside()) estimate.support = TruncationEstimate::Support::outside;
  return true;
}

/// Carries all deviations through one jet; returns how many are beyond the tolerance, if one is
/// given.
template <class Evaluation>
std::size_t carry(const EvalCoordinates& coordinates, double time_s, DeviationRows& deviations,
                  Evaluation& evaluation, ParameterRange* range,
                  const std::optional<double>& tolerance_m, EvalOutput& output) {
  std::size_t beyond = 0;
  while (true) {
    stop_if_interrupted();
    const io::NumberTable part = deviations.read(Evaluation::most_points);
    if (part.rows() == 0) return beyond;
    for (std::size_t row = 0; row < part.rows(); ++row) {
      const std::vector<double> variables = deviations.variables(coordinates, part, row);
      if (range != nullptr) range->look(variables);
      evaluation.add(variables);
    }
    evaluation.run([&](const std::vector<double>& deviation, MissEstimate estimate) {
      const auto state = coordinates.final_state(deviation, evaluation.chief_error(), estimate);
      if (is_beyond(tolerance_m, estimate)) ++beyond;
      output.add(time_s, state, estimate);
    });
  }
}

void evaluate(const EvalOptions& options, const EvalSource& jet, DeviationRows& deviations,
              EvaluationWork& work, ParameterRange* range, EvalOutput& output) {
  const EvalCoordinates coordinates(jet.stored, options.frames, jet.told());
  const double time_s = jet.stored.duration * jet.stored.units.time_s;
  if (jet.scene) {
    const int degree = options.degree.value_or(jet.order());
    const std::size_t threads = options.threads.value_or(usable_processors());
    const auto evaluate_by = [&](auto&& evaluation) {
      work.beyond_tolerance += carry(coordinates, time_s, deviations, evaluation, nullptr,
                                     jet.stored.eval_tolerance_m, output);
      work.add(evaluation.seconds(), evaluation.multiply_adds(),
               MapEvaluator(jet.scene->flow->polynomials(), degree));
      work.chart_seconds += evaluation.chart_seconds();
    };
    if (jet.scene->split_scene) {
      DomainEvaluation evaluation(*jet.scene, degree, threads, stop_if_interrupted);
      evaluate_by(evaluation);
      work.domains = evaluation.domains();
    } else {
      evaluate_by(DeputyEvaluation(*jet.scene, degree, threads));
    }
    return;
  }
  JetEvaluation evaluation(jet.stored, options.degree);
  work.beyond_tolerance += carry(coordinates, time_s, deviations, evaluation, range,
                                 jet.stored.eval_tolerance_m, output);
  const MapEvaluator& evaluator = evaluation.evaluator();
  const std::size_t multiply_adds = evaluation.points() * evaluator.multiply_adds_per_point();
  work.add(evaluation.seconds(), static_cast<double>(multiply_adds), evaluator);
}

}  // namespace

int eval(const EvalOptions& given) {
  EvalOptions options = given;
  check_options(options);
  take_standard_input(options);
  const std::vector<EvalSource> jets = read_eval_sources(options);
  const io::StoredJet& stored = jets.front().stored;
  if (options.degree && (*options.degree < 1 || *options.degree > jets.front().order())) {
    refuse(fmt::format("--degree {}: must be 1 to the order of the jet, {}", *options.degree,
                       jets.front().order()));
  }
  const EvalCoordinates coordinates(stored, options.frames, jets.front().told());
  if (has_companion(jets.front()) && options.deputy && *options.deputy != options.directory) {
    refuse(
        "--deputy: the polynomials are of spacecraft like the deputy of their own scene, which "
        "air or light moves otherwise than its chief, got another scene; must be its own");
  }
  std::optional<OutputFile> file;
  if (options.output) file.emplace(*options.output);
  DeviationRows deviations(options, stored, coordinates);
  if (jets.size() > 1) deviations.keep();

  // Until all rows are there, none is seen.
  io::SpooledText printed;
  EvaluationWork work;
  ParameterRange range(stored);
  EvalOutput output(coordinates.final_columns(), options.time.has_value(),
                    [&](std::string_view csv) {
                      if (file) {
                        file->add(csv);
                      } else if (!options.json) {
                        printed.add(csv);
                      }
                    });
  for (const EvalSource& jet : jets) {
    if (&jet != &jets.front()) deviations.rewind();
    // The rows are the same at all times.
    const bool is_first = &jet == &jets.front();
    evaluate(options, jet, deviations, work, is_first ? &range : nullptr, output);
  }
  output.finish();

  if (file) file->put_in_place();
  // From here on a signal ends the program at once: what is printed cannot be taken back.
  { const UninterruptedWriting results; }
  if (options.json) {
    print(summary(options, jets, work, output));
  } else if (!file) {
    printed.hand_out(print);
  }
  if (!options.quiet) report(coordinates, jets, work, output);
  if (const auto warning = range.warning()) print_error(*warning);
  int code = 0;
  for (const SelfCheck& check : checks_of(jets)) {
    if (check.state != SelfCheckState::failed) continue;
    print_error(fmt::format("a check failed: {}: {}", name_of(check.name), check.text));
    code = static_cast<int>(ErrorKind::check_failed);
  }
  const std::size_t not_inside = output.outside() + output.unknown();
  if (!options.strict || not_inside == 0) return code;
  print_error(fmt::format("--strict: {} of {} not inside the polynomial's reach", not_inside,
                          counted(output.rows(), "row")));
  return static_cast<int>(ErrorKind::check_failed);
}

}  // namespace hamjet::cli
