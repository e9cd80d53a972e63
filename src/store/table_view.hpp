#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cell_value.hpp"

namespace hamjet::io {

/// A column of a table of results with all that is said of it, and its cells.
struct TableColumn {
  std::string name;     ///< name in CSV, JSON and Python
  std::string unit;     ///< "m/s"; empty for what has none
  std::string meaning;  ///< a phrase that says what it is
  CellKind kind = CellKind::number;
  bool may_lack = false;  ///< whether a cell may hold nothing
  /// On how many of the table's dimensions it depends; cells of fewer are repeated in CSV, and one
  /// of none is a number of the whole result.
  std::size_t level = 0;
  /// The names in CSV of what a cell holds, where that is an array, which is nested as `lengths`
  /// say.
  std::vector<std::string> parts = {};
  std::vector<std::size_t> lengths = {};
  bool is_in_csv = true;
  bool is_in_json = true;
  /// Of each cell what it holds, the last part running fastest; empty where it holds nothing.
  std::vector<std::vector<CellValue>> cells = {};

  bool is_array() const { return !lengths.empty(); }
};

/// A dimension of a table: its name in the plural, under which JSON has an array of it, and its
/// length.
struct TableDimension {
  std::string name;
  std::size_t length = 0;
};

/// A table of results as files, pages and Python read it. Its rows run over the dimensions, the
/// last one fastest.
struct TableView {
  std::string name;  ///< name of the CSV file and of the table in Python
  std::string meaning;
  /// A JSON pointer into summary.json, where the columns without dimension are members, and the
  /// rows an array with the name of the dimension.
  std::string place;
  std::vector<TableDimension> dimensions;
  std::vector<TableColumn> columns;
  bool has_rows_in_json = true;
  /// Rows that stand by themselves in summary.json, by JSON pointers.
  std::vector<std::pair<std::size_t, std::string>> places_of_rows = {};

  /// How many cells a column of a level has, and which of them a row shows.
  std::size_t count(std::size_t level) const;
  std::size_t cell_of_row(const TableColumn& column, std::size_t row) const {
    return row / (count(dimensions.size()) / count(column.level));
  }
  /// Throws std::out_of_range for a name that no column has.
  const TableColumn& column(const std::string& name) const;
};

/// The table as CSV of RFC 4180, each line ended by a line feed.
std::string table_csv(const TableView& table);
/// The columns without dimension as members, and behind them the rows, nested by dimension.
nlohmann::ordered_json table_json(const TableView& table);
/// What a cell of a column holds, null where that is nothing.
nlohmann::ordered_json cell_json(const TableColumn& column, std::size_t cell);
/// One row's columns as members, but those without dimension.
nlohmann::ordered_json row_json(const TableView& table, std::size_t row);

}  // namespace hamjet::io
