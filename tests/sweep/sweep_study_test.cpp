#include <gtest/gtest.h>

#include "hamjet/error.hpp"
#include "support/errors.hpp"
#include "support/text.hpp"
#include "sweep/sweep_items.hpp"
#include "sweep/sweep_tables.hpp"
#include "sweep_samples.hpp"

namespace hamjet::io {
namespace {

using namespace hamjet::test;

class SweepStudies : public ::testing::Test {
 protected:
  SweepStudies() { write_text(directory_.path() / "base.toml", sweep_scene); }

  SweepStudy study(const std::string& text) const {
    return read_sweep_study(write_text(directory_.path() / "study.toml", text));
  }

  /// The study with one text in place of another one.
  static std::string with(const std::string& from, const std::string& to) {
    return changed(sweep_study, from, to);
  }

  /// The study must be refused with one line that holds the words.
  void expect_refused(const std::string& text, ErrorKind kind,
                      const std::vector<std::string>& words) const {
    expect_error([&] { check_sweep_items(study(text)); }, kind, words, words.front());
  }

  TemporaryDirectory directory_;
};

TEST_F(SweepStudies, AGridIsAllCombinationsTheLastAxisFastest) {
  const SweepStudy grid = study(sweep_study);
  ASSERT_EQ(grid.items.size(), 12U);
  EXPECT_EQ(grid.items[0], (std::vector<std::string>{"0", "0"}));
  // The value is 0.3 and not 0.30000000000000004, which 0.9 / 3 is in binary64.
  EXPECT_EQ(grid.items[5], (std::vector<std::string>{"0.3", "90.5"}));
  EXPECT_EQ(grid.items[11], (std::vector<std::string>{"0.9", "90.5"}));
  const auto overrides = sweep_overrides(grid, 4);
  ASSERT_EQ(overrides.size(), 3U);
  EXPECT_EQ(overrides[0].key, "jet.order");
  EXPECT_EQ(overrides[0].value, "1");
  EXPECT_EQ(overrides[1].key, "nominal.e");
  EXPECT_EQ(overrides[2].value, "30");
}

TEST_F(SweepStudies, TheKeysAreWhatTheTablesDeclare) {
  int checks = 0;
  const auto check_table = [&](const TableDescription& table, const std::string& header) {
    for (const SceneKey& key : table.keys) {
      const std::string name(key.name);
      const std::string text = "\n" + std::string(sweep_study);
      const std::size_t line = text.find('\n' + name + " = ", text.find(header));
      if (line == std::string::npos) continue;
      const std::size_t value = line + name.size() + 4;
      const std::size_t end = text.find('\n', value);
      const auto refuse = [&](const std::string& changed_text, const std::string& problem) {
        SCOPED_TRACE(header + name);
        ++checks;
        expect_refused(changed_text, ErrorKind::scene, {"study.toml:", name + ": " + problem});
      };
      if (key.absence.meaning == Absence::Meaning::refused) {
        refuse(text.substr(0, line) + text.substr(end), "missing");
      }
      if (key.form.has_range()) {
        const std::string below = std::to_string(static_cast<long>(key.form.least) - 1);
        refuse(text.substr(0, value) + below + text.substr(end), "out of range");
      }
      if (!key.form.choices.empty()) {
        refuse(text.substr(0, value) + "\"other\"" + text.substr(end), "unknown value");
      }
    }
  };
  check_table(sweep_study_table(), "\nschema");
  for (const auto& [key, header] : {std::pair("sweep", "[sweep]"), std::pair("axis", "[[axis]]"),
                                    std::pair("column", "[[column]]"), std::pair("map", "[map]")}) {
    check_table(*sweep_study_table().find(key)->form.table, header);
  }
  // schema twice (below and above its range), scene, command twice, an axis's key and count, a
  // column's name and value, and of the map x, y, value and scale.
  EXPECT_EQ(checks, 12);
}

TEST_F(SweepStudies, SchemaAndTitleHaveTheDefaultsOfScenes) {
  const SweepStudy bare = study(with("schema = 1\ntitle = \"twelve orbits\"\n", ""));
  EXPECT_EQ(bare.title, "study");
  EXPECT_EQ(bare.items.size(), 12U);
}

TEST_F(SweepStudies, KeysStandApart) {
  expect_refused(with("key = \"nominal.i_deg\"\nvalues = [0, 30, 90.5]",
                      "key = \"nominal\"\nvalues = [{e = 0.1}, {e = 0.2}]"),
                 ErrorKind::scene, {"axis.1.key: a part of another key", "\"nominal.e\""});
}

TEST_F(SweepStudies, NamesOfColumnsArePrintable) {
  expect_refused(with("name = \"x_final\"", "name = \"x\\u001b[31m\""), ErrorKind::scene,
                 {"column.1.name: a control character"});
  expect_refused(with("unit = \"length\"", "unit = \"a\\nb\""), ErrorKind::scene,
                 {"column.1.unit: a control character"});
}

TEST_F(SweepStudies, LogarithmicSpacingGivesDecades) {
  const SweepStudy decades =
      study(with("from = 0.0\nto = 0.9\ncount = 4",
                 "from = 1e-3\nto = 1e3\ncount = 7\nspacing = \"logarithmic\""));
  const std::vector<std::string> expected = {"0.001", "0.01", "0.1", "1", "10", "100", "1000"};
  ASSERT_EQ(decades.items.size(), 21U);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(decades.items[3 * i][0], expected[i]);
  EXPECT_TRUE(decades.keys[0].is_logarithmic);
}

TEST_F(SweepStudies, AListMayHaveOtherKeysInEachItem) {
  std::string text = sweep_study;
  text.resize(text.find("[[axis]]"));
  text += R"([[item]]
nominal.e = 0.2
nominal.i_deg = 45
[[item]]
"nominal.e" = 0.25
integrator.gauss8.stages = 6
generating_function.kinds = ["F1", "F2"]
[[item]]
generating_function = "null"
nominal.e = 0
precision = "extended"
[[column]]
name = "x"
value = "/runs/0/nominal_final/0"
)";
  const SweepStudy list = study(text);
  const std::vector<std::string> names = {"nominal.e",
                                          "nominal.i_deg",
                                          "integrator.gauss8.stages",
                                          "generating_function.kinds",
                                          "generating_function",
                                          "precision"};
  ASSERT_EQ(list.keys.size(), names.size());
  for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(list.keys[k].name, names[k]);
  ASSERT_EQ(list.items.size(), 3U);
  EXPECT_EQ(list.items[0], (std::vector<std::string>{"0.2", "45", "", "", "", ""}));
  EXPECT_EQ(list.items[1][2], "6");
  EXPECT_EQ(list.items[2][4], "null");
  EXPECT_EQ(sweep_overrides(list, 0).size(), 3U);
  EXPECT_EQ(sweep_item_text(list, 2),
            "nominal.e = 0, generating_function = null, "
            "precision = extended");
  // The array is read back as TOML, the table is gone where its value is null.
  EXPECT_EQ(parse_scene(list.scene_text, "base.toml", sweep_overrides(list, 1)).kinds->size(), 2U);
  EXPECT_FALSE(parse_scene(list.scene_text, "base.toml", sweep_overrides(list, 2)).kinds);
  EXPECT_EQ(parse_scene(list.scene_text, "base.toml", sweep_overrides(list, 2)).precision,
            Precision::extended);
}

TEST_F(SweepStudies, AManifestHoldsTheWholeStudy) {
  const SweepStudy original = study(sweep_study);
  const std::string manifest = sweep_manifest(original);
  const SweepStudy copy = parse_sweep_manifest(manifest, "manifest.json");
  EXPECT_EQ(sweep_manifest(copy), manifest);
  EXPECT_EQ(copy.scene_text, sweep_scene);
  EXPECT_EQ(copy.items, original.items);
  EXPECT_EQ(copy.map->value, original.map->value);
  // A change of a value, a column or a letter of the scene gives another manifest.
  for (const auto& [from, to] : {std::pair("count = 4", "count = 5"),
                                 {"90.5", "90.25"},
                                 {"nominal_final/0", "nominal_final/1"},
                                 {"order = 1", "order = 2"}}) {
    EXPECT_NE(sweep_manifest(study(with(from, to))), manifest) << to;
  }
  write_text(directory_.path() / "base.toml", sweep_scene + "\n");
  EXPECT_NE(sweep_manifest(study(sweep_study)), manifest);
}

TEST_F(SweepStudies, ADamagedManifestIsRefused) {
  const std::string manifest = sweep_manifest(study(sweep_study));
  for (std::size_t i = 0; i < manifest.size(); i += 37) {
    std::string cut = manifest.substr(0, i);
    std::string flipped = manifest;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    EXPECT_THROW(parse_sweep_manifest(cut, "manifest.json"), Error) << i;
    EXPECT_THROW(parse_sweep_manifest(flipped, "manifest.json"), Error) << i;
  }
}

TEST_F(SweepStudies, MistakesAreNamedWithTheirPlace) {
  const auto scene = ErrorKind::scene;
  expect_refused(sweep_scene, scene, {"study.toml:1:1: sweep: missing"});
  expect_refused(with("schema = 1", "schema = 2"), scene, {"study.toml:1:10: schema"});
  expect_refused(with("command = \"run\"", "command = \"rnu\""), scene,
                 {"study.toml:5:11: sweep.command", "did you mean run?"});
  expect_refused(with("[sweep.set]", "[sweep.sett]"), scene,
                 {"study.toml:6:", "sweep.sett: unknown key", "did you mean set?"});
  expect_refused(with("count = 4", "count = 1"), scene, {"study.toml:12:9: axis.0.count"});
  expect_refused(with("to = 0.9", "to = 0"), scene, {"study.toml:11:6: axis.0.to", "the same"});
  expect_refused(with("from = 0.0", "from = 0.0\nspacing = \"logarithmic\""), scene,
                 {"study.toml:10:8: axis.0.from: not positive, got 0.0"});
  expect_refused(with("[0, 30, 90.5]", "[]"), scene, {"study.toml:15:10: axis.1.values"});
  expect_refused(with("[0, 30, 90.5]", "[0, 30, 0]"), scene,
                 {"study.toml:15:18: axis.1.values.2: there twice, got 0"});
  expect_refused(with("[0, 30, 90.5]", "[1]\ncount = 3"), scene,
                 {"study.toml:16:9: axis.1.count: beside values"});
  expect_refused(with("key = \"nominal.i_deg\"", "key = \"nominal.e\""), scene,
                 {"study.toml:14:7: axis.1.key: there twice"});
  expect_refused(with("key = \"nominal.e\"", "key = \"jet.order\""), scene,
                 {"study.toml:9:7: axis.0.key: there twice", "sweep.set"});
  expect_refused(with("value = \"/runs/0", "value = \"runs/0"), scene,
                 {"study.toml:22:9: column.1.value: not a JSON pointer"});
  expect_refused(with("name = \"x_final\"", "name = \"condition\""), scene,
                 {"study.toml:20:8: column.1.name: there twice"});
  expect_refused(with("value = \"condition\"", "value = \"conditon\""), scene,
                 {"study.toml:26:9: map.value", "did you mean condition?"});
  expect_refused(with("\ny = \"nominal.i_deg\"", "\ny = \"nominal.e\""), scene,
                 {"study.toml:25:5: map.y: the same as x"});
  const std::string more =
      "[0, 1]\n[[axis]]\nkey = \"nominal.raan_deg\"\nfrom = 0\nto = 1\ncount = 500\n"
      "[[axis]]\nkey = \"nominal.argp_deg\"\nfrom = 0\nto = 1\ncount = 500";
  expect_refused(with("[0, 30, 90.5]", more), ErrorKind::too_large,
                 {"axis: too many items, got 2000000, must be at most 1000000"});
  expect_refused(with("base.toml", "bse.toml"), ErrorKind::input_output, {"bse.toml"});
}

TEST_F(SweepStudies, AMisspeltKeyIsNamedInTheStudy) {
  std::string text = with("key = \"nominal.e\"", "key = \"nominal.ecc\"");
  text.resize(text.find("[map]"));
  expect_refused(text, ErrorKind::scene, {"study.toml:9:7: axis.0.key: nominal.ecc: unknown key"});
  text = with("jet.order = 1", "jet.odrer = 1");
  expect_refused(text, ErrorKind::scene,
                 {"study.toml", "sweep.set: jet.odrer: unknown key", "did you mean order?"});
  text = with("jet.order = 1", "integrator.gauss7.stages = 4");
  expect_refused(text, ErrorKind::scene, {"sweep.set: integrator.gauss7.stages: no such element"});
}

}  // namespace
}  // namespace hamjet::io
