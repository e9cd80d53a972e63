#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "../../scene/document/scene_document.hpp"
#include "../../scene/document/scene_text.hpp"
#include "../../scene/scene_name.hpp"
#include "../../scene/scene_sections.hpp"
#include "../../store/text_file.hpp"
#include "../../text/scene_message.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/studies/self_check_settings.hpp"
#include "hamjet/error.hpp"
#include "stability_report.hpp"

namespace hamjet::io {
namespace {

/// Numbers from decimal texts, which may have more digits than binary64.
std::vector<Extended> decimals(const TableReader& table, std::string_view key) {
  constexpr std::string_view digits = "0123456789";
  const std::vector<std::string> texts = table.texts(key);
  std::vector<Extended> values;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const bool has_digits = texts[i].find_first_of(digits) != std::string::npos &&
                            texts[i].find_first_not_of("0123456789+-.eE") == std::string::npos;
    try {
      if (!has_digits) throw std::runtime_error("not a number");
      values.emplace_back(texts[i]);
    } catch (const std::runtime_error&) {
      table.fail_element(
          key, i, fmt::format("not a number, got {}, must be decimal digits", in_quotes(texts[i])));
    }
  }
  return values;
}

GrowthExpectation read_growth(const TableReader& growth) {
  growth.check_keys();
  GrowthExpectation expected;
  growth.read_if_any("checkpoints", expected.checkpoints);
  growth.read_if_any("samples", expected.samples);
  if (growth.has("times")) expected.times = growth.numbers("times");
  if (growth.has("states")) {
    if (expected.times.empty()) growth.fail("states", "without times, must stand beside times");
    expected.states = decimals(growth, "states");
  }
  growth.read_if_any("error_exponent", expected.error_exponent);
  growth.read_if_any("energy_exponent", expected.energy_exponent);
  if (growth.has("coefficient_exponents")) {
    expected.coefficient_exponents = growth.numbers("coefficient_exponents");
  }
  growth.read_if_any("exponent_tolerance", expected.exponent_tolerance);
  return expected;
}

ConditionExpectation read_condition(const TableReader& condition) {
  condition.check_keys();
  return {condition.text("kind"), condition.number("value")};
}

/// The scene with the changes of the twin, `key = value` each as with --set.
Scene read_twin(const TableReader& twin, std::string_view text, const std::string& file) {
  twin.check_keys();
  std::vector<Override> overrides;
  for (const std::string& change : twin.texts("set")) {
    const std::size_t equals = change.find('=');
    if (equals == std::string::npos) {
      twin.fail("set", fmt::format("not a change, got {}, must be key=value", in_quotes(change)));
    }
    overrides.push_back({change.substr(0, equals), change.substr(equals + 1)});
  }
  return parse_scene(text, file, overrides);
}

void read_right(const TableReader& table, std::string_view text, const std::string& file,
                StabilityExpectation& expected) {
  expected.source = table.text("source");
  if (table.has("state")) expected.state = decimals(table, "state");
  if (table.has("matrix")) expected.matrix = decimals(table, "matrix");
  table.read_if_any("tolerance", expected.tolerance);
  table.read_if_any("round_trip", expected.round_trip);
  if (table.has("condition")) expected.condition = read_condition(table.table("condition"));
  if (table.has("growth")) expected.growth = read_growth(table.table("growth"));
  if (table.has("twin")) expected.twin = read_twin(table.table("twin"), text, file);
}

StabilityExpectation read_expectation(const TableReader& table, std::string_view text,
                                      const std::string& file) {
  StabilityExpectation expected;
  expected.outcome = static_cast<CaseOutcome>(table.choice("outcome"));
  const bool is_refused = expected.outcome == CaseOutcome::refused;
  const bool is_marked = expected.outcome == CaseOutcome::marked;
  table.check_keys({case_table().names_of(table.text("outcome"))});
  if (is_refused) {
    expected.exit_code = static_cast<int>(table.integer("exit_code"));
    expected.message = table.text("message");
    if (expected.message.empty()) table.fail("message", "empty, must be a part of the error");
    return expected;
  }
  if (is_marked) {
    expected.mark = self_check_names()[table.choice("mark")];
  }
  const std::vector<std::string_view> others = case_table().names_not_of("refused");
  const bool has_reference = std::any_of(others.begin(), others.end(), [&](std::string_view key) {
    return key != "mark" && table.has(key);
  });
  if (!is_marked || has_reference) read_right(table, text, file, expected);
  return expected;
}

StabilityCase read_case(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string text = read_scene_file(path);
  const SceneDocument document = parse_document(text, printable_path(path), {});
  const TableReader root(document.table, "", document.source, &all_studies().front().top);
  const TableReader table = root.table("case");
  StabilityCase subject{
      path.stem().string(),
      root.has("title") ? printable(root.text("title"), std::string::npos) : default_title(file),
      table.text("group"),
      table.text("why"),
      read_expectation(table, text, file),
      Scene{}};
  try {
    subject.scene = parse_scene(text, file);
  } catch (const Error& error) {
    subject.scene = error;
  }
  return subject;
}

}  // namespace

std::vector<StabilityCase> read_stability_suite(const std::filesystem::path& suite) {
  std::error_code error;
  if (!std::filesystem::is_directory(suite, error)) return {read_case(suite)};
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(suite, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == ".toml") files.push_back(entry->path());
  }
  const std::string name = printable_path(suite);
  if (error) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: cannot be read: {}", name, error.message()));
  }
  if (files.empty()) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: has no case, must be a folder of scenes (*.toml) with a table "
                            "[case]",
                            name));
  }
  std::sort(files.begin(), files.end());
  std::vector<StabilityCase> cases;
  for (const auto& file : files) cases.push_back(read_case(file));
  return cases;
}

}  // namespace hamjet::io
