#include "sweep_tables.hpp"

#include "sweep_study.hpp"

namespace hamjet::io {
namespace {

ValueForm spacing_or_scale() { return form::choice({"linear", "logarithmic"}); }

const TableDescription& sweep_table() {
  static const TableDescription table = {
      {{"scene", form::text(), absent::refused(), "the base scene's file, relative to the study"},
       {"command", form::choice(sweep_commands()), absent::refused(),
        "what is done with each item"},
       {"set", form::words("keys of the scene"), absent::other("none"),
        "changes that all items share, as `--set` takes them"}}};
  return table;
}

const TableDescription& axis_table() {
  static const TableDescription table = {
      {{"key", form::text(), absent::refused(), "key of the scene, as `--set` takes it"},
       {"values", form::words("array of values, each once"), absent::other("`from`, `to`, `count`"),
        "the values, in this order"},
       {"from", form::number(), absent::other("`values`"), "the first value"},
       {"to", form::number(), absent::other("required by `from`"),
        "the last value, which differs from the first"},
       {"count", form::integer(2, static_cast<double>(most_sweep_items)),
        absent::other("required by `from`"), "number of values, both ends included"},
       {"spacing", spacing_or_scale(), absent::value("linear"),
        "logarithmic: equal ratios, of values above 0"}}};
  return table;
}

const TableDescription& column_table() {
  static const TableDescription table = {
      {{"name", form::text(), absent::refused(),
        "name of the column; no other column or key has it"},
       {"unit", form::text(), absent::other("none"), "unit that is shown beside the name"},
       {"value", form::words("JSON pointer"), absent::refused(),
        "where the value stands in `summary.json`"}}};
  return table;
}

const TableDescription& map_table() {
  static const TableDescription table = {
      {{"x", form::words("a key of the items, of numbers"), absent::refused(), "the axis across"},
       {"y", form::words("another one"), absent::refused(), "the axis up"},
       {"value", form::words("the name of a column"), absent::refused(), "what the colours show"},
       {"scale", spacing_or_scale(), absent::value("linear"), "scale of the colours"}}};
  return table;
}

}  // namespace

const TableDescription& sweep_study_table() {
  static const TableDescription table = {joined<SceneKey>(
      {head_keys(),
       {{"sweep", form::table(sweep_table()), absent::refused(), "the scene and what is done"},
        {"axis", form::array(form::table(axis_table())), absent::other("`[[item]]`"),
         "the items are all combinations, the last axis changing fastest"},
        {"item", form::words("tables with keys of the scene"), absent::other("`[[axis]]`"),
         "the items as a list"},
        {"column", form::array(form::table(column_table())), absent::refused(),
         "what is taken of each item's results"},
        {"map", form::table(map_table()), absent::other("none"), "a picture over two keys"}}})};
  return table;
}

}  // namespace hamjet::io
