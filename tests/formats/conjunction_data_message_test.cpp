#include "hamjet/formats/conjunction_data_message.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "formats/xml/orbit_message_xml.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "orbit_message_samples.hpp"
#include "orbit_message_xml_samples.hpp"
#include "support/errors.hpp"
#include "support/text.hpp"

namespace hamjet::io {
namespace {

std::string conjunction(const std::string& name = "conjunction.cdm") {
  std::ifstream file(HAMJET_SOURCE_DIR "/tests/fuzz/corpus/orbit_message/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ConjunctionDataMessage, IsReadWithItsUnits) {
  const ConjunctionDataMessage message = read_cdm("a.cdm", conjunction());
  EXPECT_EQ(message.originator, "JSPOC");
  EXPECT_EQ(format_epoch(message.tca).substr(0, 23), "2010-03-13T22:37:52.618");
  EXPECT_EQ(message.miss_distance_m, 715);
  ASSERT_TRUE(message.relative_position_m && message.relative_velocity_m_s);
  EXPECT_EQ((*message.relative_position_m)[2], 711.8);
  EXPECT_EQ((*message.relative_velocity_m_s)[1], -14692);
  EXPECT_EQ(message.collision_probability, 4.835e-5);
  EXPECT_EQ(message.collision_probability_method, "FOSTER-1992");
  const ConjunctionObject& first = message.objects[0];
  EXPECT_EQ(first.object_name, "SATELLITE A");
  EXPECT_EQ(first.orbit_center, "EARTH");
  EXPECT_EQ(first.reference_frame, "EME2000");
  EXPECT_EQ(first.position_km[2], 6281.497978);
  EXPECT_EQ(first.velocity_km_s[0], 4.418769571);
  EXPECT_EQ(first.covariance[0][0], 41.42);
  EXPECT_EQ(first.covariance[3][1], -2.476);
  EXPECT_EQ(first.covariance[1][3], -2.476);
  EXPECT_EQ(first.covariance[5][5], 5.529e-5);
  EXPECT_EQ(message.objects[1].covariance[1][1], 2.492e6);
}

TEST(ConjunctionDataMessage, IsTheSameWhenItIsWrittenAndReadAgain) {
  const std::string once = cdm_text(read_cdm("a.cdm", conjunction()));
  EXPECT_EQ(cdm_text(read_cdm("b.cdm", once)), once);
  // The expected text is as an independent reader of KVN would take it: keyword, equals sign,
  // value, unit in brackets.
  EXPECT_NE(once.find("CRDOT_T                              = -2.476000000000000e+00 [m**2/s]\n"),
            std::string::npos);
  EXPECT_NE(once.find("MISS_DISTANCE                        = 7.150000000000000e+02 [m]\n"),
            std::string::npos);
}

TEST(ConjunctionDataMessage, IsRefusedWithLineAndKeyword) {
  const auto read = [](const std::string& text) { read_cdm("a.cdm", text); };
  struct Damage {
    const char* from;
    const char* to;
    std::vector<std::string> words;
  };
  const std::vector<Damage> damages = {
      {"= 1.0", "= 2.0", {"a.cdm:1: CCSDS_CDM_VERS", "1.0"}},
      {"CCSDS_CDM_VERS", "CCSDS_OEM_VERS", {"a.cdm:1", "CCSDS_CDM_VERS"}},
      {"CRDOT_T    ", "CRDOT_X    ", {"CRDOT_X: unknown keyword here"}},
      {"-2.476E+00 [m**2/s]", "-2.476E+00 [km**2/s]", {"CRDOT_T", "m**2/s"}},
      {"4.142E+01", "nan", {"CR_R"}},
      {"OBJECT2\n", "OBJECT3\n", {"OBJECT: missing, got \"OBJECT3\", must be OBJECT2 here"}},
      {"= EME2000", "= TEME", {"REF_FRAME: unknown reference frame, got \"TEME\""}},
      {"TCA  ", "TCB  ", {"TCB: unknown keyword here"}}};
  for (const Damage& damage : damages) {
    test::expect_error([&] { read(test::changed(conjunction(), damage.from, damage.to)); },
                       ErrorKind::input_output, damage.words, damage.from);
  }
  const std::string whole = conjunction();
  const std::string one =
      whole.substr(0, whole.find("OBJECT                             = OBJECT2"));
  test::expect_error([&] { read(one); }, ErrorKind::input_output, {"the end of the file"}, "one");
  test::expect_error([&] { read(whole + one.substr(one.find("OBJECT    "))); },
                     ErrorKind::input_output, {"a third object"}, "three");
  if (!is_xml_built()) return;
  test::expect_error([&] { read("<?xml version=\"1.0\"?><cdm/>"); }, ErrorKind::input_output,
                     {"a.cdm:1: cdm: incomplete"}, "XML");
}

// The same example in both notations of the standard.
TEST(ConjunctionDataMessage, IsTheSameInXml) {
  if (!is_xml_built()) GTEST_SKIP();
  const std::string xml = conjunction("conjunction-xml.cdm");
  const ConjunctionDataMessage message = read_cdm("a.xml", xml);
  EXPECT_EQ(cdm_text(message), cdm_text(read_cdm("a.cdm", conjunction())));
  EXPECT_TRUE(message.doubts.empty());
  const auto refuse = [&](const std::string& from, const std::string& to, const char* words) {
    test::expect_error([&] { read_cdm("a.xml", test::changed(xml, from, to)); },
                       ErrorKind::input_output, {words}, from);
  };
  refuse("<CR_R units=\"m**2\">", "<CR_R units=\"km**2\">", "CR_R: wrong unit, got \"km**2\"");
  refuse("<odParameters>", "<odParameter>", "no XML, got an error of syntax");
  refuse("<additionalParameters>\n", "<additionalParameters/><extra/><additionalParameters>\n",
         "extra: unknown element in data");
  refuse("</segment>\n<segment>", "</segment>\n<segment/>\n<segment>", "body: incomplete");
  refuse("<OBJECT>OBJECT2", "<OBJECT>OBJECT3", "must be OBJECT2 here");
  // The message is within a combined message, which must contain a single conjunction.
  const std::string body = xml.substr(xml.find("<cdm"));
  EXPECT_EQ(cdm_text(read_cdm("a.xml", "<ndm>" + body + "</ndm>")), cdm_text(message));
  test::expect_error([&] { read_cdm("a.xml", "<ndm>" + body + body + "</ndm>"); },
                     ErrorKind::input_output, {"cdm: got a second cdm"}, "two");
}

// A mistake in optional numbers that are not used does not keep the covariance from being read.
TEST(ConjunctionDataMessage, WhatIsWrongWithUnusedNumbersIsADoubt) {
  std::string text = test::changed(conjunction(), "-14692.0        [m/s]", "-14692.0        [m]");
  text = test::changed(text, "4.835E-05", "1.5");
  text = test::changed(text, "TIME_LASTOB_START                  = 2010-03-12T02:14:12.746",
                       "TIME_LASTOB_START                  =");
  text = test::changed(text, "4.142E+01", "4.142D+01");
  text = test::changed(text, "= EME2000", "= J2000");
  const ConjunctionDataMessage message = read_cdm("a.cdm", text);
  EXPECT_EQ(message.objects[0].covariance[0][0], 41.42);
  EXPECT_EQ(message.objects[0].reference_frame, "EME2000");
  EXPECT_FALSE(message.relative_velocity_m_s);
  EXPECT_FALSE(message.collision_probability);
  EXPECT_EQ(message.doubts,
            (std::vector<std::string>{
                "a.cdm:14: RELATIVE_VELOCITY_T: wrong unit, got \"[m]\", must be [m/s]; it is not "
                "used",
                "a.cdm:23: COLLISION_PROBABILITY: no probability, got 1.5, must be from 0 to 1; it "
                "is not used"}));
  // A required number may not be empty.
  test::expect_error([&] { read_cdm("a.cdm", test::changed(text, "4.142D+01 [m**2]", "")); },
                     ErrorKind::input_output, {"CR_R: empty"}, "CR_R");
}

// The covariance of the standard's example, figure G-8: numbers of its lower triangle.
TEST(OrbitMessageCovariance, IsReadFromAnEphemeris) {
  const OrbitEphemerisMessage message = read_oem("a.oem", standard_oem);
  EXPECT_TRUE(message.segments[0].covariances.empty());
  ASSERT_EQ(message.segments[1].covariances.size(), 1u);
  const OrbitCovariance& covariance = message.segments[1].covariances[0];
  EXPECT_EQ(covariance.reference_frame, "EME2000");
  EXPECT_EQ(format_epoch(covariance.epoch).substr(0, 23), "2019-12-28T21:29:07.267");
  EXPECT_EQ(covariance.line, 42u);
  EXPECT_EQ(covariance.matrix[0][0], 3.3313494e-04);
  EXPECT_EQ(covariance.matrix[2][1], -4.2212341e-04);
  EXPECT_EQ(covariance.matrix[1][2], -4.2212341e-04);
  EXPECT_EQ(covariance.matrix[5][3], 1.8692631e-10);
  EXPECT_EQ(covariance.matrix[5][5], 6.2244443e-10);
}

TEST(OrbitMessageCovariance, HasTheStatesAxesWhereItHasNoneOfItsOwn) {
  const std::string text = test::changed(standard_oem, "COV_REF_FRAME = EME2000\n", "");
  const OrbitEphemerisMessage message = read_oem("a.oem", text);
  EXPECT_EQ(message.segments[1].covariances[0].reference_frame,
            message.segments[1].metadata.reference_frame);
  const std::string rtn =
      test::changed(standard_oem, "COV_REF_FRAME = EME2000\n", "COV_REF_FRAME = rtn\n");
  EXPECT_EQ(read_oem("a.oem", rtn).segments[1].covariances[0].reference_frame, "RTN");
}

TEST(OrbitMessageCovariance, OfAWrongShapeIsRefused) {
  const auto refuse = [](const std::string& from, const std::string& to, const char* words) {
    test::expect_error([&] { read_oem("a.oem", test::changed(standard_oem, from, to)); },
                       ErrorKind::input_output, {words}, from);
  };
  refuse("4.6189273e-04 6.7824216e-04\n", "4.6189273e-04\n",
         "wrong length, got 1 numbers in row 2");
  refuse("4.6189273e-04 6.7824216e-04\n", "", "wrong length, got 3 numbers in row 2");
  refuse("COVARIANCE_STOP", "1 2 3 4 5 6\nCOVARIANCE_STOP", "must be COVARIANCE_STOP");
  refuse("-3.0413460e-07 -4.9894969e-07 3.5403109e-07 1.8692631e-10 1.0088625e-10 6.2244443e-10\n",
         "", "a covariance of 5 rows");
  refuse("EPOCH = 2019-12-28T21:29:07.267\nCOV_REF_FRAME = EME2000\n", "", "EPOCH: missing");
}

TEST(OrbitMessageCovariance, IsTheSameInXml) {
  if (!is_xml_built()) GTEST_SKIP();
  const auto lines = read_oem("a.oem", standard_oem).segments[1].covariances;
  const auto xml = read_oem("a.xml", standard_oem_xml).segments[1].covariances;
  ASSERT_EQ(lines.size(), xml.size());
  EXPECT_EQ(lines[0].matrix, xml[0].matrix);
  EXPECT_EQ(lines[0].reference_frame, xml[0].reference_frame);
  EXPECT_EQ(lines[0].epoch, xml[0].epoch);
}

}  // namespace
}  // namespace hamjet::io
