#include <fmt/format.h>

#include <cmath>

#include "orbit_message_test.hpp"

// A transfer that is written as an orbit message with manoeuvres, and flown from it.

namespace hamjet::test {
namespace {

const std::string transfer_scene = R"(schema = 1
title = "a transfer as manoeuvres"
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378.1363
J2 = 1.08262668355315e-3
[nominal]
a_km = 7000
e = 0.01
i_deg = 50
raan_deg = 10
argp_deg = 20
ta_deg = 30
[jet]
order = 3
duration_s = 5000
[transfer]
times_s = [5000]
start = { position_m = [0, -3000, 500] }
end = { position_m = [0, -100, 0] }
[output]
formats = ["opm"]
[ephemeris]
epoch = "2026-02-28T23:00:00.25"
time_system = "TAI"
reference_frame = "TOD"
center_name = "EARTH"
object_name = "CHIEF"
deputy_name = "MOVER"
)";

class ManoeuvreMessages : public OrbitMessages {
 protected:
  /// The last place of the deputy as `hamjet motion` flies the messages of out/a-transfer.
  Json flown_for(double seconds) const {
    write("motion.toml", transfer_scene.substr(0, transfer_scene.find("[nominal]")) +
                             "[nominal]\nopm_file = \"out/a-transfer/chief.opm\"\n"
                             "[deputy]\nopm_file = \"out/a-transfer/deputy.opm\"\n"
                             "[jet]\norder = 2\nduration_s = " +
                             fmt::format("{:.12f}", seconds) + "\n");
    succeed({"motion", "motion.toml", "-q", "-o", "flown"});
    return read_json(directory_ / "flown/summary.json");
  }

  static void expect_arrival(const Json& summary, double tolerance_m) {
    const Json place = summary["end"]["position_m"];
    EXPECT_NEAR(place[0].get<double>(), 0, tolerance_m);
    EXPECT_NEAR(place[1].get<double>(), -100, tolerance_m);
    EXPECT_NEAR(place[2].get<double>(), 0, tolerance_m);
  }
};

TEST_F(ManoeuvreMessages, TwoImpulsesLeadToTheEnd) {
  write("a.toml", transfer_scene);
  succeed({"transfer", "a.toml", "-q", "-o", "out/a-transfer"});
  const std::string text = content(directory_ / "out/a-transfer/deputy.opm");
  EXPECT_NE(text.find("OBJECT_NAME = MOVER\n"), std::string::npos);
  EXPECT_NE(text.find("MAN_EPOCH_IGNITION = 2026-02-28T23:00:00.250000000000\n"
                      "MAN_DURATION = 0.000000000000000e+00 [s]\n"),
            std::string::npos);
  EXPECT_NE(text.find("MAN_REF_FRAME = TOD\n"), std::string::npos);
  const double miss =
      read_table(directory_ / "out/a-transfer/transfers.csv").number(0, "miss_m_order_3");
  // Ignitions are told to a picosecond, in which a spacecraft moves by 8 nm.
  const Json at_arrival = flown_for(5000);
  expect_arrival(at_arrival, miss + 1e-4);
  EXPECT_EQ(at_arrival["manoeuvres"], 1);
  // Behind the second impulse it rests in the turning axes.
  const Json later = flown_for(5001);
  EXPECT_EQ(later["manoeuvres"], 2);
  expect_arrival(later, miss + 2e-3);
  EXPECT_LT(std::abs(later["end"]["velocity_m_s"][1].get<double>()), 1e-3);
}

TEST_F(ManoeuvreMessages, BurnsLeadToTheEnd) {
  for (const std::string attitude : {"RTN", "inertial"}) {
    write("a.toml", transfer_scene +
                        "[thruster]\nthrust_N = 2\nmass_kg = 100\n"
                        "specific_impulse_s = 220\nattitude = \"" +
                        attitude + "\"\n");
    succeed({"transfer", "a.toml", "-q", "-o", "out/a-transfer"});
    const Table burns = read_table(directory_ / "out/a-transfer/burns.csv");
    ASSERT_EQ(burns.rows.size(), 2U);
    const std::string text = content(directory_ / "out/a-transfer/deputy.opm");
    EXPECT_NE(text.find("MASS = 1.000000000000000e+02 [kg]\n"), std::string::npos);
    // The first burn begins before the start, where both messages are then.
    const double first = burns.number(0, "start_s"), last = burns.number(1, "end_s");
    EXPECT_LT(first, 0);
    const Json summary = flown_for(last - first);
    EXPECT_EQ(summary["manoeuvres"], 2);
    // What is told of the end is that of the coasting orbit at 5000 s, half a burn earlier: at rest
    // in the turning axes of an orbit of e = 0.01 it is still there to this.
    expect_arrival(summary, 1);
  }
}

TEST_F(ManoeuvreMessages, OtherCommandsRefuseThem) {
  write("a.toml", transfer_scene);
  succeed({"transfer", "a.toml", "-q", "-o", "out/a-transfer"});
  write("b.toml", changed(transfer_scene,
                          "a_km = 7000\ne = 0.01\ni_deg = 50\nraan_deg = 10\n"
                          "argp_deg = 20\nta_deg = 30\n",
                          "opm_file = \"out/a-transfer/chief.opm\"\n") +
                      "[deputy]\nopm_file = \"out/a-transfer/deputy.opm\"\n");
  expect_error({"transfer", "b.toml"}, 3,
               {"deputy.opm_file: a message with manoeuvres, got 2, which `hamjet motion` alone"});
  // What refuses them is not listed as a command for the scene.
  EXPECT_NE(succeed({"check", "b.toml"}).out.find("commands     motion\n"), std::string::npos);
  EXPECT_EQ(Json::parse(succeed({"check", "b.toml", "--json"}).out)["commands"], Json({"motion"}));
  write("c.toml", changed(transfer_scene, "{ position_m = [0, -3000, 500] }",
                          "{ opm_file = \"out/a-transfer/deputy.opm\" }"));
  expect_error({"check", "c.toml"}, 3, {"transfer.start.opm_file: a message with 2 manoeuvres"});
}

// A burn of a moment is the impulse in its middle, and none is left out by the scene's end.
TEST_F(ManoeuvreMessages, ABurnOfAMomentIsAnImpulse) {
  write("a.toml", transfer_scene);
  succeed({"transfer", "a.toml", "-q", "-o", "out/a-transfer"});
  const std::string impulses = content(directory_ / "out/a-transfer/deputy.opm");
  write("out/a-transfer/deputy.opm",
        changed(impulses, "MAN_DURATION = 0.000000000000000e+00 [s]", "MAN_DURATION = 1e-3 [s]"));
  const Json flown = flown_for(5000);
  EXPECT_EQ(flown["manoeuvres"], 1);
  // It is half a millisecond later, in which the change of some metres a second moves by
  // millimetres.
  expect_arrival(flown, 0.05);
  write("short.toml", transfer_scene.substr(0, transfer_scene.find("[nominal]")) +
                          "[nominal]\nopm_file = \"out/a-transfer/chief.opm\"\n"
                          "[deputy]\nopm_file = \"out/a-transfer/deputy.opm\"\n"
                          "[jet]\norder = 2\nduration_s = 4000\n");
  expect_error(
      {"motion", "short.toml"}, 3,
      {"deputy.opm_file: a manoeuvre that ends 5000 s after the start, got a scene of 4000 s"});
}

// The standard's example without its elements, which are not those of its state.
TEST_F(ManoeuvreMessages, WhatCannotBeFlownIsSaidWithItsLine) {
  const std::string whole = io::standard_opm;
  const std::string opm = whole.substr(0, whole.find("COMMENT Keplerian")) +
                          whole.substr(whole.find("COMMENT Spacecraft"));
  write("opm.toml", from_message("opm_file = \"bad.opm\"\n"));
  const auto refuse = [&](const std::string& message, const std::string& words) {
    write("bad.opm", message);
    expect_error({"check", "opm.toml"}, 3,
                 {"nominal.opm_file: a manoeuvre that cannot be flown, got one " + words});
  };
  refuse(opm + io::standard_maneuver,
         "along EME2000 in bad.opm:33, must be along the axes of the state, TOD, or RTN or TNW");
  const std::string along = changed(io::standard_maneuver, "EME2000", "TNW");
  refuse(opm + changed(along, "2021-06-03T09", "2021-06-02T09"), "before EPOCH in bad.opm:33");
  refuse(changed(opm, "1913.000", "18.4") + along, "that takes 18.418 of 18.4 kg in bad.opm:33");
  refuse(changed(opm, "MASS             =    1913.000             [kg]\n", "") + along,
         "that takes mass of a spacecraft without MASS in bad.opm:32, must be beside MASS");
  refuse(opm + along + along,
         "before the manoeuvre above it ends in bad.opm:43, must be behind it");
  write("bad.opm", opm + along);
  expect_error({"run", "opm.toml"}, 3,
               {"nominal.opm_file: a message with manoeuvres, got 1, which `hamjet motion` alone "
                "flies; must be without, or beside manoeuvres = \"leave-out\""});
  succeed({"run", "opm.toml", "-q", "--set", "nominal.manoeuvres=\"leave-out\""});
}

}  // namespace
}  // namespace hamjet::test
