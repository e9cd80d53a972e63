#include "sweep_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "hamjet/algebra/extended.hpp"
#include "sweep_study.hpp"

namespace hamjet::io {
namespace {

void add_flat_keys(const toml::table& table, const std::string& path,
                   std::vector<std::pair<std::string, const toml::node*>>& keys) {
  for (const auto& [key, node] : table) {
    const std::string name =
        path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str());
    const toml::table* inner = node.as_table();
    if (inner != nullptr && !inner->empty()) {
      add_flat_keys(*inner, name, keys);
    } else {
      keys.emplace_back(name, &node);
    }
  }
}

/// The decimal number that stands in the study.
Extended decimal(double value) { return Extended(fmt::format("{}", value)); }

std::vector<std::string> spaced_values(const TableReader& axis, bool is_logarithmic,
                                       std::size_t most_values) {
  const double from = axis.number("from");
  const double to = axis.number("to");
  const auto count = axis.integer_between("count", 2, static_cast<std::int64_t>(most_values));
  if (from == to) axis.fail("to", "the same as from, must be another number");
  for (const char* end : {"from", "to"}) {
    if (is_logarithmic && !(axis.number(end) > 0)) {
      axis.fail(end, fmt::format("not positive, got {}, must be a number above 0 where spacing is "
                                 "logarithmic",
                                 axis.found(end)));
    }
  }
  const Extended first = decimal(from);
  const Extended last = decimal(to);
  std::vector<std::string> values;
  for (std::int64_t k = 0; k < count; ++k) {
    const Extended fraction = Extended(k) / Extended(count - 1);
    const Extended value =
        is_logarithmic ? first * pow(last / first, fraction) : first + (last - first) * fraction;
    values.push_back(fmt::format("{}", convert<double>(value)));
  }
  values.back() = fmt::format("{}", to);
  return values;
}

}  // namespace

std::string override_text(const toml::node& value) {
  if (const auto* integer = value.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* number = value.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* text = value.as_string(); text != nullptr && text->get() == "null") return "null";
  std::ostringstream text;
  value.visit([&](const auto& typed) { text << toml::toml_formatter(typed); });
  return text.str();
}

std::vector<std::pair<std::string, const toml::node*>> flat_keys(const toml::table& table) {
  std::vector<std::pair<std::string, const toml::node*>> keys;
  add_flat_keys(table, "", keys);
  std::stable_sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) {
    return a.second->source().begin < b.second->source().begin;
  });
  return keys;
}

std::vector<std::string> axis_values(const TableReader& axis, const toml::table& table,
                                     std::size_t most_values) {
  axis.check_keys();
  const bool is_list = axis.exactly_one_of({"values", "from"}) == "values";
  if (!is_list) {
    return spaced_values(axis, axis.has("spacing") && axis.choice("spacing") == 1, most_values);
  }
  for (const char* key : {"to", "count", "spacing"}) {
    if (axis.has(key)) axis.fail(key, "beside values, must stand beside from");
  }
  const toml::array* array = table.get_as<toml::array>("values");
  if (array == nullptr || array->empty()) {
    axis.fail("values", fmt::format("not a list, got {}, must be an array of values, at least one",
                                    axis.found("values")));
  }
  std::vector<std::string> values;
  for (std::size_t i = 0; i < array->size(); ++i) {
    values.push_back(override_text((*array)[i]));
    if (std::count(values.begin(), values.end(), values.back()) > 1) {
      axis.fail_element("values", i, fmt::format("there twice, got {}", values.back()));
    }
  }
  return values;
}

}  // namespace hamjet::io
