#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "../scene/scene_samples.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/gravity_field_file.hpp"
#include "support/temporary_directory.hpp"

// Coefficients that vary with time, and an origin off the centre of mass. Expected values are the
// format's formula at moments where its sines are 0, 1 or sqrt(1/2), written out.

namespace hamjet::io {
namespace {

/// The rounding of a number near 5e-4 to a double.
constexpr double rounding = 1.1e-19;

const double half_root = std::sqrt(0.5);

/// The coefficients are unnormalised, so that J2 = -C(2,0) to the digit.
const std::string head = R"(begin_of_head
product_type gravity_field
modelname MOVING
earth_gravity_constant 0.3986004415E+15
radius 0.6378136460E+07
max_degree 4
norm unnormalized
)";

/// In the layout of EIGEN-6C4: t0, trend, and terms of a year and half a year.
const std::string format_1 = head + R"(end_of_head
gfc  0 0  1.0 0.0 0 0
gfct 2 0 -4.84e-04 0.0 1e-12 0 20050101
trnd 2 0  1.0e-11 0.0 1e-13 0
asin 2 0  3.0e-11 0.0 1e-13 0 1.0
acos 2 0  5.0e-11 0.0 1e-13 0 1.0
asin 2 0  2.0e-11 0.0 1e-13 0 0.5
gfct 2 1  1.0e-10 1.0e-9 1e-12 0 20050101
gfc  3 0  9.0e-07 0.0 0 0
)";

/// In the layout of the mean fields of GRGS: intervals, and a yearly term over both of them.
const std::string format_2 = head + R"(format icgem2.0
end_of_head
gfc  0 0  1.0 0.0 0 0
gfct 2 0 -4.84e-04 0.0 1e-12 0 20000101.0000 20050101.1200
trnd 2 0  1.0e-11 0.0 1e-13 0 20000101.0000 20050101.1200
gfct 2 0 -4.83e-04 0.0 1e-12 0 20050101.1200 20100101.0000
acos 2 0  5.0e-11 0.0 1e-13 0 20000101.0000 20100101.0000 1.0
gfc  3 0  9.0e-07 0.0 0 0
)";

ZonalChoice at(const std::string& epoch, std::vector<int> degrees = {2}) {
  return {0, std::move(degrees), [epoch] { return parse_epoch(epoch); }};
}

double C2(const std::string& text, const std::string& epoch) {
  return -parse_gravity_field("field.gfc", text, at(epoch)).J[2];
}

void expect_field_refused(const std::string& text, const std::string& words,
                          const ZonalChoice& choice = at("2005-01-01T00:00:00")) {
  try {
    parse_gravity_field("field.gfc", text, choice);
    ADD_FAILURE() << "not refused: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_output);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

// A Julian year has 365.25 days: a quarter of it is 91 days, 7 hours and 30 minutes.
TEST(TimeVariableField, Format1IsItsFormula) {
  EXPECT_NEAR(C2(format_1, "2005-01-01T00:00:00"), -4.84e-4 + 5e-11, rounding);
  EXPECT_NEAR(C2(format_1, "2006-01-01T06:00:00"), -4.84e-4 + 1e-11 + 5e-11, rounding);
  EXPECT_NEAR(C2(format_1, "2005-04-02T07:30:00"), -4.84e-4 + 0.25e-11 + 3e-11, rounding);
  EXPECT_NEAR(C2(format_1, "2005-02-15T15:45:00"),
              -4.84e-4 + 0.125e-11 + half_root * (3e-11 + 5e-11) + 2e-11, rounding);
  // The formula holds before t0 too.
  EXPECT_NEAR(C2(format_1, "2004-07-02T09:00:00"), -4.84e-4 - 0.5e-11 - 5e-11, rounding);
  EXPECT_NEAR(C2(format_1, "2004-10-01T16:30:00"), -4.84e-4 - 0.25e-11 - 3e-11, rounding);
  // The old name of a trend, and a t0 that has a time.
  EXPECT_EQ(C2(changed(changed(format_1, "trnd", "dot"), "20050101\ndot", "20050101.0000\ndot"),
               "2006-01-01T06:00:00"),
            C2(format_1, "2006-01-01T06:00:00"));
}

TEST(TimeVariableField, Format2HoldsWithinItsIntervals) {
  EXPECT_NEAR(C2(format_2, "2000-01-01T00:00:00"), -4.84e-4 + 5e-11, rounding);
  EXPECT_NEAR(C2(format_2, "2000-07-01T15:00:00"), -4.84e-4 + 0.5e-11 - 5e-11, rounding);
  // The moment is five Julian years after the first t0, and still in the first interval.
  EXPECT_NEAR(C2(format_2, "2004-12-31T06:00:00"), -4.84e-4 + 5e-11 + 5e-11, rounding);
  // t1 belongs to the next interval; the yearly term counts from its own t0, 5 years and 30 hours.
  const double phase = 2 * std::numbers::pi * 30 / (365.25 * 24);
  EXPECT_NEAR(C2(format_2, "2005-01-01T12:00:00"), -4.83e-4 + 5e-11 * std::cos(phase), rounding);
  EXPECT_NEAR(C2(format_2, "2005-01-01T11:59:59.999999"),
              -4.84e-4 + (5 + 30 / (365.25 * 24)) * 1e-11 + 5e-11 * std::cos(phase), rounding);
  const std::string intervals =
      "must be from 2000-01-01T00:00 to 2005-01-01T12:00 or from "
      "2005-01-01T12:00 to 2010-01-01T00:00";
  for (const char* outside : {"1999-12-31T23:59:00", "2010-01-01T00:00:00"}) {
    expect_field_refused(format_2,
                         fmt::format("field.gfc:11: gfct: C(2,0) is not given at the epoch {:.16}, "
                                     "{}",
                                     outside, intervals),
                         at(outside));
  }
}

// EIGEN-6S4v2 has an earthquake at 20041226.0060, which is 01:00, and a day may end at 24:00.
TEST(TimeVariableField, TheMinute60IsTheNextHour) {
  const auto at_date = [](const std::string& date, const std::string& epoch) {
    return C2(changed(format_1, "20050101\ntrnd", date + "\ntrnd"), epoch);
  };
  EXPECT_EQ(at_date("20041226.0060", "2006-01-01T00:00:00"),
            at_date("20041226.0100", "2006-01-01T00:00:00"));
  EXPECT_EQ(at_date("20041231.2360", "2006-01-01T00:00:00"),
            at_date("20050101", "2006-01-01T00:00:00"));
  EXPECT_EQ(at_date("20041231.2400", "2006-01-01T00:00:00"),
            at_date("20050101", "2006-01-01T00:00:00"));
  for (const char* date : {"20041226.0061", "20041231.2401", "20041231.2500", "20041226.+1+1"}) {
    expect_field_refused(changed(format_1, "20050101\ntrnd", date + std::string("\ntrnd")),
                         ":10: gfct: t0 must be a date");
  }
}

TEST(TimeVariableField, TellsItsEpochAndAsksForNoneWhereNothingVaries) {
  const GravityField field =
      parse_gravity_field("field.gfc", format_1, at("2006-01-01T06:00:00", {2, 3}));
  EXPECT_EQ(field.epoch, parse_epoch("2006-01-01T06:00:00"));
  EXPECT_EQ(field.J[3], -9e-7);
  bool is_asked = false;
  const GravityField constant =
      parse_gravity_field("field.gfc", format_1, {0, {3}, [&] {
                                                    is_asked = true;
                                                    return parse_epoch("2006-01-01T06:00:00");
                                                  }});
  EXPECT_FALSE(is_asked);
  EXPECT_EQ(constant.J[3], -9e-7);
  EXPECT_FALSE(constant.epoch.has_value());
  const std::string words =
      "C(2,0) varies with time, and nothing says when: must have the key gravity_epoch";
  expect_field_refused(format_1, "field.gfc:10: gfct: " + words, {2});
  expect_field_refused(format_1, "field.gfc:10: gfct: " + words,
                       {2, {}, [] { return std::optional<Epoch>(); }});
}

TEST(TimeVariableField, RefusesRecordsThatAreDamaged) {
  const auto refuse = [](const std::string& from, const std::string& to, const std::string& words) {
    expect_field_refused(changed(format_1, from, to), words);
  };
  refuse("0 20050101\ntrnd", "0\ntrnd",
         ":10: gfct: has 7 columns, must have 6 (key, degree, "
         "order, C, S, t0), or 8 or 10");
  refuse("0 1.0\nacos", "0\nacos",
         ":12: asin: has 7 columns, must have 6 (key, degree, order, C, "
         "S, period)");
  refuse("20050101\ntrnd", "20050230\ntrnd",
         ":10: gfct: t0 must be a date, yyyymmdd or yyyymmdd.hhmm, got \"20050230\"");
  refuse("20050101\ntrnd", "2005-1-1\ntrnd", ":10: gfct: t0 must be a date");
  refuse("0 1.0\nacos", "0 0\nacos", ":12: asin: the period must be a positive number of years");
  refuse("0 1.0\nacos", "0 y\nacos", ":12: asin: the period must be a positive number of years");
  refuse("3.0e-11", "3.0x-11", ":12: C(2,0): must be a finite number, got \"3.0x-11\"");
  refuse("5.0e-11", "5.0e+11", ":10: C(2,0): out of range");
  refuse("0 0.5", "0 1.0",
         ":14: asin: C(2,0) is there twice at the epoch 2005-01-01T00:00, first "
         "in line 12");
  refuse("gfct 2 1  1.0e-10 1.0e-9 1e-12 0", "gfct 2 0  1.0e-10 0 1e-12 0",
         ":15: gfct: C(2,0) is there twice at the epoch");
  refuse("gfct 2 1  1.0e-10 1.0e-9 1e-12 0 20050101", "gfc 2 0 1 0",
         ":15: C(2,0) is there twice, first in line 10");
  refuse("gfct 2 0 -4.84e-04 0.0 1e-12 0 20050101\n", "",
         ":10: trnd: C(2,0) has no gfct or gfc, to which this would be added");
  refuse("gfct 2 0 -4.84e-04 0.0 1e-12 0 20050101\n", "gfc 2 0 -4.84e-04 0\n",
         ":11: trnd: C(2,0) has no gfct, from whose t0 this is counted");
  refuse("norm", "format icgem3.0\nnorm", ":7: format: must be icgem1.0 or icgem2.0");
  refuse("gfc  3 0  9.0e-07", "trnd 0 0  1e-12",
         ":16: C(0,0): must be 1 at all times, got a term trnd of \"1e-12\"");
  expect_field_refused(
      changed(format_2, "20000101.0000 20050101.1200\ngfct", "20000101.0000 20000101.0000\ngfct"),
      ":12: trnd: t1 must be later than t0, got 2000-01-01T00:00 and");
  expect_field_refused(changed(format_2, "20050101.1200 20100101", "20050101 20100101"),
                       ":13: gfct: C(2,0) is there twice at the epoch 2005-01-01T00:00, first in "
                       "line 11");
  expect_field_refused(
      changed(format_2, " 1.0\ngfc  3", "\ngfc  3"),
      ":14: acos: has 9 columns, must have 8 (key, degree, order, C, S, t0, t1, period)");
}

// The field of a point mass at z on the axis minus that of a point mass at the origin is, far away,
// the term of degree 1: its C10 must give z back.
TEST(TimeVariableField, TheOriginIsWhereC10PutsIt) {
  const double z_km = 0.25, radius_km = 6378.13646, r = 1e6, latitude = 0.7;
  const double distance = std::hypot(r * std::cos(latitude), r * std::sin(latitude) - z_km);
  const double potential = (r - distance) / (r * distance);  // 1 / distance - 1 / r
  const double C10 = potential * r * r / (radius_km * std::sin(latitude));
  const auto offset = [](const std::string& text, const ZonalChoice& choice) {
    return parse_gravity_field("field.gfc", text, choice).origin_offset_km.value();
  };
  const std::string raw = format_1 + fmt::format("gfc 1 0 {:.15e} 0 0 0\n", C10);
  EXPECT_NEAR(offset(raw, at("2005-01-01T00:00:00")) / z_km, 1, 1e-6);
  const std::string normalised = changed(format_1, "norm unnormalized\n", "") +
                                 fmt::format("gfc 1 0 {:.15e} 0 0 0\n", C10 / std::sqrt(3.0));
  EXPECT_NEAR(offset(normalised, {0, {3}}) / z_km, 1, 1e-6);
  EXPECT_EQ(offset(format_1, {0, {3}}), 0);
  // An origin that moves is taken at the epoch; without an epoch it is unknown.
  const std::string moving = format_1 + "gfct 1 0 1e-9 0 20050101\ntrnd 1 0 1e-10 0\n";
  EXPECT_NEAR(offset(moving, at("2006-01-01T06:00:00")), 1.1e-9 * radius_km, 1e-15);
  EXPECT_FALSE(parse_gravity_field("f", moving, {0, {3}}).origin_offset_km.has_value());
}

class SceneAtAnEpoch : public testing::Test {
 protected:
  SceneAtAnEpoch() { write(format_1); }

  void write(const std::string& field) const {
    std::ofstream(directory_.path() / "field.gfc") << field;
  }

  Scene read(const std::string& lines, const std::string& more = "") const {
    return parse_scene(changed(orbit, "mu_km3_s2 = 398600.4415\nradius_km = 6378\nJ2 = 1e-3\n",
                               "gravity_file = \"field.gfc\"\n" + lines) +
                           more,
                       (directory_.path() / "scene.toml").string());
  }

  void expect_error(const std::string& lines, const std::vector<std::string>& words,
                    ErrorKind kind = ErrorKind::scene) const {
    test::expect_error([&] { read(lines); }, kind, words, lines);
  }

  test::TemporaryDirectory directory_;
};

TEST_F(SceneAtAnEpoch, TakesItFromItsKeyOrFromWhatDatesTheNominal) {
  const std::string ephemeris =
      "[ephemeris]\nepoch = \"2006-01-01T06:00:00\"\ntime_system = \"TT\"\n"
      "reference_frame = \"TOD\"\ncenter_name = \"EARTH\"\n";
  const double a_year_later = 4.84e-4 - 1e-11 - 5e-11;
  const Scene dated = read("zonals = [2]\n", ephemeris);
  EXPECT_NEAR(dated.system.J[2], a_year_later, rounding);
  ASSERT_TRUE(dated.system.gravity_file.has_value());
  EXPECT_EQ(dated.system.gravity_file->epoch, "2006-01-01T06:00:00.000000000000");
  // The key takes precedence, so that a field may be that of another moment than the start.
  const Scene keyed = read("zonals = [2]\ngravity_epoch = \"2005-001T00:00:00\"\n", ephemeris);
  EXPECT_NEAR(keyed.system.J[2], 4.84e-4 - 5e-11, rounding);
  EXPECT_EQ(keyed.system.gravity_file->epoch, "2005-01-01T00:00:00.000000000000");
  EXPECT_EQ(read("zonals = [3]\n", ephemeris).system.gravity_file->epoch, "");
}

TEST_F(SceneAtAnEpoch, TakesItFromTheOrbitMessageOfTheNominal) {
  std::filesystem::copy_file(
      std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/eutelsat-w4.opm",
      directory_.path() / "start.opm");
  const Scene scene =
      parse_scene(changed(changed(orbit, "mu_km3_s2 = 398600.4415\nradius_km = 6378\nJ2 = 1e-3\n",
                                  "gravity_file = \"field.gfc\"\nzonals = [2]\n"),
                          "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n",
                          "opm_file = \"start.opm\"\n"),
                  (directory_.path() / "scene.toml").string());
  EXPECT_EQ(scene.system.gravity_file->epoch, "2021-06-03T00:00:00.000000000000");
  EXPECT_EQ(scene.system.J[2], parse_gravity_field("f", format_1, at("2021-06-03T00:00:00")).J[2]);
}

TEST_F(SceneAtAnEpoch, IsRefusedWithTheKeyThatHelps) {
  expect_error("zonals = [2]\n",
               {"field.gfc:10: gfct: C(2,0) varies with time", "gravity_epoch in [system]",
                "epoch in [ephemeris]"},
               ErrorKind::input_output);
  expect_error("zonals = [2]\ngravity_epoch = \"2005-13-01T00:00:00\"\n",
               {"system.gravity_epoch: no moment of the calendar, got \"2005-13-01T00:00:00\""});
  expect_error("zonals = [2]\ngravity_epoch = 2005\n", {"system.gravity_epoch: wrong type"});
}

// 2e-8 radii are 0.1276 m of the Earth.
TEST_F(SceneAtAnEpoch, ASmallOffsetIsWarnedOfAndALargeOneRefused) {
  write(format_1 + "gfc 1 0 1e-8 0 0 0\n");
  const Scene small = read("zonals = [3]\n");
  ASSERT_EQ(small.warnings.size(), 1U);
  EXPECT_NE(small.warnings[0].find("system.gravity_file: C(1,0) is left out, which puts the file's "
                                   "centre of mass at z = 0.06378 m"),
            std::string::npos)
      << small.warnings[0];
  EXPECT_NEAR(small.system.gravity_file->origin_offset_m.value(), 0.0637813646, 1e-15);
  EXPECT_TRUE(read("zonals = [3]\nleave_out_C10 = true\n").warnings.empty());

  write(format_1 + "gfc 1 0 -3e-8 0 0 0\n");
  for (const char* key : {"", "leave_out_C10 = false\n"}) {
    expect_error(std::string("zonals = [3]\n") + key,
                 {"system.gravity_file: the origin is not the centre of mass", "z = -0.1913 m",
                  "within 0.13 m", "leave_out_C10 = true"});
  }
  const Scene asked = read("zonals = [3]\nleave_out_C10 = true\n");
  EXPECT_NEAR(asked.system.gravity_file->origin_offset_m.value(), -0.1913440938, 1e-15);
  EXPECT_EQ(asked.system.J[3], -9e-7);

  write(format_1 + "gfct 1 0 1e-9 0 20050101\ntrnd 1 0 1e-12 0\n");
  expect_error("zonals = [3]\n",
               {"system.gravity_file: C(1,0) varies with time", "epoch in [ephemeris]"});
  EXPECT_FALSE(read("zonals = [3]\nleave_out_C10 = true\n")
                   .system.gravity_file->origin_offset_m.has_value());
  EXPECT_EQ(read("zonals = [3]\ngravity_epoch = \"2005-01-01T00:00:00\"\n").warnings.size(), 1U);
}

}  // namespace
}  // namespace hamjet::io
