#include "declared_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formation/validity_table.hpp"

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

std::vector<TableView> declared_tables() { return {declared_validity()}; }

std::string columns_page() {
  std::string text =
      "# Columns of results\n\n"
      "This page is what `hamjet list columns` prints. A column has one name in CSV, in "
      "summary.json and\nas an attribute in Python, where it is an array whose shape is told "
      "under *of each*. In CSV a field is\nempty, in JSON null and in Python NaN or None where "
      "there is nothing.\n";
  for (const TableView& table : declared_tables()) {
    text += fmt::format("\n## `{}.csv`\n\n{}", table.name, table.meaning);
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
