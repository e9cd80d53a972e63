#include "formats/xml/orbit_message_xml.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "../scene/scene_samples.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "orbit_message_samples.hpp"
#include "orbit_message_xml_samples.hpp"
#include "support/temporary_directory.hpp"

// Messages in XML notation: the standard's own examples say the same in both, and what is damaged
// is refused with the line of the element.

namespace hamjet::io {
namespace {

class OrbitMessageXml : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_xml_built()) GTEST_SKIP() << "a build without XML";
  }
};

const auto oem_of = [](const std::string& name, const std::string& text) {
  return read_oem(name, text);
};
const auto opm_of = [](const std::string& name, const std::string& text) {
  return read_opm(name, text);
};

/// The changed text must be refused with these words.
template <class Read>
void expect_refused(const Read& read, const std::string& text, const std::string& words) {
  try {
    read("a.xml", text);
    ADD_FAILURE() << "not refused: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_output);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos)
        << error.what() << "\nlacks: " << words;
  }
}

TEST(OrbitMessageNotation, XmlIsReadOrRefusedWithItsOption) {
  if (is_xml_built()) {
    EXPECT_EQ(read_oem("a.xml", standard_oem_xml).segments.size(), 2U);
  } else {
    expect_refused(oem_of, standard_oem_xml, "a.xml:1: XML notation, got \"<\" at the start, must");
  }
}

// A combined message holds both examples of the standard, one of them twice, and other messages.
TEST_F(OrbitMessageXml, OfACombinedMessageTheKindThatIsWantedIsRead) {
  const auto body = [](const std::string& text) { return text.substr(text.find("?>") + 2); };
  const std::string oem = body(standard_oem_xml), opm = body(standard_opm_xml);
  const auto combined = [](const std::string& messages) {
    return "<?xml version=\"1.0\"?>\n<ndm>\n<MESSAGE_ID>1</MESSAGE_ID><COMMENT>all</COMMENT>" +
           messages + "</ndm>\n";
  };
  const std::string all = combined(oem + opm + "<cdm/>" + oem);
  EXPECT_EQ(opm_text(read_opm("a.xml", all)), opm_text(read_opm("a.xml", standard_opm_xml)));
  const OrbitEphemerisMessage one = read_oem("a.xml", standard_oem_xml);
  const OrbitEphemerisMessage two = read_oem("a.xml", all);
  EXPECT_EQ(oem_text(read_oem("a.xml", combined(oem))), oem_text(one));
  ASSERT_EQ(two.segments.size(), 2 * one.segments.size());
  EXPECT_EQ(two.segments[2].states.size(), one.segments[0].states.size());
  expect_refused(oem_of, combined(opm), "a.xml:2: ndm: got no oem in it, must have one");
  expect_refused(opm_of, combined(opm + opm), "opm: got a second opm, must be one state");
  expect_refused(oem_of, combined(oem + changed(oem, "version=\"", "version=\"1")),
                 "oem: another version than the first one, got CCSDS_OEM_VERS = 1");
  expect_refused(oem_of, combined("<eom/>"), "eom: unknown element in ndm, did you mean oem?");
}

// A message written in XML is the same as in KVN, to the last digit, and marks of XML in texts are
// escaped.
TEST_F(OrbitMessageXml, WrittenAndReadAgainIsTheSame) {
  OrbitEphemerisMessage ephemeris = read_oem("a.oem", standard_oem);
  ephemeris.segments[0].metadata.object_name = "A & B <C> \"D\"";
  ephemeris.segments[0].comments = {"x < y & z"};
  ephemeris.segments[1].states[0].position_km = {1.0 / 3, -1e-7 / 3, 2e5 / 3};
  const std::string written = oem_xml(ephemeris);
  ephemeris.comments.clear();
  ephemeris.segments[0].comments.clear();
  EXPECT_EQ(oem_text(read_oem("a.xml", written)), oem_text(read_oem("b.oem", oem_text(ephemeris))));
  EXPECT_NE(written.find("<COMMENT>x &lt; y &amp; z</COMMENT>"), std::string::npos);
  EXPECT_NE(written.find("<X units=\"km\">"), std::string::npos);
  EXPECT_NE(written.find("<Z_DOT units=\"km/s\">"), std::string::npos);
  OrbitParameterMessage state = read_opm("a.opm", standard_opm);
  const std::string one = opm_xml(state);
  EXPECT_EQ(opm_text(read_opm("a.xml", one)), opm_text(state));
}

TEST_F(OrbitMessageXml, TheStandardsEphemerisSaysTheSameInBothNotations) {
  const OrbitEphemerisMessage xml = read_oem("a.xml", standard_oem_xml);
  const OrbitEphemerisMessage lines = read_oem("a.oem", standard_oem);
  EXPECT_EQ(oem_text(xml), oem_text(lines));
  ASSERT_EQ(xml.segments.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(xml.segments[i].has_acceleration, lines.segments[i].has_acceleration);
    EXPECT_EQ(xml.segments[i].has_covariance, lines.segments[i].has_covariance);
    EXPECT_EQ(xml.segments[i].useable_start, lines.segments[i].useable_start);
    EXPECT_EQ(xml.segments[i].useable_stop, lines.segments[i].useable_stop);
    for (std::size_t k = 0; k < xml.segments[i].states.size(); ++k) {
      EXPECT_EQ(xml.segments[i].states[k].position_km, lines.segments[i].states[k].position_km);
      EXPECT_EQ(xml.segments[i].states[k].velocity_km_s, lines.segments[i].states[k].velocity_km_s);
    }
  }
}

TEST_F(OrbitMessageXml, TheStandardsParametersSayTheSameInBothNotations) {
  const OrbitParameterMessage xml = read_opm("a.xml", standard_opm_xml);
  const OrbitParameterMessage lines = read_opm("a.opm", standard_opm);
  EXPECT_EQ(opm_text(xml), opm_text(lines));
  EXPECT_EQ(xml.unused, lines.unused);
  EXPECT_EQ(xml.gm_km3_s2, lines.gm_km3_s2);
  EXPECT_EQ(xml.gm_line, 33U);
  EXPECT_EQ(xml.metadata.center_name_line, 12U);
  // The text has no units, line ends of Windows, a byte order mark and an element of another
  // namespace.
  std::string plain = "\xef\xbb\xbf";
  plain += changed(standard_opm_xml, "</data>",
                   "<userDefinedParameters><USER_DEFINED parameter=\"COLOUR\">red</USER_DEFINED>"
                   "</userDefinedParameters>\r\n</data>");
  plain = changed(plain, " units=\"km\"", "");
  const OrbitParameterMessage other = read_opm("a.xml", plain);
  EXPECT_EQ(opm_text(other), opm_text(lines));
  EXPECT_EQ(other.unused.back(), "user-defined parameters");
}

TEST_F(OrbitMessageXml, ManoeuvresAreTheSameInBothNotations) {
  const OrbitParameterMessage lines =
      read_opm("a.opm", std::string(standard_opm) + standard_maneuver);
  const OrbitParameterMessage xml = read_opm("a.xml", opm_xml(lines));
  ASSERT_EQ(xml.manoeuvres.size(), 1U);
  EXPECT_EQ(opm_text(xml), opm_text(lines));
}

TEST_F(OrbitMessageXml, ParametersAreRefusedByLineAndElement) {
  const auto refuse = [](const char* from, const char* to, const std::string& words) {
    expect_refused(opm_of, changed(standard_opm_xml, from, to), words);
  };
  refuse("X units=\"km\"", "X units=\"m\"", "a.xml:19: X: wrong unit, got \"m\", must be \"km\"");
  refuse("GM units=\"km**3/s**2\"", "GM units=\"m**3/s**2\"",
         "a.xml:33: GM: wrong unit, got \"m**3/s**2\", must be \"km**3/s**2\"");
  refuse("<OBJECT_NAME>", "<OBJECT_NAME units=\"km\">",
         "OBJECT_NAME: a text with a unit, got \"km\"");
  refuse("<X units=\"km\">6655.9942</X>", "<X>6655.9942 [km]</X><W>1</W>", "a.xml:19: W: unknown");
  refuse("6655.9942", "x", "a.xml:19: X: no number, got \"x\"");
  refuse("6655.9942", "", "a.xml:19: X: empty");
  refuse("6655.9942", "<A/>", "a.xml:19: X: got elements or comments within");
  refuse("6655.9942", "66<!-- -->55", "a.xml:19: X: ");
  refuse("<X units=\"km\">6655.9942</X>", "", ": X: missing, got nothing up to here");
  refuse(">TOD<", ">ITRF2000<", "a.xml:13: REF_FRAME: a frame that rotates, got \"ITRF2000\"");
  refuse(">EARTH<", ">\xc3\x84RTH<", "a.xml:12: not a text, got the byte 0xc3");
  refuse("keplerianElements>\n<SEMI", "maneuver>\n<SEMI", "a.xml:34: no XML, got an error of");
  refuse("<spacecraftParameters>",
         "<maneuverParameters><MAN_DV_1>1</MAN_DV_1></maneuverParameters><spacecraftParameters>",
         "MAN_EPOCH_IGNITION: missing, got nothing up to here");
  refuse("<spacecraftParameters>",
         "<maneuverParameters><MAN_EPOCH_IGNITION>2022-01-01T00:00:00</MAN_EPOCH_IGNITION>"
         "<MAN_DURATION units=\"min\">1</MAN_DURATION></maneuverParameters><spacecraftParameters>",
         "a.xml:35: MAN_DURATION: wrong unit, got \"min\", must be \"s\"");
  refuse("</header>", "</header>text", "a.xml:2: opm: got the text \"text\" between elements");
  refuse("version=\"3.0\">", "version=\"4.0\">",
         "a.xml:2: CCSDS_OPM_VERS: unknown version, got \"4.0\"");
  refuse("</segment>", "</segment><segment/>", "a.xml:7: body: got 2 segments, must have one");
  refuse("<data>", "<data><x/>", "a.xml:16: x: unknown element in data, must be one of: stateV");
  refuse("</opm>\n", "</opm>\n<opm/>", "a.xml:46: opm: got a second root");
  expect_refused(opm_of, "<secret></secret>",
                 "a.xml:1: no orbit message, got XML with another root, must be opm or ndm");
  expect_refused(opm_of, "<opm id=\"CCSDS_OPM_VERS\" version=\"3.0\"/>",
                 "a.xml:1: opm: incomplete, must have one header and one body");
  expect_refused(opm_of, "  <", "a.xml:1: no XML");
  expect_refused(
      opm_of, standard_oem_xml,
      "a.xml:2: CCSDS_OPM_VERS: missing, got an orbit ephemeris message (OEM), which the "
      "key oem_file of");
}

TEST_F(OrbitMessageXml, EphemeridesAreRefusedByLineAndElement) {
  const auto refuse = [](const char* from, const char* to, const std::string& words) {
    expect_refused(oem_of, changed(standard_oem_xml, from, to), words);
  };
  refuse("X_DOT units=\"km/s\">4.73372", "X_DOT units=\"m/s\">4.73372",
         "a.xml:27: X_DOT: wrong unit, got \"m/s\", must be \"km/s\"");
  refuse("Z_DDOT units=\"km/s**2\"", "Z_DDOT units=\"km/s\"",
         "Z_DDOT: wrong unit, got \"km/s\", must be \"km/s**2\"");
  refuse("CX_X units=\"km**2\"", "CX_X units=\"m**2\"", "CX_X: wrong unit, got \"m**2\"");
  refuse("<X>2783.419</X>", "", "a.xml:31: Y: out of place in a stateVector, must be X here");
  refuse("2783.419", "2783 .419", "a.xml:31: X: got \"2783 .419\", must be one number");
  refuse("2783.419", "2783x", "a.xml:29: no number, got \"2783x\"");
  refuse("<EPOCH>2019-12-18T12:01:00.331", "<EPOCH>2019-12-18T11:01:00.331",
         "a.xml:29: an epoch outside of the span");
  refuse("<EPOCH>2019-12-18T12:02:00.331", "<EPOCH>2019-12-18T12:00:30.331",
         "a.xml:34: epochs out of order");
  refuse(" <Z_DDOT units=\"km/s**2\">0.3</Z_DDOT>", "", "stateVector: got 9 elements, must be an");
  refuse("<START_TIME>2019-12-18T12:00:00.331</START_TIME>\n", "",
         "a.xml:20: START_TIME: missing, got nothing up to here");
  refuse("<COV_REF_FRAME>", "<FRAME/><COV_REF_FRAME>", ": FRAME: unknown keyword here");
  refuse("3.3313494e-04", "3.33x", "no number, got \"3.33x\"");
}

TEST_F(OrbitMessageXml, CutOffAnywhereItIsRefused) {
  const std::string whole = standard_opm_xml;
  for (std::size_t length = 1; length + 2 < whole.size(); ++length) {
    EXPECT_THROW(read_opm("a.xml", whole.substr(0, length)), Error) << length;
  }
}

TEST_F(OrbitMessageXml, ASceneStartsFromIt) {
  test::TemporaryDirectory directory;
  std::ofstream(directory.path() / "start.xml") << standard_opm_xml;
  std::ofstream(directory.path() / "start.opm") << standard_opm;
  const auto nominal_of = [&](const std::string& file) {
    return parse_scene(changed(orbit, "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n",
                               "opm_file = \"" + file + "\"\n"),
                       (directory.path() / "scene.toml").string())
        .nominal;
  };
  EXPECT_EQ(nominal_of("start.xml"), nominal_of("start.opm"));
}

}  // namespace
}  // namespace hamjet::io
