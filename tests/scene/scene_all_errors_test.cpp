#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "scene/study_reader.hpp"
#include "scene_samples.hpp"

// All errors of a scene are printed together: one line for each, in the order of the scene's lines,
// and no error that only follows from another.

namespace hamjet::io {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The lines of the message; empty if the scene is good.
std::vector<std::string> errors_of(const std::string& scene, ErrorKind kind = ErrorKind::scene,
                                   const std::vector<Override>& overrides = {}) {
  try {
    parse_study(scene, "file.toml", overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return lines_of(error.what());
  }
  return {};
}

/// Expects as many lines as there are words; each line contains its word.
void expect_lines(const std::vector<std::string>& said, const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& line : said) all += line + "\n";
  ASSERT_EQ(said.size(), words.size()) << all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    EXPECT_NE(said[i].find(words[i]), std::string::npos) << all << "line lacks " << words[i];
  }
}

TEST(AllErrors, AreALineEachInTheOrderOfTheLines) {
  std::string scene = orbit;
  scene = changed(scene, "title = \"orbit\"", "title = 3");
  scene = changed(scene, "J2 = 1e-3", "J2 = 10");
  scene = changed(scene, "order = 4", "order = 2.5");
  scene = changed(scene, "stages = 8", "stages = 99");
  scene = changed(scene, "separation_km = 10", "separation_km = -10");
  scene = changed(scene, "kinds = [\"F1\"]", "kind = [\"F1\"]");
  expect_lines(errors_of(scene), {"file.toml:2:9: title: wrong type, got 3, must be a string",
                                  "file.toml:7:6: system.J2: out of range, got 10",
                                  "file.toml:12:9: jet.order: wrong type, got 2.5",
                                  "file.toml:17:10: integrator.0.stages: out of range, got 99",
                                  "file.toml:24:17: formation.separation_km: not positive",
                                  "generating_function.kind: unknown key"});
  // If the start and the jet are known, the integrators can be checked too.
  scene = changed(changed(orbit, "stages = 8", "stages = 99"), "step_canonical = 0.01", "");
  expect_lines(errors_of(scene), {"file.toml:17:10: integrator.0.stages: out of range",
                                  "integrator.1: missing, got none of a choice"});
}

TEST(AllErrors, OneTableHasSeveral) {
  std::string scene = changed(orbit, "order = 4", "oder = 4\nzzz = 1\nduration_s = \"long\"");
  expect_lines(errors_of(scene),
               {"file.toml:12:1: jet.oder: unknown key, got oder, did you mean order?",
                "file.toml:13:1: jet.zzz: unknown key, got zzz, must be one of",
                "file.toml:14:14: jet.duration_s: wrong type"});
  // Missing keys are named beside unknown ones, except for those that an unknown key may stand for.
  scene = changed(changed(oscillator, "position_m = [1]", "zzz = 1"), "momentum_kg_m_s = [0]", "");
  expect_lines(errors_of(scene),
               {"nominal.momentum_kg_m_s: missing, must be an array", "nominal.zzz: unknown key"});
  scene = changed(orbit, "separation_km = 10", "seperation_km = 10");
  expect_lines(errors_of(scene), {"formation.seperation_km: unknown key"});
  // Keys of orbits are checked as soon as the model is known.
  scene = changed(changed(orbit, "duration_canonical = 31.4", "duration_orbits = true"),
                  "398600.4415", "0");
  expect_lines(errors_of(scene),
               {"system.mu_km3_s2: not positive", "jet.duration_orbits: wrong type"});
  // An orbit needs all its elements.
  scene = changed(orbit, "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n",
                  "a_km = -7000\ni_deg = 200\nraan_deg = 0\n");
  expect_lines(
      errors_of(scene),
      {"nominal.e: missing beside a_km", "nominal.argp_deg: missing",
       "nominal: missing, got none of a choice, must be exactly one of: ta_deg",
       "file.toml:9:8: nominal.a_km: not positive", "file.toml:10:9: nominal.i_deg: out of range"});
}

TEST(AllErrors, WhatFollowsFromAnotherIsNotSaid) {
  expect_lines(errors_of(changed(orbit, "[system]", "[sytem]")), {"sytem: unknown key"});
  expect_lines(errors_of(changed(orbit, "J2 = 1e-3", "J21 = 1")), {"J21: unknown key"});
  // Keys of another model are not suggested, even if another error hides the model's own keys.
  const auto said =
      errors_of(changed(changed(orbit, "J2 = 1e-3", "zzz = 1"), "mu_km3_s2 = ", "mu_km3_s2 = -"));
  expect_lines(said, {"system.mu_km3_s2: not positive", "system.zzz: unknown key"});
  for (const std::string& line : said) EXPECT_EQ(line.find("mass_kg"), std::string::npos) << line;
  expect_lines(errors_of(changed(orbit, "[jet]", "[je]")), {"file.toml:11:2: je: unknown key"});
  expect_lines(errors_of(changed(orbit, "separation_km", "separation_m")),
               {"formation.separation_m: the model zonal-gravity has no key separation_m"});
  expect_lines(errors_of(changed(orbit, "zonal-gravity", "zonal")),
               {"system.model: unknown value"});
  expect_lines(errors_of(changed(orbit, "[7000, 0, 0]", "[0, 0, 0]")), {"at the centre"});
  expect_lines(errors_of(changed(orbit, "duration_canonical", "duration_cannonical")),
               {"did you mean duration_canonical?"});
  expect_lines(errors_of(changed(orbit, "schema = 1", "schema = 2\nlabel = \"of a later format\"")),
               {"schema: out of range, got 2"});
}

TEST(AllErrors, TheTablesOfAMisspeltStudyAreNotJudged) {
  expect_lines(errors_of("stuyd = \"optimal-control\"\n[optimal_control]\nproblem = 1\n"),
               {"file.toml:1:1: stuyd: unknown key, got stuyd, did you mean study?"});
}

TEST(AllErrors, AtMostTwentyAreSaid) {
  std::string scene = orbit;
  for (int i = 0; i < 23; ++i) scene += "unknown" + std::to_string(i) + " = 1\n";
  const auto said = errors_of(scene);
  ASSERT_EQ(said.size(), 21U);
  EXPECT_NE(said[19].find("reference.unknown19: unknown key"), std::string::npos) << said[19];
  EXPECT_EQ(said[20], "and 3 more");
}

TEST(AllErrors, OfOverridesComeLastAndTheKindIsThatOfAScene) {
  const std::string scene = changed(orbit, "separation_km = 10", "separation_km = -10");
  expect_lines(errors_of(scene, ErrorKind::scene, {{"jet.order", "30"}}),
               {"file.toml:24:17: formation.separation_km", "--set jet.order: too large"});
  expect_lines(errors_of(orbit, ErrorKind::too_large, {{"jet.order", "30"}}),
               {"--set jet.order: too large"});
}

/// Every shipped scene with one more key at its end has exactly one error: the declarations alone
/// refuse no other key.
// A start in metres causes a warning, and an error of the deputy may be a mere consequence.
TEST(AllErrors, AreFollowedByWhatIsWarnedOf) {
  const std::string metres = changed(orbit, "[7000, 0, 0]", "[7000000, 0, 0]");
  const std::string deputy = "[deputy]\nposition_km = [7000, 1]\nvelocity_km_s = [0, 7.5, 1]\n";
  const char* warning =
      "warning: file.toml:9:15: nominal.position_km: 7,000,000 km from the centre";
  expect_lines(errors_of(metres + deputy), {"deputy.position_km: wrong length", warning});
  expect_lines(errors_of(changed(metres, "stages = 8", "stages = 99") + deputy),
               {"integrator.0.stages: out of range", "deputy.position_km: wrong length", warning});
  expect_lines(errors_of(orbit + deputy), {"deputy.position_km: wrong length"});
}

TEST(AllErrors, OneErrorOfAGoodSceneIsSaidAlone) {
  const std::filesystem::path scenes = std::string(HAMJET_SOURCE_DIR) + "/data/scenes";
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    std::ifstream file(entry.path());
    std::ostringstream text;
    text << file.rdbuf();
    const bool is_good = [&] {
      try {
        parse_study(text.str(), entry.path().string());
        return true;
      } catch (const Error&) {
        return false;
      }
    }();
    if (!is_good) continue;  // a study of hamjet sweep, or a case that is to be refused
    try {
      parse_study("not_a_key_of_scenes = 1\n" + text.str(), entry.path().string());
      ADD_FAILURE() << entry.path();
    } catch (const Error& error) {
      EXPECT_EQ(lines_of(error.what()).size(), 1U) << error.what();
    }
    ++count;
  }
  EXPECT_GT(count, 100U);
}

}  // namespace
}  // namespace hamjet::io
