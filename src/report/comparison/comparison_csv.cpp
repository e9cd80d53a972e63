#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "../../store/csv_values.hpp"
#include "hamjet/report/comparison_report.hpp"
#include "hamjet/studies/method_description.hpp"

namespace hamjet::io {
namespace {

/// Numbers of columns that a comparison needs: runs of different order differ in their number of
/// degrees.
struct Columns {
  std::size_t errors = 0;
  std::size_t symplecticity = 0;
  std::size_t exactness = 0;
};

Columns count_columns(const ComparisonResult& result) {
  Columns columns;
  for (const auto* runs : {&result.runs, &result.cost_runs}) {
    for (const ComparedRun& run : *runs) {
      columns.errors = std::max(columns.errors, run.error_by_degree.size());
      columns.symplecticity = std::max(columns.symplecticity, run.symplecticity.size());
      columns.exactness = std::max(columns.exactness, run.exactness.size());
    }
  }
  return columns;
}

std::string header(const Columns& columns) {
  std::string line = "part,series,label,method";
  for (const MethodSetting& setting : compared_settings()) {
    line += fmt::format(",{}", setting.column);
  }
  line +=
      ",step_canonical,tolerance,order,status,reason,steps,rejected_steps,"
      "vector_field_evaluations,nominal_evaluations,multiply_adds,memory_bytes,"
      "repeats,median_seconds,least_seconds,most_seconds,error_at_formation_m,largest_error";
  for (std::size_t d = 0; d < columns.errors; ++d) line += fmt::format(",error_degree_{}", d);
  line += ",largest_error_estimate";
  for (std::size_t d = 0; d < columns.errors; ++d) {
    line += fmt::format(",error_estimate_degree_{}", d);
  }
  line += ",largest_symplecticity";
  for (std::size_t d = 0; d < columns.symplecticity; ++d) {
    line += fmt::format(",symplecticity_absolute_degree_{0},symplecticity_scaled_degree_{0}", d);
  }
  line += ",exactness_failure";
  for (std::size_t d = 0; d < columns.exactness; ++d) {
    line += fmt::format(
        ",exactness_absolute_degree_{0},exactness_scaled_degree_{0},"
        "exactness_at_formation_scale_degree_{0},exactness_floor_absolute_degree_{0},"
        "exactness_floor_scaled_degree_{0},exactness_floor_at_formation_scale_degree_{0}",
        d);
  }
  return line + ",energy_error,corner\n";
}

std::string residual_fields(const ExactnessResidual& residual) {
  return fmt::format(",{},{},{}", csv_number(residual.absolute), csv_number(residual.scaled),
                     csv_number(residual.at_formation_scale));
}

std::string status(const ComparedRun& run) {
  if (!run.failure.empty()) return "failed";
  return run.left_out.empty() ? "finished" : "left out";
}

std::string settings_fields(const ComparedRun& run, std::string_view part) {
  const IntegratorSettings& settings = run.settings;
  std::string fields = fmt::format("{},{},{},{}", part, csv_field(run.series),
                                   csv_field(settings.label), method_name(settings.method));
  const auto values = compared_values(settings);
  for (const MethodSetting& setting : compared_settings()) {
    const auto place = std::find_if(values.begin(), values.end(),
                                    [&](const auto& value) { return value.first == setting.key; });
    fields += "," + (place == values.end() ? std::string() : place->second);
  }
  return fields + fmt::format(",{},{},{},{},{}", csv_number(settings.step_canonical),
                              csv_number(settings.tolerance), run.order, status(run),
                              csv_field(run.failure.empty() ? run.left_out : run.failure));
}

std::string cost_fields(const ComparedRun& run) {
  const IntegrationStatistics& statistics = run.statistics;
  std::string fields =
      fmt::format(",{},{},{},{},{},{},{}", statistics.steps, statistics.rejected_steps,
                  statistics.vector_field_evaluations, statistics.nominal_evaluations,
                  csv_number(run.multiply_adds), csv_number(run.memory_bytes), run.seconds.size());
  if (run.seconds.empty()) return fields + ",,,";
  const auto [least, most] = std::minmax_element(run.seconds.begin(), run.seconds.end());
  return fields + fmt::format(",{},{},{}", csv_number(run.median_seconds()), csv_number(*least),
                              csv_number(*most));
}

/// The largest of errors by degree, then all of them, in so many columns more.
std::string error_fields(const std::vector<double>& errors, double largest, std::size_t columns) {
  std::string fields = "," + (errors.empty() ? "" : csv_number(largest));
  for (std::size_t d = 0; d < columns; ++d) {
    fields += "," + (d < errors.size() ? csv_number(errors[d]) : "");
  }
  return fields;
}

std::string map_fields(const ComparedRun& run, const Columns& columns, bool has_formation) {
  std::string fields = "," + (has_formation ? csv_number(run.error_at_formation_m) : "");
  fields += error_fields(run.error_by_degree, run.largest_error(), columns.errors);
  fields +=
      error_fields(run.error_estimate_by_degree, run.largest_error_estimate(), columns.errors);
  fields += "," + (run.symplecticity.empty() ? "" : csv_number(run.largest_symplecticity()));
  for (std::size_t d = 0; d < columns.symplecticity; ++d) {
    fields += d < run.symplecticity.size()
                  ? fmt::format(",{},{}", csv_number(run.symplecticity[d].absolute),
                                csv_number(run.symplecticity[d].scaled))
                  : ",,";
  }
  fields += "," + csv_field(run.exactness_failure);
  for (std::size_t d = 0; d < columns.exactness; ++d) {
    if (d >= run.exactness.size()) {
      fields += ",,,,,,";
      continue;
    }
    fields += residual_fields(run.exactness[d].residual);
    fields += run.exactness[d].floor ? residual_fields(*run.exactness[d].floor) : ",,,";
  }
  return fields + fmt::format(",{},{}", csv_number(run.energy_error),
                              run.corner ? corner_names()[static_cast<std::size_t>(*run.corner)]
                                         : std::string_view());
}

}  // namespace

std::string comparison_csv(const ComparisonResult& result) {
  const Columns columns = count_columns(result);
  const std::string first = header(columns);
  // Commas behind the twelve fields that a run without figures has too.
  const auto figures = static_cast<std::size_t>(std::count(first.begin(), first.end(), ',')) - 11;
  const bool has_formation = result.separation_points > 0;
  std::string text = first;
  for (const auto* runs : {&result.runs, &result.cost_runs}) {
    for (const ComparedRun& run : *runs) {
      text += settings_fields(run, runs == &result.runs ? "comparison" : "cost");
      text += run.is_finished() ? cost_fields(run) + map_fields(run, columns, has_formation)
                                : std::string(figures, ',');
      text += "\n";
    }
  }
  return text;
}

}  // namespace hamjet::io
