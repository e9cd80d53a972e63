#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "support/temporary_directory.hpp"

// Jets of order 6 in a made-up field of degree and order 70, with Sun and Moon: at every degree
// they are symplectic to rounding, and the residual of exactness is that of rounding, as of a jet
// with J2 alone.

namespace hamjet {
namespace {

/// The Earth's J2, and all other coefficients random, of the sizes of Kaula's rule.
void write_field(const std::filesystem::path& file) {
  std::mt19937_64 generator(70);
  const auto draw = [&](int n) {
    const double fraction = static_cast<double>(generator() >> 11) * 0x1p-53;
    return (2 * fraction - 1) * 1e-5 / (n * n);
  };
  std::ofstream out(file);
  out << "product_type gravity_field\nmodelname MADE_UP\nearth_gravity_constant 0.3986004415E+15\n"
         "radius 0.63781363E+07\nmax_degree 70\ntide_system tide_free\nend_of_head\ngfc 0 0 1.0 "
         "0.0\ngfc 1 0 0.0 0.0\ngfc 1 1 0.0 0.0\n";
  for (int n = 2; n <= 70; ++n) {
    for (int m = 0; m <= n; ++m) {
      const double C = n == 2 && m == 0 ? -4.84165e-4 : draw(n);
      out << fmt::format("gfc {} {} {:.17g} {:.17g}\n", n, m, C, m == 0 ? 0.0 : draw(n));
    }
  }
}

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
  write_field(folder.path() / "made_up.gfc");
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
