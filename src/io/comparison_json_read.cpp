#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "hamjet/error.hpp"
#include "hamjet/io/comparison_report.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::input_output, fmt::format("compare.json: {}: {}", path, what));
}

/// A value of the file together with its place in it, for messages.
class Value {
 public:
  Value(const Json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  Value at(const char* key) const {
    if (!json_->is_object()) fail(path_, "must be an object");
    const auto found = json_->find(key);
    const std::string path = path_.empty() ? key : path_ + "." + key;
    if (found == json_->end()) fail(path, "is missing");
    return {*found, path};
  }

  bool is_null() const { return json_->is_null(); }

  double number() const {
    if (json_->is_number()) return json_->get<double>();
    if (json_->is_string()) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      const auto& text = json_->get_ref<const std::string&>();
      if (text == "inf") return infinity;
      if (text == "-inf") return -infinity;
      if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
    }
    fail(path_, "must be a number, \"inf\", \"-inf\" or \"nan\"");
  }

  template <class Integer>
  Integer integer() const {
    if (!json_->is_number_integer()) fail(path_, "must be an integer");
    // Both representations that the parser has are compared without conversion.
    const bool is_unsigned = json_->is_number_unsigned();
    if (is_unsigned ? !std::in_range<Integer>(json_->get<std::uint64_t>())
                    : !std::in_range<Integer>(json_->get<std::int64_t>())) {
      fail(path_, "is out of range");
    }
    return json_->get<Integer>();
  }

  bool boolean() const {
    if (!json_->is_boolean()) fail(path_, "must be true or false");
    return json_->get<bool>();
  }

  std::string text() const {
    if (!json_->is_string()) fail(path_, "must be a string");
    return json_->get<std::string>();
  }

  std::string text_or_empty() const { return is_null() ? std::string() : text(); }

  std::optional<double> optional_number() const {
    return is_null() ? std::nullopt : std::optional(number());
  }

  template <class Read>
  auto list(Read read) const {
    if (!json_->is_array()) fail(path_, "must be an array");
    std::vector<decltype(read(*this))> values;
    values.reserve(json_->size());
    for (std::size_t i = 0; i < json_->size(); ++i) {
      values.push_back(read(Value((*json_)[i], fmt::format("{}[{}]", path_, i))));
    }
    return values;
  }

  std::vector<double> numbers() const {
    return list([](const Value& value) { return value.number(); });
  }

  /// The enumerator whose name this is.
  template <class Enumeration>
  Enumeration one_of(const std::vector<std::string_view>& names) const {
    const auto found = std::find(names.begin(), names.end(), text());
    if (found == names.end()) fail(path_, "must be one of the known names");
    return static_cast<Enumeration>(found - names.begin());
  }

 private:
  const Json* json_;
  std::string path_;
};

IntegratorSettings read_settings(const Value& value) {
  IntegratorSettings settings;
  settings.label = value.at("label").text();
  settings.method = value.at("method").one_of<IntegrationMethod>(method_names());
  settings.stages = value.at("stages").integer<int>();
  settings.order = value.at("order").integer<int>();
  settings.beta = value.at("beta").number();
  settings.step_canonical = value.at("step_canonical").optional_number();
  settings.tolerance = value.at("tolerance").optional_number();
  settings.require_relative_error = value.at("require_relative_error").optional_number();
  settings.require_symplecticity = value.at("require_symplecticity").optional_number();
  return settings;
}

IntegrationStatistics read_statistics(const Value& value) {
  IntegrationStatistics statistics;
  statistics.steps = value.at("steps").integer<long>();
  statistics.rejected_steps = value.at("rejected_steps").integer<long>();
  statistics.vector_field_evaluations = value.at("vector_field_evaluations").integer<long>();
  statistics.nominal_evaluations = value.at("nominal_evaluations").integer<long>();
  statistics.wall_seconds = value.at("wall_seconds").number();
  return statistics;
}

ExactnessResidual read_residual(const Value& value) {
  return {value.at("degree").integer<int>(), value.at("absolute").number(),
          value.at("scaled").number(), value.at("at_formation_scale").optional_number()};
}

ExactnessEntry read_exactness(const Value& value) {
  ExactnessEntry entry{read_residual(value), std::nullopt};
  const Value floor = value.at("floor");
  if (!floor.is_null()) entry.floor = read_residual(floor);
  return entry;
}

SymplecticityDefect read_symplecticity(const Value& value) {
  return {value.at("degree").integer<int>(), value.at("absolute").number(),
          value.at("scaled").number()};
}

ComparedRun read_run(const Value& value) {
  ComparedRun run;
  run.settings = read_settings(value.at("settings"));
  run.series = value.at("series").text();
  run.order = value.at("order").integer<int>();
  run.failure = value.at("failure").text_or_empty();
  run.left_out = value.at("left_out").text_or_empty();
  run.statistics = read_statistics(value.at("statistics"));
  run.multiply_adds = value.at("multiply_adds").number();
  run.memory_bytes = value.at("memory_bytes").number();
  run.seconds = value.at("seconds").numbers();
  run.error_by_degree = value.at("error_by_degree").numbers();
  run.error_at_formation_m = value.at("error_at_formation_m").number();
  run.exactness = value.at("exactness").list(read_exactness);
  run.exactness_failure = value.at("exactness_failure").text_or_empty();
  run.symplecticity = value.at("symplecticity").list(read_symplecticity);
  run.energy_error = value.at("energy_error").number();
  const Value corner = value.at("corner");
  if (!corner.is_null()) run.corner = corner.one_of<Corner>(corner_names());
  return run;
}

RunAlongTime read_along_time(const Value& value) {
  RunAlongTime run;
  run.label = value.at("label").text();
  run.failure = value.at("failure").text_or_empty();
  run.points = value.at("points").list([](const Value& point) {
    return RunAlongTime::Point{point.at("time_canonical").number(),
                               point.at("exactness").optional_number(),
                               point.at("condition").number(), point.at("energy_error").number()};
  });
  run.singular_times = value.at("singular_times_canonical").numbers();
  return run;
}

Json parse(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    fail(fmt::format("byte {}", error.byte), "is not valid JSON");
  } catch (const Json::exception&) {
    // A number beyond the range of a double is refused by another exception than a wrong character.
    fail("a number", "is out of range");
  }
}

}  // namespace

EarlierRuns read_comparison_runs(std::string_view text) {
  const Json json = parse(text);
  if (!json.is_object()) fail("the file", "must be an object");
  const Value root(json, "");
  if (root.at("schema").integer<int>() != 1) {
    fail("schema", "must be 1: the file is of another version");
  }
  EarlierRuns earlier;
  earlier.determinants = root.at("determinants").text();
  earlier.is_complete = root.at("complete").boolean();
  earlier.runs = root.at("runs").list(read_run);
  earlier.cost_runs = root.at("cost_runs").list(read_run);
  earlier.along_time = root.at("along_time").list(read_along_time);
  return earlier;
}

}  // namespace hamjet::io
