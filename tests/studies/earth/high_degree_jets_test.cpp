#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "studies/made_up_field.hpp"
#include "support/temporary_directory.hpp"

// Jets of order 6 in a made-up field of degree and order 70, with Sun and Moon: at every degree
// they are symplectic to rounding, and the residual of exactness is that of rounding, as of a jet
// with J2 alone.

namespace hamjet {
namespace {

RunResult jet_with(const std::filesystem::path& folder, const std::string& forces) {
  std::ofstream(folder / "scene.toml") << fmt::format(R"(
[system]
model = "earth"
gravity_file = "made_up.gfc"
{}
[nominal]
epoch_utc = "2026-03-01T06:00:00"
height_km = 400
i_deg = 97.5
raan_deg = 30
u_deg = 0
[jet]
order = 6
duration_s = 1200
[[integrator]]
label = "gauss8"
method = "gauss"
tolerance = 1e-12
[generating_function]
kinds = ["F1"]
)",
                                                      forces);
  return propagate(io::read_scene(folder / "scene.toml")).runs.front();
}

TEST(HighDegreeJets, AreSymplecticAndExactToRoundingAtEveryDegree) {
  const test::TemporaryDirectory folder;
  test::write_made_up_field(folder.path() / "made_up.gfc");
  const RunResult run = jet_with(folder.path(), "gravity_degree = 70");
  const RunResult oblate =
      jet_with(folder.path(), "gravity_degree = 2\ngravity_order = 0\nsun = false\nmoon = false");
  ASSERT_TRUE(run.failure.empty()) << run.failure;
  ASSERT_EQ(run.symplecticity.size(), 6U);
  // Brackets are sums of some hundred products, whose roundings add up as a random walk.
  constexpr double rounding = 1e-14;
  for (const SymplecticityDefect& defect : run.symplecticity) {
    EXPECT_LT(defect.scaled, rounding) << defect.degree;
  }
  ASSERT_EQ(run.kinds.size(), 1U);
  const auto& exactness = run.kinds[0].by_degree;
  ASSERT_GE(exactness.size(), 5U);
  ASSERT_EQ(oblate.kinds.at(0).by_degree.size(), exactness.size());
  for (std::size_t k = 0; k < exactness.size(); ++k) {
    // A residual of rounding alone is another sample of the same size.
    constexpr double sample = 10;
    EXPECT_LT(exactness[k].residual.scaled, sample * oblate.kinds[0].by_degree[k].residual.scaled)
        << k;
    EXPECT_GT(exactness[k].residual.scaled, 0) << k;
  }
}

}  // namespace
}  // namespace hamjet
