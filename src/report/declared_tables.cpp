#include "declared_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "formation/validity_table.hpp"
#include "uncertainty/moments_table.hpp"

namespace hamjet::io {
namespace {

/// What all tables are declared with.
Scene declaring_scene() {
  Scene scene;
  scene.order = 2;
  return scene;
}

TableView declared_validity() {
  ValidityResult result;
  result.scene = declaring_scene();
  result.scene.validity.emplace();
  return validity_table(result);
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
  return uncertainty_tables(result);
}

/// The column's names in CSV, where it is there.
std::string csv_cell(const TableColumn& column) {
  if (!column.is_in_csv) return "-";
  if (column.parts == std::vector{column.name}) return "yes";
  return fmt::format("`{}`", fmt::join(column.parts, "`, `"));
}

std::string named(const TableDimension& dimension) {
  return dimension.name.empty() ? "rows" : dimension.name;
}

/// What a column has a cell for, as in "times, orders".
std::string cells_text(const TableView& table, const TableColumn& column) {
  std::string text;
  for (std::size_t i = 0; i < column.level; ++i) {
    text += (i == 0 ? "" : ", ") + named(table.dimensions[i]);
  }
  return text.empty() ? "the result" : text;
}

}  // namespace

std::vector<TableView> declared_tables() {
  std::vector<TableView> tables = {declared_validity()};
  for (TableView& table : declared_uncertainty()) tables.push_back(std::move(table));
  return tables;
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
