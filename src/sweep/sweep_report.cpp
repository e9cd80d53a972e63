#include "sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "../report/drawing/study_figure.hpp"
#include "../store/csv_values.hpp"
#include "../store/json_text.hpp"
#include "../store/json_values.hpp"
#include "../store/sealed_summary.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "sweep_map.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

struct Counts {
  std::size_t done = 0;  ///< number of items with exit code 0
  std::size_t failed = 0;
  std::size_t missing = 0;
  std::map<int, std::size_t> by_exit_code;  ///< number of failed items by exit code
};

Counts count(const SweepRows& rows) {
  Counts counts;
  for (const auto& row : rows.rows) {
    if (!row) {
      ++counts.missing;
    } else if (row->exit_code == 0) {
      ++counts.done;
    } else {
      ++counts.failed;
      ++counts.by_exit_code[row->exit_code];
    }
  }
  return counts;
}

std::string csv_value(const SweepValue& value) {
  if (const bool* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const double* number = std::get_if<double>(&value)) return csv_number(*number);
  if (const std::string* text = std::get_if<std::string>(&value)) return csv_field(*text);
  return "";
}

/// The items with the least and the greatest number of a column.
struct Extremes {
  std::optional<std::size_t> least;
  std::optional<std::size_t> greatest;
  std::size_t numbers = 0;
};

Extremes extremes_of(const SweepRows& rows, std::size_t column) {
  Extremes extremes;
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    const auto value = sweep_number(rows.rows[i], column);
    if (!value) continue;
    ++extremes.numbers;
    const auto other = [&](std::size_t item) { return *sweep_number(rows.rows[item], column); };
    if (!extremes.least || *value < other(*extremes.least)) extremes.least = i;
    if (!extremes.greatest || *value > other(*extremes.greatest)) extremes.greatest = i;
  }
  return extremes;
}

Json place_json(const SweepStudy& study, const SweepRows& rows, std::size_t column,
                std::optional<std::size_t> item) {
  if (!item) return nullptr;
  Json set = Json::object();
  for (std::size_t k = 0; k < study.keys.size(); ++k) {
    if (!study.items[*item][k].empty()) set[study.keys[k].name] = study.items[*item][k];
  }
  return {{"item", *item}, {"value", *sweep_number(rows.rows[*item], column)}, {"set", set}};
}

std::string summary_of(const SweepStudy& study, const SweepRows& rows, const Counts& counts,
                       int exit_code) {
  Json json = {
      {"sweep", study.name},
      {"title", study.title},
      {"version", study.version},
      {"command", study.command},
      {"scene", study.scene},
      {"manifest_crc32", fmt::format("{:08x}", record_of("", sweep_manifest(study)).crc32)},
      {"items", study.items.size()},
      {"done", counts.done},
      {"failed", counts.failed},
      {"missing", counts.missing},
      {"damaged", rows.damaged},
      {"foreign", rows.foreign}};
  json["failed_by_exit_code"] = Json::object();
  for (const auto& [code, number] : counts.by_exit_code) {
    json["failed_by_exit_code"][std::to_string(code)] = number;
  }
  json["columns"] = Json::array();
  for (std::size_t c = 0; c < study.columns.size(); ++c) {
    const Extremes extremes = extremes_of(rows, c);
    json["columns"].push_back({{"name", study.columns[c].name},
                               {"unit", text_or_null(study.columns[c].unit)},
                               {"value", study.columns[c].pointer},
                               {"numbers", extremes.numbers},
                               {"least", place_json(study, rows, c, extremes.least)},
                               {"greatest", place_json(study, rows, c, extremes.greatest)}});
  }
  json["exit_code"] = exit_code;
  return json_text(json) + "\n";
}

std::string terminal_table(const SweepStudy& study, const SweepRows& rows, const Counts& counts) {
  std::string text =
      fmt::format("{}\n  {:<16} {}: {} done, {} failed, {} missing\n", study.title, "items",
                  study.items.size(), counts.done, counts.failed, counts.missing);
  for (const auto& [code, number] : counts.by_exit_code) {
    const auto first =
        std::find_if(rows.rows.begin(), rows.rows.end(),
                     [wanted = code](const auto& row) { return row && row->exit_code == wanted; });
    text += fmt::format("  {:<16} {}, the first is item {} ({}): {:.200}\n",
                        fmt::format("exit code {}", code), number, (*first)->item,
                        sweep_item_text(study, (*first)->item), (*first)->error);
  }
  if (rows.damaged > 0)
    text += fmt::format("  {:<16} {}\n", "damaged", counted(rows.damaged, "row"));
  if (rows.foreign > 0) {
    text += fmt::format("  {:<16} {} of another study\n", "foreign", counted(rows.foreign, "row"));
  }
  for (std::size_t c = 0; c < study.columns.size(); ++c) {
    const SweepColumn& column = study.columns[c];
    const Extremes extremes = extremes_of(rows, c);
    if (!extremes.least) continue;
    const auto part = [&](std::size_t item) {
      return fmt::format("{:.6g}{}{} at {}", *sweep_number(rows.rows[item], c),
                         column.unit.empty() ? "" : " ", column.unit, sweep_item_text(study, item));
    };
    text += fmt::format("  {:<16} from {}\n  {:<16} to   {}\n", column.name, part(*extremes.least),
                        "", part(*extremes.greatest));
  }
  return text;
}

}  // namespace

SweepRows read_sweep_rows(const SweepStudy& study, const SweepDirectory& directory) {
  SweepRows rows;
  rows.rows.reserve(study.items.size());
  for (std::size_t i = 0; i < study.items.size(); ++i) {
    auto state = SweepDirectory::RowState::missing;
    rows.rows.push_back(directory.read(i, &state));
    if (state == SweepDirectory::RowState::damaged) ++rows.damaged;
    if (state == SweepDirectory::RowState::foreign) ++rows.foreign;
  }
  return rows;
}

std::string sweep_csv(const SweepStudy& study, const SweepRows& rows) {
  std::string text = "item";
  for (const SweepKey& key : study.keys) text += "," + csv_field(key.name);
  for (const SweepColumn& column : study.columns) {
    text += "," + csv_field(column.unit.empty() ? column.name
                                                : fmt::format("{} ({})", column.name, column.unit));
  }
  text += ",exit_code,error\n";
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    const auto& row = rows.rows[i];
    text += std::to_string(i);
    for (const std::string& value : study.items[i])
      text += "," + csv_field(shown_sweep_value(value));
    for (std::size_t c = 0; c < study.columns.size(); ++c) {
      text += "," + (row ? csv_value(row->values[c]) : "");
    }
    text += row ? fmt::format(",{},{}\n", row->exit_code, csv_field(row->error)) : ",missing,\n";
  }
  return text;
}

StudyReport sweep_report(const SweepStudy& study, const SweepRows& rows) {
  const Counts counts = count(rows);
  StudyReport report;
  report.files = {{"table.csv", sweep_csv(study, rows)}};
  if (study.map) {
    const Chart chart = sweep_map(study, rows);
    std::string map = draw_figure({chart}, report.drawing_problem);
    if (!chart.missing.empty()) {
      report.drawing_problem =
          fmt::format("map.svg is left out: no item has a number{} in the column {}",
                      study.map->is_logarithmic ? " above 0" : "",
                      in_quotes(study.columns[study.map->value].name));
    }
    if (!map.empty()) report.files.push_back({"map.svg", std::move(map)});
  }
  if (counts.failed + counts.missing > 0) {
    report.exit_code = static_cast<int>(ErrorKind::check_failed);
    report.failure = fmt::format("of {} items {} failed and {} are missing; see table.csv{}",
                                 study.items.size(), counts.failed, counts.missing,
                                 counts.missing > 0 ? "; --resume computes what is missing" : "");
  }
  report.files.push_back({"summary.json", summary_of(study, rows, counts, report.exit_code)});
  report.table = terminal_table(study, rows, counts);
  return report;
}

}  // namespace hamjet::io
