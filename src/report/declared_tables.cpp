#include "declared_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "bounded/bounded_report.hpp"
#include "bounded/event_report.hpp"
#include "bounded/frozen_orbit_report.hpp"
#include "formation/assignment_tables.hpp"
#include "formation/deputy_motion_report.hpp"
#include "formation/transfer_tables.hpp"
#include "formation/validity_table.hpp"
#include "study_description.hpp"
#include "uncertainty/moments_table.hpp"

namespace hamjet::io {

Scene declaring_scene() {
  Scene scene;
  scene.order = 2;
  scene.nominal.resize(6);
  return scene;
}

std::vector<TableView> declared_transfer() {
  TransferResult result;
  result.scene = declaring_scene();
  result.scene.transfer.emplace().times = {1};
  return transfer_tables(result);
}

std::vector<TableView> declared_motion() {
  DeputyMotion motion;
  motion.scene = declaring_scene();
  motion.scene.deputy.emplace();
  motion.points.push_back({0, {}, {0, 0}, 0});
  return deputy_motion_tables(motion);
}

std::vector<TableView> declared_validity() {
  ValidityResult result;
  result.scene = declaring_scene();
  result.scene.validity.emplace();
  result.domains.emplace();
  return validity_tables(result);
}

std::vector<TableView> declared_assignment() {
  AssignmentResult result;
  result.scene = declaring_scene();
  result.scene.transfer.emplace().times = {1};
  result.scene.assignment.emplace();
  return assignment_tables(result);
}

std::vector<TableView> declared_frozen_orbit() {
  FrozenOrbitStudy study;
  study.scene = declaring_scene();
  study.state.resize(6);
  return poincare_tables(study);
}

std::vector<TableView> declared_event() {
  const Series<double> zero(SeriesSpace::create(6, 0));
  EventStudy study{declaring_scene(), {zero, {zero, zero, zero, zero, zero, zero}}, 0, 0, {}};
  study.scene.event.emplace();
  return event_tables(study);
}

std::vector<TableView> declared_bounded() {
  BoundedFormation formation;
  formation.scene = declaring_scene();
  formation.scene.bounded.emplace().box.half_widths_m.emplace();
  formation.box.emplace().start.resize(6);
  return bounded_tables(formation);
}

std::vector<TableView> declared_uncertainty() {
  UncertaintyResult result;
  result.scene = declaring_scene();
  result.scene.uncertainty.emplace();
  UncertainState state;
  state.name = "chief";
  state.cartesian.assign(2, Cumulants(Vector<double>::Zero(6), {}));
  result.points.resize(1);
  result.points[0].states = {state};
  LeastSeparations& least = result.collision.emplace().separations;
  for (auto* list :
       {&least.shares, &least.separations, &least.errors, &least.lower, &least.upper}) {
    list->resize(4);
  }
  result.safety.emplace();
  result.domains.push_back({"chief", {{Vector<double>::Zero(6)}}});
  return uncertainty_tables(result);
}

namespace {

/// The column's names in CSV, where it is there.
std::string csv_cell(const TableColumn& column) {
  if (!column.is_in_csv) return "-";
  if (column.parts == std::vector{column.name}) return "yes";
  return fmt::format("`{}`", fmt::join(column.parts, "`, `"));
}

/// What a column has a cell for, as in "times, orders".
std::string cells_text(const TableView& table, const TableColumn& column) {
  std::string text;
  for (std::size_t i = 0; i < column.level; ++i) {
    text += (i == 0 ? "" : ", ") + table.dimensions[i].name;
  }
  return text.empty() ? "the result" : text;
}

}  // namespace

std::vector<TableView> declared_tables() {
  std::vector<TableView> all;
  for (const StudyDescription& study : study_descriptions()) {
    for (TableView& table : study.declared()) all.push_back(std::move(table));
  }
  return all;
}

std::string columns_page() {
  std::string text =
      "# Columns of results\n\n"
      "This page is what `hamjet list columns` prints. A column has one name in CSV, in "
      "summary.json and\nas an attribute in Python, where it is an array whose shape is told "
      "under *of each*. In CSV a field is\nempty, in JSON null and in Python NaN or None where "
      "there is nothing.\n";
  for (const TableView& table : declared_tables()) {
    const bool is_file = std::ranges::any_of(table.columns, &TableColumn::is_in_csv);
    text += fmt::format("\n## `{}{}`\n\n{}", table.name, is_file ? ".csv" : "", table.meaning);
    if (!table.place.empty()) text += fmt::format(" In summary.json at `{}`.", table.place);
    text += "\n\n| column | CSV | unit | of each | meaning |\n|---|---|---|---|---|\n";
    for (const TableColumn& column : table.columns) {
      text += fmt::format("| `{}` | {} | {} | {} | {} |\n", column.name, csv_cell(column),
                          column.unit, cells_text(table, column), column.meaning);
    }
  }
  return text;
}

}  // namespace hamjet::io
