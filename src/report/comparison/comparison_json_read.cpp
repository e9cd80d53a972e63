#include <nlohmann/json.hpp>

#include "../../store/json_reader.hpp"
#include "hamjet/report/comparison_report.hpp"

namespace hamjet::io {
namespace {

IntegrationStatistics read_statistics(const JsonReader& value) {
  IntegrationStatistics statistics;
  statistics.steps = value.at("steps").integer<long>();
  statistics.rejected_steps = value.at("rejected_steps").integer<long>();
  statistics.vector_field_evaluations = value.at("vector_field_evaluations").integer<long>();
  statistics.nominal_evaluations = value.at("nominal_evaluations").integer<long>();
  statistics.wall_seconds = value.at("wall_seconds").number();
  return statistics;
}

ExactnessResidual read_residual(const JsonReader& value) {
  return {value.at("degree").integer<int>(), value.at("absolute").number(),
          value.at("scaled").number(), value.at("at_formation_scale").optional_number()};
}

ExactnessEntry read_exactness(const JsonReader& value) {
  ExactnessEntry entry{read_residual(value), std::nullopt};
  const JsonReader floor = value.at("floor");
  if (!floor.is_null()) entry.floor = read_residual(floor);
  return entry;
}

SymplecticityDefect read_symplecticity(const JsonReader& value) {
  return {value.at("degree").integer<int>(), value.at("absolute").number(),
          value.at("scaled").number()};
}

ComparedRun read_run(const JsonReader& value) {
  ComparedRun run;
  run.settings = value.at("settings").fields<IntegratorSettings>();
  run.series = value.at("series").text();
  run.order = value.at("order").integer<int>();
  run.failure = value.at("failure").text_or_empty();
  run.left_out = value.at("left_out").text_or_empty();
  run.statistics = read_statistics(value.at("statistics"));
  run.multiply_adds = value.at("multiply_adds").number();
  run.memory_bytes = value.at("memory_bytes").number();
  run.seconds = value.at("seconds").numbers();
  run.error_by_degree = value.at("error_by_degree").numbers();
  if (value.has("error_estimate_by_degree")) {  // absent from older files
    run.error_estimate_by_degree = value.at("error_estimate_by_degree").numbers();
  }
  run.error_at_formation_m = value.at("error_at_formation_m").number();
  run.exactness = value.at("exactness").list(read_exactness);
  run.exactness_failure = value.at("exactness_failure").text_or_empty();
  run.symplecticity = value.at("symplecticity").list(read_symplecticity);
  run.energy_error = value.at("energy_error").number();
  const JsonReader corner = value.at("corner");
  if (!corner.is_null()) run.corner = corner.one_of<Corner>(corner_names());
  return run;
}

RunAlongTime read_along_time(const JsonReader& value) {
  RunAlongTime run;
  run.label = value.at("label").text();
  run.failure = value.at("failure").text_or_empty();
  run.points = value.at("points").list([](const JsonReader& point) {
    return RunAlongTime::Point{point.at("time_canonical").number(),
                               point.at("exactness").optional_number(),
                               point.at("condition").number(), point.at("energy_error").number()};
  });
  run.singular_times = value.at("singular_times_canonical").numbers();
  run.not_searched = value.at("singular_times_not_searched").text_or_empty();
  return run;
}

}  // namespace

EarlierRuns read_comparison_runs(std::string_view text, const std::string& name) {
  const nlohmann::json json = JsonReader::parse(text, name);
  const JsonReader root(json, name);
  if (root.at("schema").integer<int>() != 1) {
    root.at("schema").fail("must be 1: the file is of another version");
  }
  EarlierRuns earlier;
  earlier.determinants = root.at("determinants").text();
  earlier.is_complete = root.at("complete").boolean();
  earlier.runs = root.at("runs").list(read_run);
  earlier.cost_runs = root.at("cost_runs").list(read_run);
  earlier.along_time = root.at("along_time").list(read_along_time);
  return earlier;
}

}  // namespace hamjet::io
