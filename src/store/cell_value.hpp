#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "csv_values.hpp"

namespace hamjet::io {

/// What a cell of a table holds: nothing, yes or no, a number, or a text.
using CellValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

/// What the cells of a column hold.
enum class CellKind { number, count, flag, text };

/// A value that may be missing, as std::optional has it.
template <class Value>
concept MayLack = requires(const Value& value) {
  value.has_value();
  *value;
};

/// A number, a text or an optional one as a cell holds it.
template <class Value>
CellValue cell_value(const Value& value) {
  if constexpr (std::is_same_v<Value, CellValue> || std::is_same_v<Value, bool>) {
    return value;
  } else if constexpr (std::is_integral_v<Value>) {
    return static_cast<std::int64_t>(value);
  } else if constexpr (std::is_floating_point_v<Value>) {
    return static_cast<double>(value);
  } else if constexpr (MayLack<Value>) {
    return value ? cell_value(*value) : CellValue();
  } else {
    return std::string(std::string_view(value));
  }
}

/// The kind of the cells that hold such values.
template <class Value>
constexpr CellKind cell_kind() {
  if constexpr (std::is_same_v<Value, bool>) {
    return CellKind::flag;
  } else if constexpr (std::is_integral_v<Value>) {
    return CellKind::count;
  } else if constexpr (std::is_floating_point_v<Value>) {
    return CellKind::number;
  } else if constexpr (MayLack<Value>) {
    return cell_kind<std::remove_cvref_t<decltype(*std::declval<const Value&>())>>();
  } else {
    static_assert(!std::is_same_v<Value, CellValue>, "a column's cells are all of one kind");
    return CellKind::text;
  }
}

/// A cell's text in CSV; empty for a cell without a value.
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

}  // namespace hamjet::io
