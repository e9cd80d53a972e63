#include <cmath>

#include "formats/xml/orbit_message_xml.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "orbit_message_test.hpp"

// The two ends of a nominal as Orbit Parameter Messages.

namespace hamjet::test {
namespace {

const std::string dated_ends = changed(dated, "[\"oem\"]", "[\"opm\"]");

/// A scene whose nominal starts from a message.
std::string from_its_end(const std::string& file) {
  return "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\nopm_file = \"" + file +
         "\"\n[jet]\norder = 1\nduration_s = 60\n";
}

using OrbitMessageEnds = CommandTest;

// What is written is read again as another scene's nominal, with the digits that the standard
// allows: one starts where the other started, or where it ended.
TEST_F(OrbitMessageEnds, TheEndsAreWrittenAndReadAgain) {
  write("ends.toml", quick_scene() + dated_ends);
  succeed({"run", "ends.toml", "-q", "-o", "ends"});
  const Json first = read_json(directory_ / "ends/summary.json");
  const double length = first["units"]["length_km"], time = first["units"]["time_s"];
  const auto expect_state = [&](const std::string& message, const Json& state) {
    write("again.toml", from_its_end("ends/gauss8/" + message) +
                            "[units]\nlength_km = " + std::to_string(length) + "\n");
    succeed({"run", "again.toml", "-q", "-o", "again"});
    const Json again = read_json(directory_ / "again/summary.json");
    EXPECT_EQ(again["nominal_file"]["format"], "OPM 2.0");
    const double other_length = again["units"]["length_km"], other_time = again["units"]["time_s"];
    for (std::size_t i = 0; i < 6; ++i) {
      const double unit = i < 3 ? length : length / time;
      const double other_unit = i < 3 ? other_length : other_length / other_time;
      const double expected = state[i].get<double>() * unit;
      const double found = again["nominal_initial"][i].get<double>() * other_unit;
      EXPECT_NEAR(found, expected, 3e-15 * std::abs(expected)) << message << " " << i;
    }
    return again["ephemeris"]["epoch"].get<std::string>();
  };
  EXPECT_EQ(expect_state("start.opm", first["nominal_initial"]),
            "2026-02-28T23:59:50.500000000000");
  EXPECT_GT(expect_state("end.opm", first["runs"][0]["nominal_final"]),
            "2026-03-01T00:00:00.000000000000");
  const std::string text = content(directory_ / "ends/gauss8/end.opm");
  EXPECT_EQ(text.rfind("CCSDS_OPM_VERS = 2.0\n", 0), 0U);
  EXPECT_NE(text.find("\nOBJECT_NAME = CHIEF\n"), std::string::npos);
  EXPECT_NE(text.find(" [km/s]\n"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "ends/gauss8/nominal.oem"));
}

// Both notations say the same of the motion and of its ends.
TEST_F(OrbitMessageEnds, AreTheSameInXml) {
  if (!io::is_xml_built()) GTEST_SKIP() << "a build without XML";
  write("ends.toml", changed(quick_scene() + dated_ends, "[\"opm\"]",
                             "[\"opm\", \"opm-xml\", \"oem\", \"oem-xml\"]"));
  succeed({"run", "ends.toml", "-q", "-o", "ends"});
  const std::filesystem::path folder = directory_ / "ends/gauss8";
  for (const std::string name : {"start.opm", "end.opm"}) {
    io::OrbitParameterMessage lines = io::read_opm(name, content(folder / name));
    const auto xml = io::read_opm(name, content(folder / (name + ".xml")));
    lines.creation_date = xml.creation_date;
    EXPECT_EQ(io::opm_text(xml), io::opm_text(lines)) << name;
  }
  io::OrbitEphemerisMessage lines = io::read_oem("a", content(folder / "nominal.oem"));
  const auto xml = io::read_oem("a", content(folder / "nominal.oem.xml"));
  lines.creation_date = xml.creation_date;
  EXPECT_EQ(io::oem_text(xml), io::oem_text(lines));
  EXPECT_GT(xml.segments.at(0).states.size(), 1U);
}

}  // namespace
}  // namespace hamjet::test
