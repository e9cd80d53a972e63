#include <fmt/format.h>

#include <algorithm>

#include "../../store/columns.hpp"
#include "../../studies/descriptions/method_description.hpp"
#include "compared_run_members.hpp"
#include "comparison_view.hpp"
#include "hamjet/report/comparison_report.hpp"

namespace hamjet::io {
namespace {

/// A run with the part of the comparison that it belongs to.
struct ComparisonRow {
  const ComparedRun* run;
  std::string_view part;

  const ComparedRun* operator->() const { return run; }
};

using ComparisonColumns = Columns<ComparisonRow>;
using Run = const ComparedRun&;

std::string status(const ComparedRun& run) {
  if (!run.failure.empty()) return "failed";
  return run.left_out.empty() ? "finished" : "left out";
}

void add_settings(ComparisonColumns& columns) {
  using Row = const ComparisonRow&;
  columns.add("part", &ComparisonRow::part);
  columns.add("series", [](Row row) { return row->series; });
  columns.add("label", [](Row row) { return row->settings.label; });
  columns.add("method", [](Row row) { return method_name(row->settings.method); });
  for (const MethodSetting& setting : compared_settings()) {
    columns.add(std::string(setting.column), [key = setting.key](Row row) {
      for (const auto& [name, value] : compared_values(row->settings)) {
        if (name == key) return value;
      }
      return std::string();
    });
  }
  columns.add("step_canonical", [](Row row) { return row->settings.step_canonical; });
  columns.add("tolerance", [](Row row) { return row->settings.tolerance; });
  columns.add("order", [](Row row) { return row->order; });
  columns.add("status", [](Row row) { return status(*row.run); });
  columns.add("reason",
              [](Row row) { return row->failure.empty() ? row->left_out : row->failure; });
}

/// Adds a column of finished runs.
template <class Value>
void add(ComparisonColumns& columns, std::string name, Value value) {
  columns.add_if([](const ComparisonRow& row) { return row->is_finished(); }, std::move(name),
                 [value](const ComparisonRow& row) { return std::invoke(value, *row.run); });
}

/// Adds a column of one degree; `value` gives what is shown of an entry of the list.
template <class Entry, class Value>
void add_degree(ComparisonColumns& columns, std::string_view name, std::size_t degree,
                std::vector<Entry> ComparedRun::*list, Value value) {
  add(columns, fmt::format("{}_degree_{}", name, degree), [=](Run run) {
    return degree < (run.*list).size() ? cell_value(std::invoke(value, (run.*list)[degree]))
                                       : CellValue();
  });
}

void add_costs(ComparisonColumns& columns) {
  const auto add_count = [&](const char* name, long IntegrationStatistics::*count) {
    add(columns, name, [=](Run run) { return run.statistics.*count; });
  };
  add_count("steps", &IntegrationStatistics::steps);
  add_count("rejected_steps", &IntegrationStatistics::rejected_steps);
  add_count("vector_field_evaluations", &IntegrationStatistics::vector_field_evaluations);
  add_count("nominal_evaluations", &IntegrationStatistics::nominal_evaluations);
  add(columns, "multiply_adds", &ComparedRun::multiply_adds);
  add(columns, "memory_bytes", &ComparedRun::memory_bytes);
  add(columns, "repeats", [](Run run) { return run.seconds.size(); });
  add(columns, "median_seconds", median_seconds);
  const auto add_extreme = [&](const char* name, auto extreme) {
    add(columns, name, [=](Run run) {
      const auto found = extreme(run.seconds.begin(), run.seconds.end());
      return found == run.seconds.end() ? std::optional<double>() : *found;
    });
  };
  using Iterator = std::vector<double>::const_iterator;
  add_extreme("least_seconds", std::min_element<Iterator>);
  add_extreme("most_seconds", std::max_element<Iterator>);
}

/// Adds a column of the largest error over all degrees, then a column for each degree.
void add_errors(ComparisonColumns& columns, const std::string& name,
                std::vector<double> ComparedRun::*errors,
                std::optional<double> (*largest)(const ComparedRun&), std::size_t degrees) {
  add(columns, "largest_" + name, largest);
  for (std::size_t d = 0; d < degrees; ++d) {
    add_degree(columns, name, d, errors, [](double error) { return error; });
  }
}

void add_symplecticity(ComparisonColumns& columns, std::size_t degrees) {
  add(columns, "largest_symplecticity", largest_symplecticity);
  for (std::size_t d = 0; d < degrees; ++d) {
    constexpr auto list = &ComparedRun::symplecticity;
    add_degree(columns, "symplecticity_absolute", d, list, &SymplecticityDefect::absolute);
    add_degree(columns, "symplecticity_scaled", d, list, &SymplecticityDefect::scaled);
  }
}

void add_exactness(ComparisonColumns& columns, std::size_t degrees) {
  add(columns, "exactness_failure", &ComparedRun::exactness_failure);
  for (std::size_t d = 0; d < degrees; ++d) {
    for (const bool is_floor : {false, true}) {
      const auto add_residual = [&](const char* name, auto member) {
        add_degree(columns, fmt::format("exactness_{}{}", is_floor ? "floor_" : "", name), d,
                   &ComparedRun::exactness, [=](const ExactnessEntry& entry) {
                     if (!is_floor) return cell_value(entry.residual.*member);
                     return entry.floor ? cell_value((*entry.floor).*member) : CellValue();
                   });
      };
      add_residual("absolute", &ExactnessResidual::absolute);
      add_residual("scaled", &ExactnessResidual::scaled);
      add_residual("at_formation_scale", &ExactnessResidual::at_formation_scale);
    }
  }
}

/// Adds the numbers that have no column yet.
void add_other_numbers(ComparisonColumns& columns) {
  const auto visit_numbers = [](const ComparedRun& run, const auto& visit) {
    for_each_member(run, [&]<class Member>(const char* name, const Member& member) {
      if constexpr (std::is_same_v<Member, double>) visit(std::string(name), member);
    });
  };
  visit_numbers(ComparedRun(), [&](const std::string& name, double) {
    if (columns.has(name)) return;
    add(columns, name, [=](Run run) {
      double found = 0;
      visit_numbers(run, [&](const std::string& other, double number) {
        if (other == name) found = number;
      });
      return found;
    });
  });
}

}  // namespace

std::string comparison_csv(const ComparisonResult& result) {
  std::vector<ComparisonRow> rows;
  for (const ComparedRun& run : result.runs) rows.push_back({&run, "comparison"});
  for (const ComparedRun& run : result.cost_runs) rows.push_back({&run, "cost"});
  // Runs of different order differ in their number of degrees.
  const auto most = [&](auto list) {
    std::size_t count = 0;
    for (const ComparisonRow& row : rows) count = std::max(count, (row.run->*list).size());
    return count;
  };
  ComparisonColumns columns;
  add_settings(columns);
  add_costs(columns);
  const bool has_formation = result.separation_points > 0;
  add(columns, "error_at_formation_m", [=](Run run) {
    return has_formation ? std::optional(run.error_at_formation_m) : std::nullopt;
  });
  const std::size_t degrees = most(&ComparedRun::error_by_degree);
  add_errors(columns, "error", &ComparedRun::error_by_degree, largest_error, degrees);
  add_errors(columns, "error_estimate", &ComparedRun::error_estimate_by_degree,
             largest_error_estimate, degrees);
  add_symplecticity(columns, most(&ComparedRun::symplecticity));
  add_exactness(columns, most(&ComparedRun::exactness));
  add_other_numbers(columns);
  add(columns, "corner", [](Run run) { return run.corner ? corner_text(*run.corner) : ""; });
  return columns.csv(rows);
}

}  // namespace hamjet::io
