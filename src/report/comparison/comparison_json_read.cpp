#include <nlohmann/json.hpp>

#include "../../store/json_reader.hpp"
#include "compared_run_members.hpp"
#include "hamjet/report/comparison_report.hpp"

namespace hamjet::io {
namespace {

void read_member(const JsonReader& value, IntegratorSettings& settings) {
  settings = value.fields<IntegratorSettings>();
}

void read_member(const JsonReader& value, IntegrationStatistics& statistics) {
  statistics.steps = value.at("steps").integer<long>();
  statistics.rejected_steps = value.at("rejected_steps").integer<long>();
  statistics.vector_field_evaluations = value.at("vector_field_evaluations").integer<long>();
  statistics.nominal_evaluations = value.at("nominal_evaluations").integer<long>();
  statistics.wall_seconds = value.at("wall_seconds").number();
}

void read_member(const JsonReader& value, std::string& text) { text = value.text_or_empty(); }

ExactnessResidual read_residual(const JsonReader& value) {
  return {value.at("degree").integer<int>(), value.at("absolute").number(),
          value.at("scaled").number(), value.at("at_formation_scale").optional_number()};
}

void read_member(const JsonReader& value, std::vector<ExactnessEntry>& entries) {
  entries = value.list([](const JsonReader& entry) {
    ExactnessEntry read{read_residual(entry), std::nullopt, std::nullopt, std::nullopt};
    const JsonReader floor = entry.at("floor");
    if (!floor.is_null()) read.floor = read_residual(floor);
    return read;
  });
}

void read_member(const JsonReader& value, std::vector<SymplecticityDefect>& entries) {
  entries = value.list([](const JsonReader& entry) {
    return SymplecticityDefect{entry.at("degree").integer<int>(), entry.at("absolute").number(),
                               entry.at("scaled").number()};
  });
}

void read_member(const JsonReader& value, std::optional<Corner>& corner) {
  if (!value.is_null()) corner = value.one_of<Corner>(corner_names());
}

void read_member(const JsonReader& value, std::vector<double>& numbers) {
  numbers = value.numbers();
}

void read_member(const JsonReader& value, auto& number) { value.read_into(number); }

ComparedRun read_run(const JsonReader& value) {
  ComparedRun run;
  for_each_member(run, [&](const char* name, auto& member) {
    const bool is_in_older_files = std::string_view(name) != "error_estimate_by_degree";
    if (is_in_older_files || value.has(name)) read_member(value.at(name), member);
  });
  run.series = value.at("series").text();  // every run has one
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
