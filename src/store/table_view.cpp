#include "table_view.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "json_values.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

Json value_json(const CellValue& value) {
  return std::visit(
      []<class Value>(const Value& held) -> Json {
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return nullptr;
        } else if constexpr (std::is_same_v<Value, double>) {
          return json_number(held);
        } else {
          return held;
        }
      },
      value);
}

/// The values as arrays in arrays of these lengths.
Json nested_json(std::span<const CellValue> values, std::span<const std::size_t> lengths) {
  if (lengths.empty()) return value_json(values.front());
  Json json = Json::array();
  const std::size_t part = lengths[0] == 0 ? 0 : values.size() / lengths[0];
  for (std::size_t i = 0; i < lengths[0]; ++i) {
    json.push_back(nested_json(values.subspan(i * part, part), lengths.subspan(1)));
  }
  return json;
}

Json cell_json(const TableColumn& column, std::size_t cell) {
  const std::vector<CellValue>& values = column.cells[cell];
  return values.empty() ? Json(nullptr) : nested_json(values, column.lengths);
}

/// The members of a level's cell, and behind them the array of the next level.
void add_level(const TableView& table, std::size_t level, std::size_t cell, Json& json) {
  for (const TableColumn& column : table.columns) {
    if (column.level == level && column.is_in_json) json[column.name] = cell_json(column, cell);
  }
  if (level == table.dimensions.size() || table.dimensions[level].name.empty()) return;
  Json& rows = json[table.dimensions[level].name] = Json::array();
  for (std::size_t i = 0; i < table.dimensions[level].length; ++i) {
    Json row;
    add_level(table, level + 1, cell * table.dimensions[level].length + i, row);
    rows.push_back(std::move(row));
  }
}

}  // namespace

std::size_t TableView::count(std::size_t level) const {
  std::size_t cells = 1;
  for (std::size_t i = 0; i < level; ++i) cells *= dimensions[i].length;
  return cells;
}

const TableColumn& TableView::column(const std::string& column_name) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const TableColumn& c) { return c.name == column_name; });
  if (found == columns.end()) throw std::out_of_range(name + " has no column " + column_name);
  return *found;
}

std::string table_csv(const TableView& table) {
  std::string text;
  const char* separator = "";
  const auto add = [&](const std::string& field) {
    text += std::exchange(separator, ",") + csv_field(field);
  };
  const auto end_line = [&] {
    text += '\n';
    separator = "";
  };
  for (const TableColumn& column : table.columns) {
    if (!column.is_in_csv) continue;
    for (const std::string& part : column.parts) add(part);
  }
  end_line();
  for (std::size_t row = 0; row < table.count(table.dimensions.size()); ++row) {
    for (const TableColumn& column : table.columns) {
      if (!column.is_in_csv) continue;
      const std::vector<CellValue>& cell = column.cells[table.cell_of_row(column, row)];
      for (std::size_t part = 0; part < column.parts.size(); ++part) {
        add(cell.empty() ? "" : csv_text(cell[part]));
      }
    }
    end_line();
  }
  return text;
}

Json table_json(const TableView& table) {
  Json json = Json::object();
  add_level(table, 0, 0, json);
  return json;
}

Json row_json(const TableView& table, std::size_t row) {
  Json json;
  for (const TableColumn& column : table.columns) {
    if (column.level == 0 || !column.is_in_json) continue;
    json[column.name] = cell_json(column, table.cell_of_row(column, row));
  }
  return json;
}

}  // namespace hamjet::io
