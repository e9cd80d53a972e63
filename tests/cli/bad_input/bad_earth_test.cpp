#include <fmt/format.h>

#include "refused_scene.hpp"

// Scenes about the real Earth with one mistake each, and messages in axes that turn. Lines and
// columns are those of earth_scene, counted by hand.

namespace hamjet::test {
namespace {

using std::string;

const string earth_scene = R"(schema = 1
[system]
model = "earth"
gravity_degree = 4
[nominal]
epoch_utc = "2023-05-16T06:00:00"
height_km = 514
i_deg = 97.5
raan_deg = 30
u_deg = 0
[jet]
order = 1
duration_s = 600
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
tolerance = 1e-10
)";

/// A field of degree 2 whose header has this line of its tide system.
string field_file(const string& tide_system) {
  return "product_type gravity_field\nmodelname TEST\nearth_gravity_constant 0.3986004415E+15\n"
         "radius 0.63781363E+07\nmax_degree 2\n" +
         tide_system +
         "end_of_head\n"
         "gfc 0 0 1.0 0.0\ngfc 2 0 -0.484165371736E-03 0.0\n"
         "gfc 2 1 -0.186987635955E-09 0.119528012031E-08\n"
         "gfc 2 2 0.243914352398E-05 -0.140016683654E-05\n";
}

/// Two days of May 2023 as finals2000A has them, with the values of Bulletin A alone.
constexpr const char* orientation_file =
    "23 516 60080.00 I  0.060000 0.000018  0.480000 0.000017  I-0.0450000 0.0000100\n"
    "23 517 60081.00 I  0.062000 0.000018  0.482000 0.000017  I-0.0450000 0.0000100\n";

string ephemeris_message(const string& frame, const string& time_system = "UTC") {
  return "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2023-05-16T00:00:00\nORIGINATOR = TEST\n"
         "META_START\nOBJECT_NAME = ONE\nOBJECT_ID = 2023-001A\nCENTER_NAME = EARTH\nREF_FRAME = " +
         frame + "\nTIME_SYSTEM = " + time_system +
         "\nSTART_TIME = 2023-05-16T06:00:00\nSTOP_TIME = 2023-05-16T06:00:00\nMETA_STOP\n"
         "2023-05-16T06:00:00 6892.137 0 0 0 1 7.5\n";
}

using BadEarth = RefusedScene;

TEST_F(BadEarth, Axes) {
  const string epoch = "epoch_utc = \"2023-05-16T06:00:00\"\n";
  expect_each_refused(
      earth_scene,
      {{epoch,
        epoch + "axes = \"ECEF\"\n",
        {"bad.toml:7:8: nominal.axes: unknown value, got \"ECEF\", must be one of: GCRF, EME2000"}},
       {epoch, epoch + "axes = 3\n", {"bad.toml:7:8: nominal.axes: wrong type, got 3"}},
       {epoch,
        epoch + "axes = \"ITRF\"\n",
        {"bad.toml:8:13: nominal.height_km: elements along axes that turn with the Earth",
         "must be position_km and velocity_km_s, or other axes: GCRF"}}});
}

TEST_F(BadEarth, Epochs) {
  const string key = "epoch_utc", date = "2023-05-16T06:00:00";
  expect_each_refused(
      earth_scene,
      {{key, "epoch", {"bad.toml:6:9: nominal.epoch: without a time system", "epoch_utc"}},
       {key + " = \"" + date + "\"\n", "", {"bad.toml:5:1: nominal: no epoch", "epoch_tt"}},
       {key,
        "epoch_tt = \"2023-05-16T06:01:09.184\"\nepoch_utc",
        {"bad.toml:6:12: nominal.epoch_tt: a second epoch, got epoch_utc and epoch_tt"}},
       {date,
        "1959-12-31T00:00:00",
        {"bad.toml:6:13: nominal.epoch_utc: a date at which", "must be from 1960-01-01"}},
       {key + " = \"" + date,
        "epoch_tt = \"1955-01-01T00:00:00",
        {"bad.toml:6:12: nominal.epoch_tt: a date at which", "1955-01-01", "2099-12-31"}},
       {key + " = \"" + date,
        "epoch_tai = \"2100-01-01T00:00:00",
        {"bad.toml:6:13: nominal.epoch_tai: a date at which", "to 2099-12-31"}},
       // 27 leap seconds: IERS Bulletin C 71.
       {date,
        "2015-12-31T23:59:60",
        {"bad.toml:6:13: nominal.epoch_utc: no leap second then", "UTC had 27", "2016-12-31"}},
       {date, "2023-05-16T06:60:00", {"bad.toml:6:13: nominal.epoch_utc: no moment of the"}},
       {key + " = \"" + date,
        "epoch_tai = \"2016-12-31T23:59:60",
        {"bad.toml:6:13: nominal.epoch_tai: a leap second, which UTC alone has", "TAI"}},
       {"2023-05-16T06:00:00\"\nheight_km = 514\ni_deg = 97.5\nraan_deg = 30\nu_deg = 0\n[jet]\n"
        "order = 1\nduration_s = 600",
        "1960-01-01T00:05:00\"\nheight_km = 514\ni_deg = 97.5\nraan_deg = 30\nu_deg = 0\n[jet]\n"
        "order = 1\nduration_s = -600",
        {"bad.toml:6:13: nominal.epoch_utc: flights that leave the dates", "-600 s"}}});
}

TEST_F(BadEarth, ALeapSecondOfTheEphemerisIsOneOfUtc) {
  const string table =
      "[ephemeris]\nepoch = \"2016-12-31T23:59:60\"\ntime_system = \"GPS\"\n"
      "reference_frame = \"GCRF\"\ncenter_name = \"EARTH\"\n";
  write("bad.toml", small_scene + table);
  expect_error({"check", "bad.toml"}, 3,
               {"ephemeris.epoch: a leap second, which UTC alone has", "GPS"});
}

TEST_F(BadEarth, Fields) {
  write("free.gfc", field_file("tide_system tide_free\n"));
  write("silent.gfc", field_file(""));
  write("mean.gfc", field_file("tide_system mean_tide\n"));
  const string degree = "gravity_degree = 4\n";
  expect_each_refused(
      earth_scene,
      {{degree,
        "gravity_degree = 36\n",
        {"bad.toml:4:18: system.gravity_degree: beyond the field that is built in", "20"}},
       {degree,
        "gravity_degree = 4\ngravity_order = 5\n",
        {"bad.toml:5:17: system.gravity_order: above the degree, got 5"}},
       {degree,
        "gravity_degree = 3\ngravity_file = \"free.gfc\"\n",
        {"bad.toml:4:18: system.gravity_degree: beyond the file's, got 3, must be at most 2",
         "free.gfc"}},
       {degree,
        "gravity_file = \"free.gfc\"\n",
        {"bad.toml:4:16: system.gravity_file: no gravity_degree", "20", "must be at most 2"}},
       {degree,
        "gravity_degree = 2\ngravity_file = \"silent.gfc\"\n",
        {"bad.toml:5:16: system.gravity_file: a file that does not say", "\"unknown\"",
         "tide_system = "}},
       {degree,
        "gravity_degree = 2\ngravity_file = \"mean.gfc\"\n",
        {"bad.toml:5:16: system.gravity_file: a file that does not say", "\"mean_tide\""}},
       {degree,
        "gravity_degree = 2\ngravity_file = \"free.gfc\"\ntide_system = \"zero_tide\"\n",
        {"bad.toml:6:15: system.tide_system: not that of the file", "tide_free"}},
       {degree,
        "tide_system = \"zero_tide\"\n",
        {"bad.toml:4:15: system.tide_system: without a gravity_file"}},
       {"model = \"earth\"\n" + degree,
        "model = \"zonal-gravity\"\ngravity_file = \"free.gfc\"\nhighest_zonal = 3\n",
        {"bad.toml:5:17: system.highest_zonal: beyond the file's, got 3, must be at most 2"}}});
  write("good.toml", changed(earth_scene, degree,
                             "gravity_degree = 2\ngravity_file = \"silent.gfc\"\n"
                             "tide_system = \"zero_tide\"\n"));
  succeed({"check", "good.toml"});
}

TEST_F(BadEarth, Orientation) {
  write("days.txt", orientation_file);
  const string model = "model = \"earth\"\n", file = model + "orientation_file = \"days.txt\"\n";
  const string scene = changed(earth_scene, model, file);
  write("good.toml", scene);
  succeed({"run", "good.toml", "-q"});
  const std::vector<string> words = {"system.orientation_file: days.txt: no Earth orientation for",
                                     "2023-05-16 to 2023-05-17"};
  for (const auto& [from, to] : {std::pair{"2023-05-16", "2024-05-16"},
                                 std::pair{"= 600", "= 86400"}, std::pair{"= 600", "= -86400"}}) {
    SCOPED_TRACE(to);
    write("bad.toml", changed(scene, from, to));
    for (const char* command : {"run", "check"}) {
      expect_error({command, "bad.toml"}, 3, {"bad.toml:4:20: ", words[0], words[1]});
    }
  }
}

TEST_F(BadEarth, AxesOfMessages) {
  const string elements =
      "epoch_utc = \"2023-05-16T06:00:00\"\nheight_km = 514\ni_deg = 97.5\n"
      "raan_deg = 30\nu_deg = 0\n";
  const string scene = changed(earth_scene, elements, "oem_file = \"one.oem\"\n");
  write("scene.toml", scene);
  for (const char* frame : {"GTOD", "RTN", "EFG"}) {
    SCOPED_TRACE(frame);
    write("one.oem", ephemeris_message(frame));
    expect_error({"check", "scene.toml"}, 5,
                 {"one.oem:8: REF_FRAME: a frame that rotates", "or the Earth's own: ITRF"});
  }
  write("one.oem", ephemeris_message("B1950"));
  expect_error({"check", "scene.toml"}, 3,
               {"scene.toml:6:12: nominal.oem_file: axes that are not known", "\"B1950\""});
  write("one.oem", ephemeris_message("ITRF2014"));
  succeed({"check", "scene.toml"});
  // Without the Earth's rotation such a message says nothing.
  write("scene.toml",
        changed(scene, "model = \"earth\"\ngravity_degree = 4\n",
                "model = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = 6378.1363\n"
                "J2 = 1.08262668355315e-3\n"));
  expect_error({"check", "scene.toml"}, 5, {"one.oem:8: REF_FRAME: a frame that rotates"});
}

TEST_F(BadEarth, WhatNeedsAFlowThatIsTheSameAtEveryStart) {
  const string order = "order = 1\n";
  const std::vector<Mistake> mistakes = {
      {order,
       "order = 1\nsymmetry = \"rotation-and-time\"\n",
       {"bad.toml:13:12: jet.symmetry: needs a flow", "must be \"rotation\" or \"none\""}},
      {"[[integrator]]",
       "[bounded]\n[[integrator]]",
       {"bad.toml:14:1: bounded: needs a flow", "zonal-gravity"}},
      {"[[integrator]]",
       "[event]\nsurface = \"equator\"\n[[integrator]]",
       {"bad.toml:14:1: event: needs a flow", "zonal-gravity"}},
      {"[[integrator]]",
       "[deputy]\nposition_m = [0, -300, 0]\n[uncertainty]\nposition_m = [10, 10, 10]\n"
       "velocity_m_s = [0.01, 0.01, 0.01]\ncoordinates = [\"cartesian\", \"flow-box\"]\n"
       "[[integrator]]",
       {"bad.toml:19:", "uncertainty.coordinates", "needs a flow", "must be left out"}}};
  expect_each_refused(earth_scene, mistakes);
  write("bad.toml", earth_scene);
  expect_error({"poincare", "bad.toml"}, 3, {"system.model: its forces depend on the time"});
}

}  // namespace
}  // namespace hamjet::test
