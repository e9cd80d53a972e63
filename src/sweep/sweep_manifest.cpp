#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "../store/json_reader.hpp"
#include "../store/json_values.hpp"
#include "../store/sealed_summary.hpp"
#include "hamjet/error.hpp"
#include "sweep_study.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

/// A list of values or nulls on one line; one a line would be easier to read, and ten times as
/// long.
std::string compact_list(const std::vector<std::string>& values) {
  Json json = Json::array();
  for (const std::string& value : values) json.push_back(text_or_null(value));
  return json.dump();
}

}  // namespace

std::string sweep_manifest(const SweepStudy& study) {
  Json json = {{"sweep_schema", 1},
               {"study", study.name},
               {"title", study.title},
               {"version", study.version},
               {"command", study.command},
               {"scene", study.scene},
               {"scene_text", study.scene_text}};
  json["set"] = Json::array();
  for (const Override& constant : study.constants) {
    json["set"].push_back({constant.key, constant.value});
  }
  json["columns"] = Json::array();
  for (const SweepColumn& column : study.columns) {
    json["columns"].push_back(
        {{"name", column.name}, {"unit", column.unit}, {"value", column.pointer}});
  }
  json["map"] = nullptr;
  if (study.map) {
    json["map"] = {{"x", study.map->x},
                   {"y", study.map->y},
                   {"value", study.map->value},
                   {"logarithmic", study.map->is_logarithmic}};
  }
  json["grid"] = study.is_grid;
  json["keys"] = Json::array();
  for (const SweepKey& key : study.keys) {
    json["keys"].push_back({{"name", key.name}, {"logarithmic", key.is_logarithmic}});
  }
  std::string text = json.dump(2);
  text.resize(text.find_last_not_of("\n }") + 1);
  text += ",\n  \"items\": [";
  for (std::size_t i = 0; i < study.items.size(); ++i) {
    text += fmt::format("{}\n    {}", i == 0 ? "" : ",", compact_list(study.items[i]));
  }
  return seal(text + "\n  ]\n}\n", {});
}

SweepStudy parse_sweep_manifest(const std::string& text, const std::string& file) {
  if (!is_sealed(text)) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: is not what hamjet wrote: it was changed or cut", file));
  }
  const nlohmann::json parsed = JsonReader::parse(text, file);
  const JsonReader json(parsed, file);
  if (json.at("sweep_schema").integer<int>() != 1) {
    json.at("sweep_schema").fail("is of another version of hamjet, must be 1");
  }
  SweepStudy study;
  study.name = json.at("study").text();
  study.title = json.at("title").text();
  study.version = json.at("version").text();
  study.command = sweep_commands()[json.at("command").one_of<std::size_t>(sweep_commands())];
  study.scene = json.at("scene").text();
  study.scene_text = json.at("scene_text").text();
  for (const auto& constant : json.at("set").list([](const JsonReader& pair) {
         return pair.list([](const JsonReader& text_of) { return text_of.text(); });
       })) {
    study.constants.push_back({constant.at(0), constant.at(1)});
  }
  study.columns = json.at("columns").list([](const JsonReader& column) {
    return SweepColumn{column.at("name").text(), column.at("unit").text(),
                       column.at("value").text()};
  });
  study.is_grid = json.at("grid").boolean();
  study.keys = json.at("keys").list([](const JsonReader& key) {
    return SweepKey{key.at("name").text(), key.at("logarithmic").boolean()};
  });
  study.items = json.at("items").list([](const JsonReader& item) {
    return item.list([](const JsonReader& value) { return value.text_or_empty(); });
  });
  if (!json.at("map").is_null()) {
    const JsonReader map = json.at("map");
    study.map = SweepMap{map.at("x").integer<std::size_t>(), map.at("y").integer<std::size_t>(),
                         map.at("value").integer<std::size_t>(), map.at("logarithmic").boolean()};
  }
  return study;
}

}  // namespace hamjet::io
