#pragma once

#include <functional>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "table_view.hpp"

namespace hamjet::io {

/// A table of results, of which every column is declared once: by what it is called, its unit, what
/// it means, and its value in a row. Files, pages and Python read the view.
template <class Row>
class ResultTable {
 public:
  /// `dimensions` are the names of what the rows run over, the last one fastest.
  ResultTable(std::string name, std::string place, std::vector<std::string> dimensions,
              std::string meaning)
      : view_{std::move(name), std::move(meaning), std::move(place), {}, {}} {
    for (std::string& dimension : dimensions) view_.dimensions.push_back({std::move(dimension)});
  }

  /// `value` gives, for a row, what cell_value takes; a pointer to a member will do. What is
  /// returned is good until the next column is added.
  template <class Value>
  TableColumn& add(std::string name, std::string unit, std::string meaning, Value value) {
    using Held = std::remove_cvref_t<std::invoke_result_t<Value, const Row&>>;
    cells_.push_back([value = std::move(value)](const Row& row) {
      return std::vector<CellValue>{held(cell_value(std::invoke(value, row)))};
    });
    return add_column<Held>(std::move(name), std::move(unit), std::move(meaning),
                            view_.dimensions.size());
  }
  /// Adds a column that holds nothing in the rows for which `has` is false.
  template <class Has, class Value>
  TableColumn& add_if(Has has, std::string name, std::string unit, std::string meaning,
                      Value value) {
    using Held = std::remove_cvref_t<std::invoke_result_t<Value, const Row&>>;
    cells_.push_back([has = std::move(has), value = std::move(value)](const Row& row) {
      return std::vector<CellValue>{
          std::invoke(has, row) ? held(cell_value(std::invoke(value, row))) : CellValue()};
    });
    TableColumn& column = add_column<Held>(std::move(name), std::move(unit), std::move(meaning),
                                           view_.dimensions.size());
    column.may_lack = true;
    return column;
  }
  /// Adds a column of arrays, whose entries have a column each in CSV with the name of a part.
  /// `value` gives as many entries as there are parts, or an optional of them.
  template <class Value>
  TableColumn& add_array(std::string name, std::vector<std::string> parts, std::string unit,
                         std::string meaning, Value value) {
    using Given = std::remove_cvref_t<std::invoke_result_t<Value, const Row&>>;
    cells_.push_back(
        [value = std::move(value)](const Row& row) { return array_cell(std::invoke(value, row)); });
    TableColumn& column = add_column<Entry<Given>>(std::move(name), std::move(unit),
                                                   std::move(meaning), view_.dimensions.size());
    column.may_lack |= MayLack<Given>;
    column.lengths = {parts.size()};
    column.parts = std::move(parts);
    return column;
  }
  /// Adds the columns of another table that are in rows, each a part of a row here.
  template <class Part, class PartOf>
  void add_columns(ResultTable<Part> other, PartOf part_of) {
    for (std::size_t i = 0; i < other.view_.columns.size(); ++i) {
      TableColumn& column = view_.columns.emplace_back(std::move(other.view_.columns[i]));
      column.level = view_.dimensions.size();
      cells_.push_back([cell = std::move(other.cells_[i]), part_of](const Row& row) {
        return cell(std::invoke(part_of, row));
      });
    }
  }
  /// Rows are no array of summary.json.
  void leave_rows_out_of_json() { view_.has_rows_in_json = false; }
  /// Leaves only these columns in CSV.
  void keep_in_csv(const std::set<std::string>& names) {
    for (TableColumn& column : view_.columns) column.is_in_csv = names.contains(column.name);
  }
  /// Adds a number, text or flag of the whole result, which CSV has not.
  template <class Value>
  TableColumn& add_scalar(std::string name, std::string unit, std::string meaning,
                          const Value& value) {
    return add_single<Value>(std::move(name), std::move(unit), std::move(meaning),
                             {held(cell_value(value))});
  }
  /// Adds an array of the whole result, which CSV has not.
  template <class Values>
  TableColumn& add_scalars(std::string name, std::string unit, std::string meaning,
                           const Values& values) {
    std::vector<CellValue> cell = array_cell(values);
    const std::size_t length = cell.size();
    TableColumn& column = add_single<Entry<Values>>(std::move(name), std::move(unit),
                                                    std::move(meaning), std::move(cell));
    // What is not there has no length either.
    if constexpr (MayLack<Values>) {
      if (!values) return column;
    }
    column.lengths = {length};
    return column;
  }

  /// The table with these rows, as many as the product of the dimensions' lengths.
  TableView view(const std::vector<Row>& rows, const std::vector<std::size_t>& lengths) && {
    for (std::size_t i = 0; i < lengths.size(); ++i) view_.dimensions[i].length = lengths[i];
    if (rows.size() != view_.count(lengths.size())) {
      throw std::logic_error(view_.name + ": not as many rows as its dimensions have");
    }
    for (std::size_t i = 0; i < view_.columns.size(); ++i) {
      TableColumn& column = view_.columns[i];
      if (column.level == 0) continue;
      const std::size_t count = view_.count(column.level);
      for (std::size_t cell = 0; cell < count; ++cell) {
        column.cells.push_back(cells_[i](rows[cell * (rows.size() / count)]));
      }
    }
    return std::move(view_);
  }

 private:
  template <class>
  friend class ResultTable;

  /// What an array, or an optional one, is made of.
  template <class Given>
  struct EntryOf {
    using type = std::remove_cvref_t<decltype(*std::begin(std::declval<const Given&>()))>;
  };
  template <MayLack Given>
  struct EntryOf<Given> : EntryOf<std::remove_cvref_t<decltype(*std::declval<const Given&>())>> {};
  template <class Given>
  using Entry = typename EntryOf<Given>::type;

  /// A text without characters says nothing.
  static CellValue held(CellValue value) {
    const auto* text = std::get_if<std::string>(&value);
    return text != nullptr && text->empty() ? CellValue() : value;
  }

  template <class Given>
  static std::vector<CellValue> array_cell(const Given& given) {
    std::vector<CellValue> cell;
    if constexpr (MayLack<Given>) {
      if (given) return array_cell(*given);
    } else {
      for (const auto& entry : given) cell.push_back(held(cell_value(entry)));
    }
    return cell;
  }

  template <class Held>
  TableColumn& add_column(std::string name, std::string unit, std::string meaning,
                          std::size_t level) {
    TableColumn column{std::move(name), std::move(unit), std::move(meaning), cell_kind<Held>()};
    column.may_lack = MayLack<Held>;
    column.level = level;
    column.parts = {column.name};
    return view_.columns.emplace_back(std::move(column));
  }
  template <class Held>
  TableColumn& add_single(std::string name, std::string unit, std::string meaning,
                          std::vector<CellValue> cell) {
    cells_.push_back({});
    TableColumn& column = add_column<Held>(std::move(name), std::move(unit), std::move(meaning), 0);
    column.is_in_csv = false;
    column.cells = {std::move(cell)};
    return column;
  }

  TableView view_;
  /// The function that makes the cells of each column.
  std::vector<std::function<std::vector<CellValue>(const Row&)>> cells_;
};

}  // namespace hamjet::io
