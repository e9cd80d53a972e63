#include "eval_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "../../app/deputy_evaluation.hpp"
#include "../../app/eval_coordinates.hpp"
#include "../../app/jet_evaluation.hpp"
#include "../../app/refusal.hpp"
#include "../../app/required_tables.hpp"
#include "../../app/stored_chief.hpp"
#include "../../formats/number_table.hpp"
#include "../../formats/relative_frame_text.hpp"
#include "../../store/text_file.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/scene_message.hpp"
#include "../output_file.hpp"
#include "../process/interruption.hpp"
#include "../process/standard_streams.hpp"
#include "eval_source.hpp"
#include "evaluation_work.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

namespace hamjet::cli {
namespace {

using Json = nlohmann::ordered_json;
using Support = TruncationEstimate::Support;

/// More rows than this are not printed as JSON, but counted only.
constexpr std::size_t most_json_rows = 100;

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
  if (given == 0) {
    refuse(
        "nothing to evaluate; give --deviation with numbers, --deviations with a CSV file or "
        "--deputy with a scene");
  }
}

/// The one row of the scene's deputy.
io::NumberTable read_deputy(const EvalOptions& options, const io::StoredJet& stored,
                            const EvalCoordinates& coordinates) {
  const RunOptions named = scene_named(options, *options.deputy);
  const std::string& file = *named.scene_file;
  Scene scene;
  try {
    scene = read_scene(named);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("--deputy: {}", error.what()));
  }
  require_deputy(scene, file);
  if (!is_about_chief(stored, scene)) {
    refuse_scene(file, "nominal",
                 fmt::format("another orbit than that of the jet {}, must be the scene that it was "
                             "made from",
                             io::printable(stored.label)));
  }
  const ChiefFrame frame(scene.nominal, {scene.units.length_km * 1000, scene.units.time_s},
                         scene.deputy->frame);
  const std::vector<double> row = coordinates.initial_row(frame.deviation(scene.deputy->start));
  return {row.size(), row};
}

io::NumberTable read_deviations(const EvalOptions& options, const io::StoredJet& stored,
                                const EvalCoordinates& coordinates) {
  if (options.deputy) return read_deputy(options, stored, coordinates);
  const std::vector<std::string_view>& columns = coordinates.initial_columns();
  if (options.deviations) {
    const std::filesystem::path file = *options.deviations;
    return io::read_number_table(io::printable_path(file),
                                 io::read_text_file(file, io::largest_table_bytes), columns,
                                 stop_if_interrupted);
  }
  std::vector<std::string_view> fields;
  io::split_line(*options.deviation, fields);
  io::NumberTable table{columns.size(), {}};
  if (fields.size() != columns.size()) {
    refuse(fmt::format("--deviation: must be {} numbers between commas, {}, got {}", columns.size(),
                       fmt::join(columns, ","), io::in_quotes(*options.deviation)));
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto number = io::finite_number(fields[i]);
    if (!number) {
      refuse(fmt::format("--deviation: {} must be a finite number, got {}", columns[i],
                         io::in_quotes(fields[i])));
    }
    table.numbers.push_back(*number);
  }
  return table;
}

/// The jet's variables of a row; says where the row stands if it has none.
std::vector<double> variables_of(const EvalOptions& options, const EvalCoordinates& coordinates,
                                 const io::NumberTable& deviations, std::size_t row) {
  try {
    return coordinates.variables(deviations.row(row));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::usage) throw;
    if (options.deviation) refuse(fmt::format("--deviation: {}", error.what()));
    if (options.deputy) refuse_scene(*options.deputy, "deputy", error.what());
    throw Error(ErrorKind::input_output,
                fmt::format("{}:{}: {}", io::printable_path(*options.deviations),
                            io::NumberTable::line(row), error.what()));
  }
}

const char* support_name(Support support) {
  switch (support) {
    case Support::inside:
      return "inside";
    case Support::outside:
      return "outside";
    case Support::unknown:
      break;
  }
  return "unknown";
}

/// A number's size, one digit of it, for where the series says nothing.
double size_alone(double x) { return std::isfinite(x) ? std::stod(fmt::format("{:.0e}", x)) : x; }

/// What an estimate of the miss is made of.
std::string miss_covers(const EvalSource& jet) {
  if (jet.scene && !jet.scene->error.is_known()) {
    return fmt::format("missing degrees and the rounding of flights; not errors of the {}",
                       jet.scene->seconds > 0
                           ? "integration, which independent ones could not follow"
                           : "coefficients, of which the results say nothing");
  }
  if (jet.scene) {
    return fmt::format("missing degrees, the rounding of flights, and errors of {}",
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

/// The same of jets at several times, of which the last may be in coordinates of its own.
std::string miss_covers(const std::vector<EvalSource>& jets) {
  const std::string last = miss_covers(jets.back());
  const std::string first = miss_covers(jets.front());
  return first == last ? last : fmt::format("{}; before the end {}", last, first);
}

/// What has been evaluated, as it is printed.
class Output {
 public:
  /// With a column of the time if `has_time`.
  Output(const std::vector<std::string_view>& columns, std::size_t rows, bool has_time)
      : columns_(columns), has_json_rows_(rows <= most_json_rows), has_time_(has_time) {
    fmt::format_to(std::back_inserter(csv_), "{}{},miss_estimate_m,support\n",
                   has_time ? "time_s," : "", fmt::join(columns, ","));
  }

  void add(double time_s, const std::vector<double>& state, const MissEstimate& estimate) {
    const bool is_inside = estimate.is_inside();
    const bool is_outside = estimate.support == Support::outside;
    const auto write = std::back_inserter(csv_);
    ++rows_;
    if (has_time_) fmt::format_to(write, "{},", time_s);
    for (const double x : state) {
      if (std::isfinite(x)) fmt::format_to(write, "{}", is_outside ? size_alone(x) : x);
      fmt::format_to(write, ",");
    }
    undefined_ += std::any_of(state.begin(), state.end(), [](double x) { return std::isnan(x); });
    if (is_inside) fmt::format_to(write, "{:.3g}", estimate.miss_m());
    fmt::format_to(write, ",{}\n", support_name(estimate.support));
    if (is_inside) largest_miss_ = std::max(largest_miss_.value_or(0), estimate.miss_m());
    outside_ += estimate.support == Support::outside ? 1 : 0;
    unknown_ += estimate.support == Support::unknown ? 1 : 0;
    if (!has_json_rows_) return;
    Json row;
    if (has_time_) row["time_s"] = time_s;
    for (std::size_t i = 0; i < state.size(); ++i) {
      row[std::string(columns_[i])] = is_outside ? size_alone(state[i]) : state[i];
    }
    row["miss_estimate_m"] = is_inside ? Json(estimate.miss_m()) : Json(nullptr);
    row["truncation_m"] = is_inside ? Json(estimate.truncation_m) : Json(nullptr);
    row["rounding_m"] = estimate.rounding_m;
    row["integration_m"] = estimate.integration_m;
    row["support"] = support_name(estimate.support);
    json_rows_.push_back(std::move(row));
  }

  std::string csv() const { return fmt::to_string(csv_); }
  Json json_rows() const { return has_json_rows_ ? json_rows_ : Json(nullptr); }
  std::size_t rows() const { return rows_; }
  std::size_t outside() const { return outside_; }
  std::size_t unknown() const { return unknown_; }
  /// Rows whose final state has no numbers of the form asked for.
  std::size_t undefined() const { return undefined_; }
  /// The largest estimate of the miss, in metres, among the rows inside; none without such rows.
  std::optional<double> largest_miss() const { return largest_miss_; }

 private:
  std::vector<std::string_view> columns_;
  bool has_json_rows_;
  bool has_time_;
  std::size_t rows_ = 0;
  fmt::memory_buffer csv_;
  Json json_rows_ = Json::array();
  std::size_t outside_ = 0;
  std::size_t unknown_ = 0;
  std::size_t undefined_ = 0;
  std::optional<double> largest_miss_;
};

std::string summary(const EvalOptions& options, const std::vector<EvalSource>& jets,
                    const EvaluationWork& work, const Output& output) {
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
                     {"evaluation",
                      {{"seconds", work.seconds},
                       {"nanoseconds_per_point", work.seconds / points * 1e9},
                       {"chart_seconds", work.chart_seconds},
                       {"chart_nanoseconds_per_point", work.chart_seconds / points * 1e9},
                       {"multiply_adds_per_point", work.multiply_adds_per_point},
                       {"products_per_point", work.products_per_point},
                       {"multiply_adds_per_second", work.multiply_adds_per_second()}}},
                     {"rows", output.json_rows()}};
  return json.dump(2) + "\n";
}

void report(const EvalCoordinates& coordinates, const std::vector<EvalSource>& jets,
            const EvaluationWork& work, const Output& output) {
  const EvalSource& jet = jets.back();
  const bool is_linear = jet.order() < 2;
  const auto points = static_cast<double>(output.rows());
  print_note(fmt::format(
      "points {}, evaluation alone {:.3g} s, {:.3g} ns a point, {} multiply-adds a point, "
      "{:.3g} multiply-adds a second",
      output.rows(), work.seconds, work.seconds / points * 1e9, work.multiply_adds_per_point,
      work.multiply_adds_per_second()));
  if (jet.scene) {
    print_note(fmt::format(
        "{} coordinates, {}; of a point's time {:.3g} ns are the polynomials, with the lower "
        "degrees that estimates need, and {:.3g} ns the coordinates at both ends",
        name_of(jet.coordinates()),
        jet.scene->seconds > 0 ? "integrated in " + duration_text(jet.scene->seconds) : "stored",
        (work.seconds - work.chart_seconds) / points * 1e9, work.chart_seconds / points * 1e9));
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
  print_note(fmt::format("frame {}; the estimates of the miss cover {}", coordinates.text(),
                         miss_covers(jets)));
  if (output.outside() > 0) {
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
                                     : "their numbers are beyond double precision"));
  }
}

/// Carries all deviations through one jet.
template <class Evaluation>
void carry(const EvalOptions& options, const EvalCoordinates& coordinates, double time_s,
           const io::NumberTable& deviations, Evaluation& evaluation, Output& output) {
  for (std::size_t row = 0; row < deviations.rows(); ++row) {
    evaluation.add(variables_of(options, coordinates, deviations, row));
    if (evaluation.pending() < Evaluation::most_points && row + 1 < deviations.rows()) continue;
    stop_if_interrupted();
    evaluation.run([&](const std::vector<double>& deviation, MissEstimate estimate) {
      estimate.integration_m += coordinates.turned_m(deviation, evaluation.chief_error());
      output.add(time_s, coordinates.final_state(deviation), estimate);
    });
  }
}

void evaluate(const EvalOptions& options, const EvalSource& jet, const io::NumberTable& deviations,
              EvaluationWork& work, Output& output) {
  const EvalCoordinates coordinates(jet.stored, options.frames);
  const double time_s = jet.stored.duration * jet.stored.units.time_s;
  if (jet.scene) {
    const int degree = options.degree.value_or(jet.order());
    DeputyEvaluation evaluation(*jet.scene, degree, options.threads.value_or(usable_processors()));
    carry(options, coordinates, time_s, deviations, evaluation, output);
    work.add(evaluation.seconds(), evaluation.multiply_adds(),
             MapEvaluator(jet.scene->flow->polynomials(), degree));
    work.chart_seconds += evaluation.chart_seconds();
    return;
  }
  JetEvaluation evaluation(jet.stored, options.degree);
  carry(options, coordinates, time_s, deviations, evaluation, output);
  const MapEvaluator& evaluator = evaluation.evaluator();
  const std::size_t multiply_adds = deviations.rows() * evaluator.multiply_adds_per_point();
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
  const EvalCoordinates coordinates(stored, options.frames);
  std::optional<OutputFile> file;
  if (options.output) file.emplace(*options.output);
  const io::NumberTable deviations = read_deviations(options, stored, coordinates);

  EvaluationWork work;
  Output output(coordinates.final_columns(), deviations.rows() * jets.size(),
                options.time.has_value());
  for (const EvalSource& jet : jets) evaluate(options, jet, deviations, work, output);

  if (file) file->write(output.csv());
  // From here on a signal ends the program at once: what is printed cannot be taken back.
  { const UninterruptedWriting results; }
  if (options.json) {
    print(summary(options, jets, work, output));
  } else if (!file) {
    print(output.csv());
  }
  if (!options.quiet) report(coordinates, jets, work, output);
  const std::size_t not_inside = std::max(output.outside() + output.unknown(), output.undefined());
  if (!options.strict || not_inside == 0) return 0;
  print_error(fmt::format("--strict: {} of {} not inside the polynomial's reach", not_inside,
                          counted(output.rows(), "row")));
  return static_cast<int>(ErrorKind::check_failed);
}

}  // namespace hamjet::cli
