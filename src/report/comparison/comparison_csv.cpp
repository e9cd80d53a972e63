#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "../../store/columns.hpp"
#include "../../studies/descriptions/method_description.hpp"
#include "hamjet/report/comparison_report.hpp"

namespace hamjet::io {
namespace {

/// A run with the part of the comparison that it belongs to.
struct ComparisonRow {
  const ComparedRun* run;
  std::string_view part;

  const ComparedRun& operator*() const { return *run; }
  const ComparedRun* operator->() const { return run; }
};

using ComparisonColumns = Columns<ComparisonRow>;

std::string status(const ComparedRun& run) {
  if (!run.failure.empty()) return "failed";
  return run.left_out.empty() ? "finished" : "left out";
}

void add_settings(ComparisonColumns& columns) {
  using Row = const ComparisonRow&;
  columns.add("part", [](Row row) { return std::string(row.part); });
  columns.add("series", [](Row row) { return row->series; });
  columns.add("label", [](Row row) { return row->settings.label; });
  columns.add("method", [](Row row) { return std::string(method_name(row->settings.method)); });
  for (const MethodSetting& setting : compared_settings()) {
    columns.add(std::string(setting.column), [key = setting.key](Row row) {
      for (const auto& [name, value] : compared_values(row->settings)) {
        if (name == key) return value;
      }
      return std::string();
    });
  }
  columns.add("step_canonical", [](Row row) { return csv_number(row->settings.step_canonical); });
  columns.add("tolerance", [](Row row) { return csv_number(row->settings.tolerance); });
  columns.add("order", [](Row row) { return fmt::format("{}", row->order); });
  columns.add("status", [](Row row) { return status(*row); });
  columns.add("reason",
              [](Row row) { return row->failure.empty() ? row->left_out : row->failure; });
}

/// Columns of finished runs.
class FigureColumns {
 public:
  explicit FigureColumns(ComparisonColumns& columns) : columns_(columns) {}

  void add(std::string name, std::function<std::string(const ComparedRun&)> cell) {
    columns_.add_if([](const ComparisonRow& row) { return row->is_finished(); }, std::move(name),
                    [cell = std::move(cell)](const ComparisonRow& row) { return cell(*row); });
  }

  void add_costs() {
    using Run = const ComparedRun&;
    const auto count = [](auto number) { return fmt::format("{}", number); };
    add("steps", [=](Run run) { return count(run.statistics.steps); });
    add("rejected_steps", [=](Run run) { return count(run.statistics.rejected_steps); });
    add("vector_field_evaluations",
        [=](Run run) { return count(run.statistics.vector_field_evaluations); });
    add("nominal_evaluations", [=](Run run) { return count(run.statistics.nominal_evaluations); });
    add("multiply_adds", [](Run run) { return csv_number(run.multiply_adds); });
    add("memory_bytes", [](Run run) { return csv_number(run.memory_bytes); });
    add("repeats", [=](Run run) { return count(run.seconds.size()); });
    const auto add_seconds = [&](const char* name, auto of) {
      add(name, [of](Run run) { return run.seconds.empty() ? "" : csv_number(of(run)); });
    };
    add_seconds("median_seconds", [](Run run) { return run.median_seconds(); });
    add_seconds("least_seconds",
                [](Run run) { return *std::min_element(run.seconds.begin(), run.seconds.end()); });
    add_seconds("most_seconds",
                [](Run run) { return *std::max_element(run.seconds.begin(), run.seconds.end()); });
  }

  /// The largest of errors by degree, then those of so many degrees.
  void add_errors(const std::string& name, std::vector<double> ComparedRun::*errors,
                  double (ComparedRun::*largest)() const, std::size_t degrees) {
    add("largest_" + name, [=](const ComparedRun& run) {
      return (run.*errors).empty() ? "" : csv_number((run.*largest)());
    });
    for (std::size_t d = 0; d < degrees; ++d) {
      add(fmt::format("{}_degree_{}", name, d), [=](const ComparedRun& run) {
        return d < (run.*errors).size() ? csv_number((run.*errors)[d]) : "";
      });
    }
  }

  void add_symplecticity(std::size_t degrees) {
    add("largest_symplecticity", [](const ComparedRun& run) {
      return run.symplecticity.empty() ? "" : csv_number(run.largest_symplecticity());
    });
    for (std::size_t d = 0; d < degrees; ++d) {
      const auto add_defect = [&](const char* name, auto member) {
        add(fmt::format("symplecticity_{}_degree_{}", name, d), [=](const ComparedRun& run) {
          return d < run.symplecticity.size() ? csv_number(run.symplecticity[d].*member) : "";
        });
      };
      add_defect("absolute", &SymplecticityDefect::absolute);
      add_defect("scaled", &SymplecticityDefect::scaled);
    }
  }

  void add_exactness(std::size_t degrees) {
    add("exactness_failure", [](const ComparedRun& run) { return run.exactness_failure; });
    for (std::size_t d = 0; d < degrees; ++d) {
      for (const bool is_floor : {false, true}) {
        const auto add_residual = [&](const char* name, auto member) {
          add(fmt::format("exactness_{}{}_degree_{}", is_floor ? "floor_" : "", name, d),
              [=](const ComparedRun& run) {
                if (d >= run.exactness.size()) return std::string();
                const ExactnessEntry& entry = run.exactness[d];
                if (!is_floor) return csv_number(entry.residual.*member);
                return entry.floor ? csv_number((*entry.floor).*member) : "";
              });
        };
        add_residual("absolute", &ExactnessResidual::absolute);
        add_residual("scaled", &ExactnessResidual::scaled);
        add_residual("at_formation_scale", &ExactnessResidual::at_formation_scale);
      }
    }
  }

 private:
  ComparisonColumns& columns_;
};

}  // namespace

std::string comparison_csv(const ComparisonResult& result) {
  std::vector<ComparisonRow> rows;
  for (const ComparedRun& run : result.runs) rows.push_back({&run, "comparison"});
  for (const ComparedRun& run : result.cost_runs) rows.push_back({&run, "cost"});
  // Runs of different order differ in their number of degrees.
  const auto most = [&](auto member) {
    std::size_t count = 0;
    for (const ComparisonRow& row : rows) count = std::max(count, ((*row).*member).size());
    return count;
  };
  ComparisonColumns columns;
  add_settings(columns);
  FigureColumns figures(columns);
  figures.add_costs();
  const bool has_formation = result.separation_points > 0;
  figures.add("error_at_formation_m", [=](const ComparedRun& run) {
    return has_formation ? csv_number(run.error_at_formation_m) : "";
  });
  const std::size_t degrees = most(&ComparedRun::error_by_degree);
  figures.add_errors("error", &ComparedRun::error_by_degree, &ComparedRun::largest_error, degrees);
  figures.add_errors("error_estimate", &ComparedRun::error_estimate_by_degree,
                     &ComparedRun::largest_error_estimate, degrees);
  figures.add_symplecticity(most(&ComparedRun::symplecticity));
  figures.add_exactness(most(&ComparedRun::exactness));
  figures.add("energy_error", [](const ComparedRun& run) { return csv_number(run.energy_error); });
  figures.add("corner", [](const ComparedRun& run) {
    return std::string(run.corner ? corner_names()[static_cast<std::size_t>(*run.corner)] : "");
  });
  return columns.csv(rows);
}

}  // namespace hamjet::io
