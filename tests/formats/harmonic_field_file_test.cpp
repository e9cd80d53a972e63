#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "../scene/scene_samples.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/gravity_field_file.hpp"

// Tesseral coefficients of gravity fields, and tide systems.

namespace hamjet::io {
namespace {

const std::filesystem::path folder = std::filesystem::path(HAMJET_SOURCE_DIR) / "data/gravity";

const char* const small = R"(product_type gravity_field
modelname small
earth_gravity_constant 3.986004415e14
radius 6378136.3
max_degree 3
tide_system tide_free
end_of_head
gfc 0 0 1 0
gfc 2 0 -0.484e-3 0
gfc 2 1 -0.2e-9 0.14e-8
gfc 2 2 0.24e-5 -0.14e-5
gfc 3 0 0.9e-6 0
gfc 3 1 0.2e-5 0.25e-6
gfc 3 2 0.9e-6 -0.6e-6
gfc 3 3 0.7e-6 0.14e-5
)";

HarmonicField parsed(const std::string& text, const HarmonicChoice& choice = {3, 3}) {
  return parse_harmonic_field("field.gfc", text, choice);
}

std::string changed_harmonics(const std::string& from, const std::string& to) {
  return changed(small, from, to);
}

void expect_harmonics_refused(const std::string& text, const std::string& words,
                              const HarmonicChoice& choice = {3, 3},
                              ErrorKind kind = ErrorKind::input_output) {
  SCOPED_TRACE(words);
  try {
    parsed(text, choice);
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.kind(), kind) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_NE(what.find(words), std::string::npos) << what;
  }
}

// C(2,2) and S(2,2) as published with EGM96. EGM2008, another model of the same Earth, differs by
// less than the errors of EGM96, some 1e-10 to 1e-9.
TEST(HarmonicFieldFile, TheShippedFieldIsThatOfEGM96) {
  const HarmonicField field = read_harmonic_field(folder / "EGM96-to-20.gfc", {20, 20});
  EXPECT_EQ(field.model_name, "EGM96");
  EXPECT_EQ(field.mu_km3_s2, 398600.4415);
  EXPECT_EQ(field.radius_km, 6378.1363);
  EXPECT_EQ(field.tide, TideSystem::tide_free);
  EXPECT_EQ(field.added_to_C20, 0);
  const SphericalHarmonicCoefficients& c = field.coefficients;
  EXPECT_EQ(c.C(2, 2), 0.243914352398e-05);
  EXPECT_EQ(c.S(2, 2), -0.140016683654e-05);
  struct Expected {
    int n, m;
    double C, S;
  };
  for (const Expected& row : {Expected{3, 3, 0.721321757121568e-6, 0.141434926192941e-5},
                              Expected{8, 5, -0.257011477267991e-7, 0.892034891745881e-7},
                              Expected{15, 7, 0.596540954755518e-7, 0.507394600032322e-8},
                              Expected{20, 20, 0.373507214738094e-8, -0.126949126479726e-7}}) {
    EXPECT_NEAR(c.C(row.n, row.m), row.C, 1e-9) << row.n;
    EXPECT_NEAR(c.S(row.n, row.m), row.S, 1e-9) << row.n;
  }
  const GravityField zonals = read_gravity_field(folder / "EGM96-zonals.gfc", {20});
  const GravityField same = read_gravity_field(folder / "EGM96-to-20.gfc", {20});
  for (int n = 2; n <= 20; ++n) {
    EXPECT_EQ(same.J[n], zonals.J[n]) << n;
    EXPECT_NEAR(c.C(n, 0) * -std::sqrt(2 * n + 1), zonals.J[n], 1e-15 * std::abs(zonals.J[n]));
  }
}

TEST(HarmonicFieldFile, TakesDegreeAndOrderThatAreAskedFor) {
  const HarmonicField field = parsed(small, {3, 1});
  EXPECT_EQ(field.coefficients.degree(), 3);
  EXPECT_EQ(field.coefficients.order(), 1);
  EXPECT_EQ(field.coefficients.C(0, 0), 1);
  EXPECT_EQ(field.coefficients.S(3, 1), 0.25e-6);
  EXPECT_EQ(field.coefficients.C(3, 3), 0);
  EXPECT_EQ(field.max_degree, 3);
  EXPECT_EQ(parsed(small, {2, 2}).coefficients.S(2, 1), 0.14e-8);
  // What stands beside C(n,0) has no meaning.
  EXPECT_EQ(
      parsed(changed_harmonics("gfc 2 0 -0.484e-3 0", "gfc 2 0 -0.484e-3 7")).coefficients.S(2, 0),
      0);
}

// N^2 = (2 - delta) (2n + 1) (n - m)! / (n + m)!: 5, 5/12, 7/360.
TEST(HarmonicFieldFile, DividesByTheNormWhatIsNotNormalised) {
  const HarmonicField field =
      parsed(changed_harmonics("tide_system", "norm unnormalized\ntide_system"));
  EXPECT_DOUBLE_EQ(field.coefficients.C(2, 0), -0.484e-3 / std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(field.coefficients.S(2, 2), -0.14e-5 / std::sqrt(5.0 / 12));
  EXPECT_DOUBLE_EQ(field.coefficients.C(3, 3), 0.7e-6 / std::sqrt(7.0 / 360));
}

// JGM-3 is published with both, C20 = -4.84169548456e-4 and -4.84165374886e-4, with the Love number
// 0.3 in place of 0.3019.
TEST(HarmonicFieldFile, ConvertsThePermanentTide) {
  EXPECT_NEAR(permanent_tide_C20 / (-4.84169548456e-4 + 4.84165374886e-4), 0.3019 / 0.3, 2e-4);
  const auto to = [](TideSystem system) {
    HarmonicChoice choice{3, 3};
    choice.tide_system = system;
    return choice;
  };
  const HarmonicField zero = parsed(small, to(TideSystem::zero_tide));
  EXPECT_EQ(zero.tide, TideSystem::zero_tide);
  EXPECT_EQ(zero.tide_system, "tide_free");
  EXPECT_EQ(zero.added_to_C20, permanent_tide_C20);
  EXPECT_NEAR(zero.coefficients.C(2, 0), -0.484e-3 - 4.2006e-9, 1e-13);
  EXPECT_EQ(zero.coefficients.C(3, 0), 0.9e-6);
  const std::string other = changed_harmonics("tide_free", "zero_tide");
  EXPECT_NEAR(parsed(other, to(TideSystem::tide_free)).coefficients.C(2, 0), -0.484e-3 + 4.2006e-9,
              1e-13);
  EXPECT_EQ(parsed(other, to(TideSystem::zero_tide)).coefficients.C(2, 0), -0.484e-3);
  EXPECT_EQ(parsed(other).tide, TideSystem::zero_tide);
}

TEST(HarmonicFieldFile, ATideSystemMustBeSaid) {
  HarmonicChoice said{3, 3};
  said.tide_system_of_file = TideSystem::zero_tide;
  for (const char* word : {"mean_tide", "unknown", "zero"}) {
    const std::string text = changed_harmonics("tide_free", word);
    expect_harmonics_refused(
        text, fmt::format("field.gfc:6: tide_system: must be tide_free or zero_tide, or it must "
                          "be said which of them the file is, got \"{}\"",
                          word));
    EXPECT_EQ(parsed(text, said).tide, TideSystem::zero_tide);
  }
  expect_harmonics_refused(changed_harmonics("tide_system tide_free\n", ""),
                           "field.gfc:6: tide_system: must be tide_free or zero_tide");
  expect_harmonics_refused(
      small,
      "field.gfc:6: tide_system: the file is tide_free, must not be said to be "
      "zero_tide",
      said);
}

TEST(HarmonicFieldFile, TellsWhereTheCentreOfMassIs) {
  EXPECT_EQ(parsed(small).origin_offset_km.value(), (std::array<double, 3>{}));
  const std::string moved = std::string(small) + "gfc 1 0 1e-9 0\ngfc 1 1 2e-9 -3e-9\n";
  const HarmonicField field = parsed(moved);
  const double unit = std::sqrt(3) * 6378.1363;
  const std::vector<double> expected = {2e-9 * unit, -3e-9 * unit, 1e-9 * unit};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(field.origin_offset_km.value()[i], expected[i], 1e-18);
  }
  EXPECT_EQ(field.coefficients.C(1, 1), 0);
  const std::string moving = std::string(small) + "gfct 1 1 1e-9 0 20050101\n";
  EXPECT_FALSE(parsed(moving).origin_offset_km);
  // A zonal field has no part in it.
  EXPECT_TRUE(parse_gravity_field("field.gfc", moving, {3}).origin_offset_km);
}

TEST(HarmonicFieldFile, SinesVaryWithTimeToo) {
  const std::string text = changed_harmonics(
      "gfc 3 1 0.2e-5 0.25e-6", "gfct 3 1 0.2e-5 0.25e-6 20050101\ntrnd 3 1 1e-9 2e-9");
  expect_harmonics_refused(text, "field.gfc:13: gfct: C(3,1) varies with time");
  HarmonicChoice choice{3, 3};
  choice.epoch = [] { return parse_epoch("2007-01-01T12:00:00"); };  // two Julian years later
  const HarmonicField field = parsed(text, choice);
  EXPECT_DOUBLE_EQ(field.coefficients.C(3, 1), 0.2e-5 + 2e-9);
  EXPECT_DOUBLE_EQ(field.coefficients.S(3, 1), 0.25e-6 + 4e-9);
  EXPECT_TRUE(field.epoch);
}

TEST(HarmonicFieldFile, RefusesWhatIsMissingOrDamaged) {
  expect_harmonics_refused(small,
                           "field.gfc:15: the file ends without C(4,0), which is asked for; its "
                           "max_degree is 3",
                           {4, 0});
  expect_harmonics_refused(changed_harmonics("gfc 3 2 0.9e-6 -0.6e-6\n", ""),
                           "field.gfc:14: the file ends without C(3,2)");
  EXPECT_NO_THROW(parsed(changed_harmonics("gfc 3 2 0.9e-6 -0.6e-6\n", ""), {3, 1}));
  expect_harmonics_refused(changed_harmonics("-0.14e-5", "-0.14f-5"),
                           "field.gfc:11: S(2,2): must be a finite number, got \"-0.14f-5\"");
  expect_harmonics_refused(changed_harmonics("-0.14e-5", "-1.4"),
                           "field.gfc:11: S(2,2): out of range, got -1.4, must be from -1 to 1");
  expect_harmonics_refused(std::string(small) + "gfc 2 2 0 0\n",
                           "field.gfc:16: C(2,2) is there twice, first in line 11");
  for (const HarmonicChoice& choice :
       {HarmonicChoice{1, 1}, HarmonicChoice{3, 4}, HarmonicChoice{3, -1}}) {
    expect_harmonics_refused(small, "degree of a gravity field", choice, ErrorKind::usage);
  }
}

}  // namespace
}  // namespace hamjet::io
