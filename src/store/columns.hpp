#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "csv_values.hpp"

namespace hamjet::io {

/// What a cell of a table holds: nothing, yes or no, a number, or a text.
using CellValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

/// A number, a text or an optional one as a cell holds it.
template <class Value>
CellValue cell_value(const Value& value) {
  if constexpr (std::is_same_v<Value, CellValue> || std::is_same_v<Value, bool>) {
    return value;
  } else if constexpr (std::is_integral_v<Value>) {
    return static_cast<std::int64_t>(value);
  } else if constexpr (std::is_floating_point_v<Value>) {
    return static_cast<double>(value);
  } else if constexpr (requires { value.has_value(); }) {
    return value ? cell_value(*value) : CellValue();
  } else {
    return std::string(std::string_view(value));
  }
}

/// A value as CSV has it, empty where there is none.
inline std::string csv_text(const CellValue& value) {
  return std::visit(
      []<class Value>(const Value& held) -> std::string {
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return {};
        } else if constexpr (std::is_same_v<Value, double>) {
          return csv_number(held);
        } else {
          return fmt::format("{}", held);
        }
      },
      value);
}

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
