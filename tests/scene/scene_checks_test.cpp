#include <gtest/gtest.h>

#include <string>

#include "scene_samples.hpp"

// The table [checks]: the self-checks that a scene turns off, and the limits that it sets.

namespace hamjet::io {
namespace {

SelfCheckSettings checks(const std::string& lines, const std::string& scene = orbit) {
  return parse_scene(scene + "[checks]\n" + lines, "file.toml").checks;
}

TEST(SceneChecks, AreOnByDefaultWithoutLimits) {
  const auto defaults = parse_scene(orbit, "file.toml").checks;
  for (std::size_t i = 0; i < self_check_names().size(); ++i) {
    const auto name = static_cast<SelfCheckName>(i);
    EXPECT_TRUE(defaults[name].is_on) << name_of(name);
    EXPECT_FALSE(defaults[name].limit) << name_of(name);
  }
}

TEST(SceneChecks, AreReadOneByOne) {
  const auto settings = checks(
      "energy = 1e-3\nstep-error = false\nsurface = 6478\nfinite = false\nsymplecticity = true\n"
      "convergence = 10\n");
  EXPECT_EQ(settings[SelfCheckName::energy].limit, 1e-3);
  EXPECT_TRUE(settings[SelfCheckName::energy].is_on);
  EXPECT_FALSE(settings[SelfCheckName::step_error].is_on);
  EXPECT_EQ(settings[SelfCheckName::surface].limit, 6478);
  EXPECT_FALSE(settings[SelfCheckName::finite].is_on);
  EXPECT_TRUE(settings[SelfCheckName::symplecticity].is_on);
  EXPECT_EQ(settings[SelfCheckName::convergence].limit, 10);
  EXPECT_TRUE(settings[SelfCheckName::inversion].is_on);
}

TEST(SceneChecks, MistakesAreNamed) {
  const auto expect = [](const std::string& line, const std::vector<std::string>& words,
                         const std::string& scene = orbit) {
    expect_scene_error(std::string(scene) + "[checks]\n" + line, words);
  };
  expect("enrgy = 1e-3", {"checks.enrgy: unknown key", "did you mean energy?"});
  expect("closedness = false", {"checks.closedness: unknown key",
                                "finite, convergence, step-error, energy, "
                                "symplecticity, inversion, surface, error-estimate"});
  expect("energy = \"off\"",
         {"checks.energy: wrong type", "\"off\"", "a number above 0 (the limit), true or false"});
  expect("energy = 0", {"checks.energy: ", "got 0", "above 0"});
  expect("energy = -1e-3", {"checks.energy: ", "above 0"});
  expect("energy = nan", {"checks.energy: ", "nan"});
  expect("energy = inf", {"checks.energy: ", "inf"});
  expect("finite = 3", {"checks.finite: wrong type", "got 3", "must be true or false"});
  expect("surface = 6378", {"checks.surface: has no meaning here", "system.radius_km"}, oscillator);
  EXPECT_FALSE(checks("surface = false", oscillator)[SelfCheckName::surface].is_on);
  expect_scene_error(changed(orbit, "[reference]", "checks = false\n[reference]"), {"checks"});
}

}  // namespace
}  // namespace hamjet::io
