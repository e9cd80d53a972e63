#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cell_value.hpp"

namespace hamjet::io {

/// A column of a table: its name, and the value of its cell in a row.
template <class Row>
struct Column {
  std::string name;
  std::function<CellValue(const Row&)> value;
};

/// The columns of a table, from which its header and its rows are written.
template <class Row>
class Columns {
 public:
  /// `value` gives, for a row, what cell_value takes; a pointer to a member will do.
  template <class Value>
  void add(std::string name, Value value) {
    columns_.push_back({std::move(name), [value = std::move(value)](const Row& row) {
                          return cell_value(std::invoke(value, row));
                        }});
  }
  /// Adds a column that is empty in the rows for which `has` is false.
  template <class Has, class Value>
  void add_if(Has has, std::string name, Value value) {
    columns_.push_back(
        {std::move(name), [has = std::move(has), value = std::move(value)](const Row& row) {
           return std::invoke(has, row) ? cell_value(std::invoke(value, row)) : CellValue();
         }});
  }

  bool has(std::string_view name) const {
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](const Column<Row>& column) { return column.name == name; });
  }

  /// The header and the rows as RFC 4180 has them, each line ended by a line feed.
  std::string csv(const std::vector<Row>& rows) const {
    std::string text;
    const auto add_line = [&](const auto& field) {
      const char* separator = "";
      for (const Column<Row>& column : columns_) {
        text += std::exchange(separator, ",") + csv_field(field(column));
      }
      text += '\n';
    };
    add_line([](const Column<Row>& column) { return column.name; });
    for (const Row& row : rows) {
      add_line([&](const Column<Row>& column) { return csv_text(column.value(row)); });
    }
    return text;
  }

 private:
  std::vector<Column<Row>> columns_;
};

}  // namespace hamjet::io
