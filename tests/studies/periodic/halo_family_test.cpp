#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "independent_halo.hpp"
#include "studies/periodic/periodic_study.hpp"

// Halo orbits of the Earth and the Moon against a differential correction in long double that
// shares no code with the library, and against published figures.

namespace hamjet {
namespace {

constexpr long double moon = 0.0121505856L;
constexpr double month_s = 29.530589 * 86400;

Scene halo_scene(const std::string& name, std::vector<io::Override> overrides) {
  const std::filesystem::path own =
      std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/own" / name;
  overrides.push_back({"system.parameters.mu", "0.0121505856"});
  return io::read_scene(own, overrides);
}

/// The test's own orbit next to a member, whose z it has.
test::IndependentHalo independent(const PeriodicOrbit& orbit) {
  const Vector<double>& s = orbit.start();
  return test::corrected_halo(test::RestrictedProblem(moon), s[0], s[2], s[4] - s[0],
                              orbit.nodes.period);
}

void expect_like(const PeriodicOrbit& orbit, const test::IndependentHalo& own) {
  const Vector<double>& s = orbit.start();
  EXPECT_NEAR(s[0], static_cast<double>(own.x), 1e-10);
  EXPECT_NEAR(s[1], 0, 1e-10);
  EXPECT_NEAR(s[4] - s[0], static_cast<double>(own.vy), 1e-10);
  EXPECT_NEAR(orbit.nodes.period, static_cast<double>(own.period), 1e-10);
  EXPECT_NEAR(-2 * orbit.energy, static_cast<double>(own.jacobi), 1e-11);
  ASSERT_EQ(orbit.monodromy.indices.size(), 2U);
  std::array<double, 2> indices{};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(orbit.monodromy.indices[i].imag(), 0);
    indices[i] = orbit.monodromy.indices[i].real();
  }
  std::ranges::sort(indices, std::ranges::greater{});
  for (std::size_t i = 0; i < 2; ++i) {
    const auto expected = static_cast<double>(own.indices[i]);
    EXPECT_NEAR(indices[i], expected, 1e-7 * std::max(1.0, std::abs(expected))) << i;
  }
  EXPECT_LT(orbit.closing, 1e-9);
  EXPECT_LT(orbit.monodromy.determinant_defect, 1e-7);
}

// The shipped formation's telescope: its scene has the Earth at the origin.
TEST(HaloFamily, TheOrbitAboutTheSunEarthL2IsThatOfADifferentialCorrection) {
  const Scene scene = io::read_scene(std::filesystem::path(HAMJET_SOURCE_DIR) /
                                     "data/scenes/own/sun-earth-l2-formation.toml");
  const PeriodicStudy study = study_periodic(scene);
  ASSERT_EQ(study.family.members.size(), 1U);
  const PeriodicOrbit& orbit = study.family.members[0].orbit;
  const long double mu = 1 / (1 + 328900.5596L);
  const Vector<double>& s = orbit.start();
  const auto own = test::corrected_halo(test::RestrictedProblem(mu), s[0] + 1 - mu, s[2],
                                        s[4] - s[0], orbit.nodes.period);
  EXPECT_NEAR(s[0], static_cast<double>(own.x - 1 + mu), 1e-12);
  EXPECT_NEAR(s[4] - s[0], static_cast<double>(own.vy), 1e-12);
  EXPECT_NEAR(orbit.nodes.period, static_cast<double>(own.period), 1e-10);
}

// The family is followed from the near-rectilinear orbits almost to the plane, through the fold of
// the energy.
TEST(HaloFamily, TenMembersAreThoseOfADifferentialCorrection) {
  const PeriodicStudy study =
      study_periodic(halo_scene("earth-moon-halo-l2.toml", {{"periodic.family.step", "0.2"}}));
  EXPECT_EQ(study.family.end, "");
  ASSERT_GE(study.family.members.size(), 10U);
  for (const FamilyMember& member : study.family.members) {
    SCOPED_TRACE(member.along);
    expect_like(member.orbit, independent(member.orbit));
  }
  const bool has_fold = std::ranges::any_of(study.family.members, [](const FamilyMember& one) {
    return one.mark.find("fold of the energy") != std::string::npos;
  });
  EXPECT_TRUE(has_fold);
}

// E. M. Zimovan, K. C. Howell and D. C. Davis, Near rectilinear halo orbits and their application
// in cis-lunar space (2017): the orbit in 9:2 resonance with the Moon's synodic month has a period
// of about 6.56 d, a perilune of about 3200 to 3400 km and a Jacobi constant of about 3.0466.
TEST(HaloFamily, TheResonantOrbitIsThePublishedOne) {
  const double period_s = 2 * month_s / 9;
  const PeriodicStudy study = study_periodic(halo_scene(
      "earth-moon-nrho.toml",
      {{"periodic", "{hold = \"period\", value = " + std::to_string(period_s / 375190.26) + "}"}}));
  ASSERT_EQ(study.family.members.size(), 1U);
  const PeriodicOrbit& orbit = study.family.members[0].orbit;
  const test::IndependentHalo own = independent(orbit);
  expect_like(orbit, own);
  EXPECT_NEAR(orbit.nodes.period * study.scene.units.time_s / 86400, 6.56, 0.005);
  const double perilune_km = static_cast<double>(own.least_distance) * 384400;
  EXPECT_GT(perilune_km, 3150);
  EXPECT_LT(perilune_km, 3400);
  EXPECT_NEAR(-2 * orbit.energy, 3.0466, 5e-4);
}

}  // namespace
}  // namespace hamjet
