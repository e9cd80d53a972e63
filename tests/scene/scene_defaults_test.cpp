#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/study_reader.hpp"
#include "scene_samples.hpp"

// Tests what a scene may leave out: the smallest scene is a field, an orbit and a duration.

namespace hamjet::io {
namespace {

const std::string smallest = R"([system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
position_km = [7000, 0, 0]
velocity_km_s = [0, 7.5, 1]
[jet]
duration_orbits = 1
)";

std::vector<std::string> labels_of(const std::string& integrators) {
  std::vector<std::string> labels;
  for (const auto& settings : parse_scene(smallest + integrators, "a.toml").integrators) {
    labels.push_back(settings.label);
  }
  return labels;
}

TEST(SceneDefaults, AFieldAnOrbitAndADurationAreAScene) {
  const Scene scene = parse_scene(smallest, "folder/two satellites.toml");
  EXPECT_EQ(scene.title, "two satellites");
  EXPECT_EQ(scene.name, "two_satellites");
  EXPECT_EQ(scene.order, 4);
  ASSERT_EQ(scene.integrators.size(), 1U);
  EXPECT_EQ(scene.integrators[0].label, "gauss8");
  EXPECT_EQ(scene.integrators[0].method, IntegrationMethod::gauss);
  EXPECT_EQ(scene.integrators[0].stages, 8);
  EXPECT_EQ(scene.integrators[0].tolerance, 1e-12);
  EXPECT_FALSE(scene.integrators[0].step_canonical);
}

TEST(SceneDefaults, ASceneWithoutAFileHasATitle) {
  EXPECT_EQ(parse_scene(smallest, "").title, "scene");
}

TEST(SceneDefaults, TheOtherStudiesHaveThemToo) {
  const Study study =
      read_study(std::string(HAMJET_SOURCE_DIR) + "/data/scenes/paper/free-end.toml",
                 {{"schema", "null"}, {"title", "null"}});
  EXPECT_EQ(std::get<OptimalControlStudy>(study).title, "free-end");
}

// The default integrator has the same name as one that is written.
TEST(SceneDefaults, OverridesFindTheDefaultIntegrator) {
  const auto settings = [](const std::vector<Override>& overrides) {
    return parse_scene(smallest, "a.toml", overrides).integrators;
  };
  const auto changed = settings({{"integrator.gauss8.tolerance", "1e-9"}});
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0].label, "gauss8");
  EXPECT_EQ(changed[0].stages, 8);
  EXPECT_EQ(changed[0].tolerance, 1e-9);
  EXPECT_EQ(settings({{"integrator.0.stages", "4"}})[0].stages, 4);
  expect_error(
      [&] {
        settings({{"integrator.gauss9.stages", "4"}});
      },
      ErrorKind::usage, {"no such element, got \"gauss9\", must be gauss8 or an index below 1"},
      "");
  // Written values are kept.
  const std::string midpoint = "[[integrator]]\nmethod = \"gauss\"\nstages = 1\ntolerance = 1e-6\n";
  const Scene written =
      parse_scene(smallest + midpoint, "a.toml", {{"integrator.0.tolerance", "1e-7"}});
  ASSERT_EQ(written.integrators.size(), 1U);
  EXPECT_EQ(written.integrators[0].stages, 1);
}

/// The names that comparisons use for their series.
TEST(SceneDefaults, LabelsAreThoseOfComparisons) {
  const std::string step = "step_canonical = 0.1\n", table = "[[integrator]]\n" + step;
  EXPECT_EQ(
      labels_of(table + "method = \"gauss\"\nstages = 4\n" + table +
                "method = \"velocity-verlet\"\norder = 6\n" + table + "method = \"stormer\"\n" +
                table + "method = \"newmark\"\nbeta = 0.1\n" + table + "method = \"fehlberg78\"\n"),
      (std::vector<std::string>{"gauss4", "verlet6", "stormer", "newmark", "fehlberg78"}));
}

TEST(SceneDefaults, LabelsAreMadeUnique) {
  const std::string gauss = "[[integrator]]\nmethod = \"gauss\"\n";
  EXPECT_EQ(labels_of(gauss + "tolerance = 1e-9\n" + gauss + "tolerance = 1e-12\n" + gauss +
                      "tolerance = 1e-13\nlabel = \"gauss8-2\"\n"),
            (std::vector<std::string>{"gauss8", "gauss8-3", "gauss8-2"}));
}

}  // namespace
}  // namespace hamjet::io
