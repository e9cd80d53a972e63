#include "hamjet/formats/stored_jet.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include "../scene/scene_samples.hpp"
#include "formats/hdf5/hdf5_jets.hpp"
#include "hamjet/formats/jet_file.hpp"
#include "hamjet/report/results.hpp"
#include "hamjet/version.hpp"
#include "jet_samples.hpp"
#include "support/temporary_directory.hpp"

// What the writer wrote comes back bit by bit; what is damaged is refused.

namespace hamjet::io {
namespace {

class StoredJetTest : public ::testing::Test {
 protected:
  PropagationResult store(const std::string& scene, const std::vector<Override>& overrides = {}) {
    PropagationResult result = propagate(parse_scene(scene, "scene.toml", overrides));
    OutputDirectory output(directory_);
    write_results(result, "", output);
    return result;
  }

  /// The results of `scene`, read back, must be what they were.
  void expect_round_trip(const std::string& scene, const std::vector<Override>& overrides = {}) {
    const PropagationResult result = store(scene, overrides);
    for (const RunResult& run : result.runs) {
      const StoredJet stored = read_stored_jet(directory_, run.settings.label);
      EXPECT_EQ(stored.scene, result.scene.name);
      EXPECT_EQ(stored.label, run.settings.label);
      EXPECT_EQ(stored.model, result.scene.system.model);
      EXPECT_EQ(stored.precision, result.scene.precision);
      EXPECT_EQ(stored.units.length_km, result.scene.units.length_km);
      EXPECT_EQ(stored.units.time_s, result.scene.units.time_s);
      EXPECT_EQ(stored.duration, result.scene.duration);
      EXPECT_EQ(stored.order(), result.scene.order);
      EXPECT_EQ(stored.nominal_initial, result.scene.nominal);
      EXPECT_EQ(stored.nominal_final, run.nominal_final);
      EXPECT_EQ(stored.components, result.problem.components);
      EXPECT_EQ(stored.variables, result.scene.variables);
      ASSERT_EQ(stored.jet.size(), run.jet.size());
      for (std::size_t c = 0; c < run.jet.size(); ++c) {
        ASSERT_EQ(stored.jet[c].size(), run.jet[c].size());
        for (std::size_t k = 0; k < run.jet[c].size(); ++k) {
          EXPECT_EQ(stored.jet[c][k], run.jet[c][k]) << c << " " << k;
        }
      }
    }
  }

  void expect_refused(const std::vector<std::string>& words,
                      ErrorKind kind = ErrorKind::input_output,
                      const std::optional<std::string>& label = {}) {
    expect_error([&] { read_stored_jet(directory_, label); }, kind, words, words[0]);
  }

  /// Expects an error while a file is damaged.
  void expect_damage(const std::string& file, const std::function<std::string(std::string)>& damage,
                     std::vector<std::string> words) {
    const std::string good = test::content(directory_ / file);
    test::put(directory_ / file, damage(good));
    words.push_back(file);
    expect_refused(words);
    test::put(directory_ / file, good);
  }

  const test::TemporaryDirectory temporary_;
  const std::filesystem::path directory_ = temporary_.path() / "results";
};

TEST_F(StoredJetTest, DoublePrecisionComesBackBitByBit) {
  expect_round_trip(planar_kepler);
  expect_round_trip(orbit, {{"reference", "null"}, {"generating_function", "null"}});
  expect_round_trip(oscillator);
}

TEST_F(StoredJetTest, ExtendedPrecisionComesBackBitByBit) {
  expect_round_trip(planar_kepler, {{"precision", "\"extended\""}});
}

TEST_F(StoredJetTest, APlaneHasFewerComponents) {
  // Exactly equatorial and not expanded in z, pz: the files hold x, y, px, py alone.
  expect_round_trip(planar_kepler, {{"jet.variables", "[\"x\", \"y\", \"px\", \"py\"]"}});
  const StoredJet stored = read_stored_jet(directory_);
  EXPECT_EQ(stored.components, (std::vector<std::size_t>{0, 1, 3, 4}));
  EXPECT_EQ(stored.variables, stored.components);
  EXPECT_EQ(stored.nominal_final[2], 0);
}

TEST_F(StoredJetTest, FewVariables) {
  expect_round_trip(planar_kepler, {{"jet.variables", "[\"x\", \"pz\"]"}});
  EXPECT_EQ(read_stored_jet(directory_).components.size(), 6U);
  EXPECT_EQ(read_stored_jet(directory_).variables, (std::vector<std::size_t>{0, 5}));
}

TEST_F(StoredJetTest, OrdersOneToSeven) {
  for (const char* order : {"1", "3", "5", "6", "7"}) {
    expect_round_trip(planar_kepler, {{"jet.order", order}, {"jet.duration_canonical", "0.2"}});
  }
}

// The same coefficients in another order make a valid file, but not the one that was written.
TEST_F(StoredJetTest, ChangesThatMakeSenseAreRefusedAllTheSame) {
  store(planar_kepler);
  const auto swap_halves = [](const std::string& text) {
    const std::size_t header = text.find('\n') + 1;
    const std::size_t middle = text.find('\n', text.size() / 2) + 1;
    return text.substr(0, header) + text.substr(middle) + text.substr(header, middle - header);
  };
  expect_damage("gauss8/jet.csv", swap_halves, {"was changed after it was written", "CRC-32"});
  const auto append_space = [](const std::string& text) { return text + " "; };
  expect_damage("summary.json", append_space, {"checksum is wrong or missing"});
  const auto change_steps = [](const std::string& text) {
    return changed(text, "\"rejected_steps\": ", "\"rejected_steps\": 1");
  };
  expect_damage("summary.json", change_steps, {"checksum is wrong or missing"});
  EXPECT_EQ(read_stored_jet(directory_).label, "gauss8");
}

TEST_F(StoredJetTest, ChoosesTheRun) {
  store(planar_kepler);
  EXPECT_EQ(read_stored_jet(directory_).label, "gauss8");
  EXPECT_EQ(read_stored_jet(directory_, "midpoint").label, "midpoint");
  expect_refused({"no run has the label midpiont", "did you mean midpoint?"}, ErrorKind::usage,
                 "midpiont");
}

TEST_F(StoredJetTest, ARunThatFailedHasNoJet) {
  // A fall into the centre, which no integrator can follow to its end.
  store(planar_kepler, {{"nominal.velocity_km_s", "[0, 0, 0]"}, {"jet.duration_canonical", "3"}});
  expect_refused({"gauss8 has no result"}, ErrorKind::input_output, "gauss8");
  const auto json = nlohmann::json::parse(test::content(directory_ / "summary.json"));
  if (json["runs"][1]["error"].is_null()) {
    EXPECT_EQ(read_stored_jet(directory_).label, "midpoint");
  } else {
    expect_refused({"summary.json: runs: no run has a result"});
  }
}

TEST_F(StoredJetTest, DamagedCoefficients) {
  store(planar_kepler);
  using Text = std::string;
  const Text csv = "gauss8/jet.csv";
  const auto line = [](const Text& text, int number) {
    std::size_t start = 0;
    for (int i = 1; i < number; ++i) start = text.find('\n', start) + 1;
    return text.substr(start, text.find('\n', start) + 1 - start);
  };
  const auto in_line = [&](int number, const Text& from, const Text& to) {
    return [=](const Text& text) {
      const Text old = line(text, number);
      return changed(text, old, changed(old, from, to));
    };
  };
  const auto coefficient = [&](const Text& value) {
    return [=](const Text& text) {
      const Text old = line(text, 5);
      return changed(text, old, old.substr(0, old.rfind(',') + 1) + value + "\n");
    };
  };
  // Order 2 in 6 variables: 28 coefficients for each of 6 components, after the header.
  expect_damage(csv, [](const Text&) { return ""; }, {":1: the header"});
  expect_damage(csv, [](const Text& t) { return t.substr(t.find('\n') + 1); }, {":1: the header"});
  expect_damage(csv, in_line(1, "e_z", "e_Z"), {":1: the header", "must be"});
  expect_damage(csv, [](const Text& t) { return t.substr(0, t.size() / 2); }, {"cut off"});
  expect_damage(csv, [](const Text& t) { return t.substr(0, t.size() - 1); },
                {":169: the line is cut off"});
  expect_damage(csv, [&](const Text& t) { return t.substr(0, t.rfind('\n', t.size() - 2) + 1); },
                {"167 coefficients, must have 168", "order 2 in 6 variables"});
  expect_damage(csv, [&](const Text& t) { return changed(t, line(t, 9), ""); },
                {"167 coefficients, must have 168"});
  expect_damage(csv, [&](const Text& t) { return t + line(t, 9); },
                {"169 coefficients, must have 168"});
  expect_damage(csv, [&](const Text& t) { return changed(t, line(t, 9), line(t, 8)); },
                {":9: the same coefficient as in line 8"});
  for (const char* bad : {"nan", "inf", "-inf", "1e400", "", "x", "1.0x", "1,0", "0x1p3"}) {
    expect_damage(csv, coefficient(bad), {":5:"});
  }
  expect_damage(csv, in_line(9, ",2,", ",3,"), {":9: e_x: must be an exponent", "order 2"});
  expect_damage(csv, in_line(9, ",2,", ",-2,"), {":9: e_x: must be an exponent"});
  expect_damage(csv, in_line(9, ",2,0,", ",2,1,"), {":9: the exponents add up to 3"});
  expect_damage(csv, in_line(9, "x,", "w,"), {":9: component", "\"w\""});
  expect_damage(csv, in_line(9, ",2,0,", ",2,"), {":9: has 7 columns, must have 8"});
  // The first row is the nominal's final state, which the summary holds too.
  expect_damage(csv,
                [&](const Text& t) {
                  const Text old = line(t, 2);
                  return changed(t, old, old.substr(0, old.rfind(',')) + ",0.25\n");
                },
                {"nominal_final: the x is not that of", "different runs"});
  std::filesystem::remove(directory_ / csv);
  expect_refused({csv, "cannot be read", "No such file"});
  std::filesystem::create_directory(directory_ / csv);
  expect_refused({csv, "cannot be read", "directory"});
}

TEST_F(StoredJetTest, DamagedExtendedCoefficients) {
  store(planar_kepler, {{"precision", "\"extended\""}});
  for (const char* bad :
       {"nan", "inf", "1e999999999999", "1e6000", "", "-", "1e", "1.5.5", " 1", "1e+-5", "+1"}) {
    expect_damage("gauss8/jet.csv",
                  [&](const std::string& text) {
                    const std::size_t end = text.rfind('\n', text.size() - 2);
                    return text.substr(0, end + 1) + "pz,0,0,0,0,0,2," + bad + "\n";
                  },
                  {":169: coefficient"});
  }
}

TEST_F(StoredJetTest, ExponentsOfWhatTheJetIsNotExpandedIn) {
  store(planar_kepler, {{"jet.variables", "[\"x\", \"y\", \"px\", \"py\"]"}});
  expect_damage("gauss8/jet.csv",
                [](const std::string& text) { return changed(text, "x,0,1,0,", "x,0,0,1,"); },
                {"e_z: must be 0, for the jet is not expanded in z"});
}

TEST_F(StoredJetTest, DamagedSummary) {
  store(planar_kepler);
  using nlohmann::json;
  const std::string file = "summary.json";
  expect_damage(file, [](const std::string&) { return ""; }, {"line 1: is not valid JSON"});
  expect_damage(file, [](const std::string&) { return "[]"; }, {"must be an object"});
  expect_damage(file, [](const std::string& t) { return t.substr(0, t.size() / 2); },
                {"line ", "is not valid JSON"});
  expect_damage(file,
                [](const std::string& t) { return changed(t, "\"order\": 2", "\"order\": 1e999"); },
                {"out of range"});
  const auto edited = [&](const std::function<void(json&)>& edit,
                          const std::vector<std::string>& words) {
    expect_damage(
        file,
        [&](const std::string& text) {
          json value = json::parse(text);
          edit(value);
          return value.dump(2);
        },
        words);
  };
  for (const char* key :
       {"scene", "version", "model", "precision", "units", "order", "variables", "components",
        "coefficients_per_component", "duration_canonical", "nominal_initial", "runs"}) {
    edited([&](json& j) { j.erase(key); }, {std::string(key) + ": is missing"});
    edited([&](json& j) { j[key] = nullptr; }, {key, ": must be"});
  }
  for (const char* key : {"label", "error", "nominal_final"}) {
    edited([&](json& j) { j["runs"][0].erase(key); },
           {std::string("runs[0].") + key + ": is missing"});
  }
  edited([](json& j) { j["version"] = "0.0.1"; },
         {"version: the results are of hamjet 0.0.1, this is " + std::string(version)});
  edited([](json& j) { j["study"] = "optimal-control"; }, {"study", "no flow jet"});
  edited([](json& j) { j["model"] = "kelper"; }, {"model: must be one of the known names"});
  edited([](json& j) { j["order"] = 3; }, {"coefficients_per_component", "order 3 in 6"});
  edited([](json& j) { j["order"] = -2; }, {"coefficients_per_component"});
  edited([](json& j) { j["units"]["time_s"] = -1; }, {"units.time_s: must be positive"});
  edited([](json& j) { j["nominal_initial"].erase(0); }, {"nominal_initial: must have 6 numbers"});
  edited([](json& j) { j["nominal_initial"][2] = "nan"; }, {"nominal_initial[2]: must be finite"});
  edited([](json& j) { j["variables"][0] = "y"; }, {"variables: must ascend"});
  edited([](json& j) { j["components"].erase(0); }, {"variables: must be among the components"});
  edited([](json& j) { j["runs"][0]["label"] = "../gauss8"; }, {"runs[0].label", "folder"});
  edited([](json& j) { j["runs"] = json::array(); }, {"runs: no run has a result"});
  edited([](json& j) { j["runs"][0]["nominal_final"][1] = 0.5; }, {"different runs"});
  std::filesystem::remove(directory_ / file);
  expect_refused({file, "cannot be read", "No such file"});
}

// Two gigabytes in place of some kilobytes (a file with a hole, which takes no room) are refused by
// the file's size.
TEST_F(StoredJetTest, TheSizeIsLookedAtBeforeTheFileIsRead) {
  constexpr std::uintmax_t two_gigabytes = std::uintmax_t{2} << 30;
  store(planar_kepler);
  const auto file = directory_ / "gauss8/jet.csv";
  const std::string good = test::content(file);
  std::filesystem::resize_file(file, two_gigabytes);
  expect_refused({"gauss8/jet.csv: was changed after it was written: 2147483648 bytes, must be"});
  test::put(file, good);
  for (const char* name : {"other.dace", "other.csv", "other.h5"}) {
    const auto other = directory_ / "gauss8" / name;
    test::put(other, "");
    std::filesystem::resize_file(other, two_gigabytes);
    if (std::string(name) == "other.h5" && !hdf5_available()) continue;
    expect_error([&] { read_jet_file(other); }, ErrorKind::too_large,
                 {name, "too large, got 2147483648 bytes, must be at most 1073741824"}, name);
  }
  std::filesystem::resize_file(directory_ / "summary.json", two_gigabytes);
  expect_refused({"summary.json", "too large, got 2147483648 bytes, must be at most 268435456"},
                 ErrorKind::too_large);
}

TEST_F(StoredJetTest, ADamagedOrderTakesNoMemory) {
  store(planar_kepler);
  auto json = nlohmann::json::parse(test::content(directory_ / "summary.json"));
  json["order"] = 60;
  json["coefficients_per_component"] = 90858768;
  test::put(directory_ / "summary.json", json.dump());
  expect_refused({"gauss8/jet.csv:169: the file ends after 168 coefficients, must have 545152608"});
}

}  // namespace
}  // namespace hamjet::io
