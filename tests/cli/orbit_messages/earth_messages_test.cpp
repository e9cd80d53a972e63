#include <cmath>

#include "hamjet/formats/orbit_message.hpp"
#include "orbit_message_test.hpp"

// What scenes about the real Earth write, in the axes that they ask for and across a leap second.

namespace hamjet::test {
namespace {

const std::string across_a_leap_second = R"([system]
model = "earth"
gravity_degree = 4
[nominal]
epoch_utc = "2016-12-31T23:59:30"
axes = "ITRF"
position_km = [4400, 3300, 5000]
velocity_km_s = [-4.2, 5.2, 0.5]
[jet]
order = 1
duration_s = 60
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
step_s = 20
[output]
formats = ["oem", "opm"]
[ephemeris]
object_name = "ONE"
)";

using EarthMessages = CommandTest;

// 20 s after 23:59:50 it is 00:00:09, for that day had a second 60 (IERS Bulletin C 52).
TEST_F(EarthMessages, AreDatedAcrossALeapSecondAndTurned) {
  write("scene.toml", across_a_leap_second);
  succeed({"run", "scene.toml", "-q", "-o", "out"});
  const auto message = io::read_oem("nominal.oem", content(directory_ / "out/gauss8/nominal.oem"),
                                    io::AcceptedFrames::terrestrial_too);
  ASSERT_EQ(message.segments.size(), 1U);
  const auto& segment = message.segments[0];
  EXPECT_EQ(segment.metadata.reference_frame, "ITRF");
  EXPECT_EQ(segment.metadata.object_name, "ONE");
  ASSERT_EQ(segment.states.size(), 4U);
  EXPECT_EQ(format_epoch(segment.states[1].epoch), "2016-12-31T23:59:50.000000000000");
  EXPECT_EQ(format_epoch(segment.states[2].epoch), "2017-01-01T00:00:09.000000000000");
  EXPECT_EQ(format_epoch(segment.states[3].epoch), "2017-01-01T00:00:29.000000000000");
  const std::vector<double> start = {4400, 3300, 5000, -4.2, 5.2, 0.5};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(segment.states[0].position_km[i], start[i], 1e-11);
    EXPECT_NEAR(segment.states[0].velocity_km_s[i], start[3 + i], 1e-14);
    // The velocities are those of the coordinates: central differences to 20 s, whose error is the
    // third derivative's, some 7000 km (1e-3 rad/s)^3 (20 s)^2 / 6.
    const double slope = (segment.states[2].position_km[i] - segment.states[0].position_km[i]) / 40;
    EXPECT_NEAR(segment.states[1].velocity_km_s[i], slope, 1e-3);
  }
  const auto end = io::read_opm("end.opm", content(directory_ / "out/gauss8/end.opm"),
                                io::AcceptedFrames::terrestrial_too);
  EXPECT_EQ(end.state.position_km, segment.states[3].position_km);
}

// A scene that begins where another one ends flies on: the end of both is the same state.
TEST_F(EarthMessages, AreReadAgainInTheirAxes) {
  // The scene starts after the leap second, because without a table UT1 = UTC at each scene's own
  // start.
  const std::string whole =
      changed(across_a_leap_second, "2016-12-31T23:59:30", "2017-01-01T00:01:00");
  write("first.toml", changed(whole, "duration_s = 60", "duration_s = 20"));
  succeed({"run", "first.toml", "-q", "-o", "first"});
  write("whole.toml", whole);
  succeed({"run", "whole.toml", "-q", "-o", "whole"});
  const std::string keys =
      whole.substr(whole.find("epoch_utc"), whole.find("[jet]") - whole.find("epoch_utc"));
  write("second.toml", changed(changed(whole, keys, "opm_file = \"first/gauss8/end.opm\"\n"),
                               "duration_s = 60", "duration_s = 40"));
  succeed({"run", "second.toml", "-q", "-o", "second"});
  const auto state_at = [&](const std::string& run) {
    return io::read_opm(run, content(directory_ / run / "gauss8/end.opm"),
                        io::AcceptedFrames::terrestrial_too);
  };
  const auto expected = state_at("whole"), found = state_at("second");
  EXPECT_EQ(found.metadata.reference_frame, "ITRF");
  EXPECT_EQ(format_epoch(found.state.epoch), format_epoch(expected.state.epoch));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.state.position_km[i], expected.state.position_km[i], 1e-10) << i;
    EXPECT_NEAR(found.state.velocity_km_s[i], expected.state.velocity_km_s[i], 1e-13) << i;
  }
}

}  // namespace
}  // namespace hamjet::test
