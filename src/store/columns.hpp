#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "csv_values.hpp"

namespace hamjet::io {

/// A column of a table: its name, and the text of its cell in a row, empty where there is no value.
template <class Row>
struct Column {
  std::string name;
  std::function<std::string(const Row&)> cell;
};

/// The columns of a table, from which its header and its rows are written.
template <class Row>
class Columns {
 public:
  using Cell = std::function<std::string(const Row&)>;

  void add(std::string name, Cell cell) { columns_.push_back({std::move(name), std::move(cell)}); }
  /// Adds a column that is empty in the rows for which `has` is false.
  void add_if(const std::function<bool(const Row&)>& has, std::string name, Cell cell) {
    add(std::move(name), [has, cell = std::move(cell)](const Row& row) {
      return has(row) ? cell(row) : std::string();
    });
  }

  /// The header and the rows as RFC 4180 has them, each line ended by a line feed.
  std::string csv(const std::vector<Row>& rows) const {
    std::string text;
    const auto end_field = [&](std::size_t i) { text += i + 1 < columns_.size() ? ',' : '\n'; };
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      text += csv_field(columns_[i].name);
      end_field(i);
    }
    for (const Row& row : rows) {
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        text += csv_field(columns_[i].cell(row));
        end_field(i);
      }
    }
    return text;
  }

 private:
  std::vector<Column<Row>> columns_;
};

}  // namespace hamjet::io
