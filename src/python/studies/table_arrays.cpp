#include "table_arrays.hpp"

#include <pybind11/stl.h>

#include <cstdint>
#include <span>

#include "../../report/declared_tables.hpp"
#include "../arrays.hpp"

namespace hamjet::python {
namespace {

using io::CellKind;
using io::CellValue;

bool is_there(const CellValue& value) { return !std::holds_alternative<std::monostate>(value); }

double number_of(const CellValue& value) {
  if (const auto* count = std::get_if<std::int64_t>(&value)) return static_cast<double>(*count);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1 : 0;
  return is_there(value) ? std::get<double>(value) : none;
}

py::object object_of(const CellValue& value) {
  return std::visit(
      []<class Value>(const Value& held) -> py::object {
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return py::none();
        } else {
          return py::cast(held);
        }
      },
      value);
}

/// The values as tuples in tuples of this shape.
py::object tuples_of(std::span<const CellValue> values, std::span<const py::ssize_t> shape) {
  if (shape.empty()) return object_of(values.front());
  py::tuple tuple(shape[0]);
  const std::size_t part = shape[0] == 0 ? 0 : values.size() / static_cast<std::size_t>(shape[0]);
  for (py::ssize_t i = 0; i < shape[0]; ++i) {
    tuple[static_cast<std::size_t>(i)] =
        tuples_of(values.subspan(static_cast<std::size_t>(i) * part, part), shape.subspan(1));
  }
  return tuple;
}

py::object array_of_values(const io::TableColumn& column, const std::vector<CellValue>& values,
                           const std::vector<py::ssize_t>& shape) {
  if (column.kind == CellKind::text) return tuples_of(values, shape);
  if (column.kind == CellKind::count && !column.may_lack) {
    std::vector<std::int64_t> counts;
    for (const CellValue& value : values) counts.push_back(std::get<std::int64_t>(value));
    return python::array_of(std::move(counts), shape);
  }
  if (column.kind == CellKind::flag && !column.may_lack) {
    std::vector<bool> truths;
    for (const CellValue& value : values) truths.push_back(std::get<bool>(value));
    return flags(truths, shape);
  }
  std::vector<double> numbers;
  for (const CellValue& value : values) numbers.push_back(number_of(value));
  return python::array_of(std::move(numbers), shape);
}

py::object column_object(const io::TableView& table, const io::TableColumn& column) {
  if (column.level == 0 && !column.is_array()) {
    const CellValue& value = column.cells.front().front();
    // An absent number is NaN, as it is in arrays.
    return column.kind == CellKind::number ? py::float_(number_of(value)) : object_of(value);
  }
  std::vector<py::ssize_t> shape;
  for (std::size_t i = 0; i < column.level; ++i) {
    shape.push_back(size_of(table.dimensions[i].length));
  }
  std::size_t parts = 1;
  for (const std::size_t length : column.lengths) {
    shape.push_back(size_of(length));
    parts *= length;
  }
  std::vector<CellValue> values;
  for (const std::vector<CellValue>& cell : column.cells) {
    if (cell.empty()) values.insert(values.end(), parts, CellValue());
    values.insert(values.end(), cell.begin(), cell.end());
  }
  return array_of_values(column, values, shape);
}

}  // namespace

py::dict columns_of_tables(const std::vector<io::TableView>& tables) {
  py::dict all;
  for (const io::TableView& table : tables) {
    py::dict columns;
    for (const io::TableColumn& column : table.columns) {
      columns[py::str(column.name)] = column_object(table, column);
    }
    all[py::str(table.name)] = columns;
  }
  return all;
}

py::dict rows_of_tables(const std::vector<io::TableView>& tables) {
  py::dict all;
  for (const io::TableView& table : tables) {
    py::dict rows;
    const std::size_t count = table.count(table.dimensions.size());
    for (const io::TableColumn& column : table.columns) {
      if (!column.is_in_csv) continue;
      for (std::size_t part = 0; part < column.parts.size(); ++part) {
        std::vector<CellValue> values;
        for (std::size_t row = 0; row < count; ++row) {
          const std::vector<CellValue>& cell = column.cells[table.cell_of_row(column, row)];
          values.push_back(cell.empty() ? CellValue() : cell[part]);
        }
        rows[py::str(column.parts[part])] = array_of_values(column, values, {size_of(count)});
      }
    }
    all[py::str(table.name)] = rows;
  }
  return all;
}

py::dict declarations() {
  py::dict all;
  for (const io::TableView& table : io::declared_tables()) {
    py::dict columns;
    for (const io::TableColumn& column : table.columns) {
      py::list dimensions;
      for (std::size_t i = 0; i < column.level; ++i) dimensions.append(table.dimensions[i].name);
      for (const std::size_t length : column.lengths) dimensions.append(length);
      columns[py::str(column.name)] =
          py::make_tuple(column.unit, column.meaning, py::tuple(dimensions));
    }
    all[py::str(table.name)] = columns;
  }
  return all;
}

}  // namespace hamjet::python
