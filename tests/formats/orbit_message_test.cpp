#include "hamjet/formats/orbit_message.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "../scene/scene_samples.hpp"
#include "orbit_message_samples.hpp"

// Orbit messages, read and written: the standard's own examples, what is written read back, and
// every kind of damage.

namespace hamjet::io {
namespace {

using Vector = std::array<double, 3>;

TEST(OrbitMessage, TheStandardsEphemerisIsRead) {
  const OrbitEphemerisMessage message = read_oem("a.oem", standard_oem);
  EXPECT_EQ(message.version, "3.0");
  EXPECT_EQ(message.originator, "NASA/JPL");
  ASSERT_EQ(message.segments.size(), 2U);
  const EphemerisSegment& first = message.segments[0];
  EXPECT_EQ(first.metadata.object_name, "MARS GLOBAL SURVEYOR");
  EXPECT_EQ(first.metadata.object_id, "1996-062A");
  EXPECT_EQ(first.metadata.center_name, "MARS BARYCENTER");
  EXPECT_EQ(first.metadata.reference_frame, "EME2000");
  EXPECT_EQ(first.metadata.time_system, TimeSystem::utc);
  ASSERT_EQ(first.states.size(), 4U);
  EXPECT_EQ(first.states[1].epoch, parse_epoch("2019-12-18T12:01:00.331"));
  EXPECT_EQ(first.states[1].position_km, (Vector{2783.419, -308.143, -1877.071}));
  EXPECT_EQ(first.states[1].velocity_km_s, (Vector{5.18604, -2.42124, -1.99608}));
  EXPECT_FALSE(first.has_covariance);
  EXPECT_FALSE(first.is_useable(first.states[0].epoch));
  EXPECT_TRUE(first.is_useable(*parse_epoch("2019-12-18T12:10:00.331")));
  const EphemerisSegment& second = message.segments[1];
  ASSERT_EQ(second.states.size(), 4U);
  EXPECT_EQ(second.states[0].position_km, (Vector{-2432.166, -63.042, 1742.754}));
  EXPECT_TRUE(second.has_covariance);
}

TEST(OrbitMessage, TheStandardsParametersAreRead) {
  const OrbitParameterMessage message = read_opm("a.opm", standard_opm);
  EXPECT_EQ(message.version, "3.0");
  EXPECT_EQ(message.metadata.object_name, "EUTELSAT W4");
  EXPECT_EQ(message.metadata.center_name, "EARTH");
  EXPECT_EQ(message.metadata.reference_frame, "TOD");
  EXPECT_EQ(message.state.epoch, parse_epoch("2021-06-03T00:00:00"));
  EXPECT_EQ(message.state.position_km, (Vector{6655.9942, -40218.5751, -82.9177}));
  EXPECT_EQ(message.state.velocity_km_s, (Vector{3.11548208, 0.47042605, -0.00101495}));
  EXPECT_EQ(message.unused,
            (std::vector<std::string>{"Keplerian elements", "spacecraft parameters"}));
}

/// Random bits except for the sign bit, which reach the ends of double precision.
double any_number(std::mt19937_64& random) {
  while (true) {
    const std::uint64_t bits = random();
    double number = 0;
    std::memcpy(&number, &bits, sizeof number);
    if (std::isnormal(number)) return number;
  }
}

OrbitEphemerisMessage random_message(std::mt19937_64& random) {
  OrbitEphemerisMessage message;
  message.version = random() % 2 == 0 ? "2.0" : "3.0";
  message.originator = "TEST";
  message.creation_date = *parse_epoch("2026-01-02T03:04:05");
  message.comments = {
      "What it is, in a line that has more than the 254 characters which the "
      "standard allows " +
      std::string(300, 'x')};
  for (int k = 0; k < 3; ++k) {
    EphemerisSegment segment;
    segment.metadata = {"CHIEF", "2026-001A", "EARTH", "TOD", TimeSystem::tai};
    segment.comments = {"A comment"};
    Epoch epoch = *parse_epoch("2026-03-01T00:00:00");
    for (int i = 0; i < 20; ++i) {
      OrbitState state{epoch, {}, {}};
      for (double& x : state.position_km) x = any_number(random);
      for (double& v : state.velocity_km_s) v = any_number(random);
      segment.states.push_back(state);
      epoch = *later(epoch, Extended(static_cast<double>(1 + random() % 1000000)) / 1000003);
    }
    if (k == 1) segment.useable_stop = epoch;
    message.segments.push_back(segment);
  }
  return message;
}

TEST(OrbitMessage, WhatIsWrittenIsReadBackToItsDigits) {
  std::mt19937_64 random(7);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const OrbitEphemerisMessage message = random_message(random);
    const std::string text = oem_text(message);
    const OrbitEphemerisMessage read = read_oem("a.oem", text);
    ASSERT_EQ(read.segments.size(), message.segments.size());
    for (std::size_t s = 0; s < read.segments.size(); ++s) {
      const EphemerisSegment& segment = read.segments[s];
      EXPECT_EQ(segment.metadata.object_id, "2026-001A");
      EXPECT_EQ(segment.useable_stop, message.segments[s].useable_stop);
      ASSERT_EQ(segment.states.size(), message.segments[s].states.size());
      for (std::size_t i = 0; i < segment.states.size(); ++i) {
        const OrbitState& written = message.segments[s].states[i];
        EXPECT_EQ(segment.states[i].epoch, written.epoch);
        for (std::size_t k = 0; k < 3; ++k) {
          const double x = written.position_km[k];
          const double v = written.velocity_km_s[k];
          EXPECT_LE(std::abs(segment.states[i].position_km[k] - x), 7e-16 * std::abs(x));
          EXPECT_LE(std::abs(segment.states[i].velocity_km_s[k] - v), 7e-16 * std::abs(v));
        }
      }
    }
    // Sixteen digits are nowhere coarser than binary64, so that the second text equals the first.
    OrbitEphemerisMessage again = read;
    again.comments = message.comments;
    for (EphemerisSegment& segment : again.segments) segment.comments = {"A comment"};
    EXPECT_EQ(oem_text(again), text);
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = text.find('\n', begin);
      EXPECT_LE(end - begin, 254U);
      begin = end + 1;
    }
  }
}

TEST(OrbitMessage, LineEndsAndByteOrderMarksDoNotMatter) {
  const std::string text = standard_oem;
  const auto with_ends = [&](const std::string& end) {
    std::string result;
    for (const char c : text) result += c == '\n' ? end : std::string(1, c);
    return result;
  };
  for (const std::string& variant :
       {with_ends("\r\n"), with_ends("\r"), with_ends("\n\r"), with_ends(" \t\n\n"),
        "\xef\xbb\xbf" + text, "\n\n" + text, text + "COMMENT \xc3\xa9 the end\n"}) {
    const OrbitEphemerisMessage message = read_oem("a.oem", variant);
    ASSERT_EQ(message.segments.size(), 2U);
    EXPECT_EQ(message.segments[1].states.size(), 4U);
  }
  // Lines are counted as editors count them.
  for (const char* end : {"\r\n", "\r", "\n\r"}) {
    const std::string damaged = changed(with_ends(end), "TIME_SYSTEM", "TIME_SISTEM");
    expect_error([&] { read_oem("a.oem", damaged); }, ErrorKind::input_output,
                 {"a.oem:10: TIME_SISTEM: unknown keyword here, did you mean TIME_SYSTEM?"}, end);
  }
}

struct Damage {
  const char* from;
  const char* to;
  std::vector<std::string> words;
};

void expect_refused(const std::function<void(const std::string&)>& read, const std::string& text,
                    const std::vector<std::string>& words) {
  expect_error([&] { read(text); }, ErrorKind::input_output, words, text);
}

TEST(OrbitMessage, ADamagedEphemerisIsRefusedWithItsLine) {
  const auto read = [](const std::string& text) { read_oem("a.oem", text); };
  const std::vector<Damage> damages = {
      {"CCSDS_OEM_VERS = 3.0",
       "CCSDS_OEM_VERS = 4.0",
       {"a.oem:1: CCSDS_OEM_VERS: unknown version, got \"4.0\", must be 1.0 or 2.0 or 3.0"}},
      {"CCSDS_OEM_VERS = 3.0\n",
       "",
       {"a.oem:1: CCSDS_OEM_VERS: missing, got another first line, must be"}},
      {"CCSDS_OEM_VERS",
       "CCSDS_OPM_VERS",
       {"a.oem:1: CCSDS_OEM_VERS: missing, got an orbit parameter message (OPM)", "opm_file"}},
      {"CREATION_DATE = 1996-11-04T17:22:31",
       "CREATION_DATE = 1996-11-31T17:22:31",
       {"a.oem:2: CREATION_DATE: no moment of the calendar, got \"1996-11-31T17:22:31\""}},
      {"ORIGINATOR = NASA/JPL\n", "", {"a.oem:4: ORIGINATOR: missing", "must be a text"}},
      {"ORIGINATOR = NASA/JPL", "ORIGINATOR =", {"a.oem:3: ORIGINATOR: empty"}},
      {"META_START\n", "", {"a.oem:5: OBJECT_NAME: unknown keyword here"}},
      {"META_STOP\n",
       "",
       {"a.oem:17: META_STOP: missing, got \"2019-12-18T12:00:00.331 2789.619",
        "must end the metadata that begin in line 5"}},
      {"OBJECT_ID", "OBJECT_NAME", {"a.oem:7: OBJECT_NAME: there twice", "line 6"}},
      {"CENTER_NAME = MARS BARYCENTER\n", "", {"a.oem:16: CENTER_NAME: missing"}},
      {"REF_FRAME = EME2000",
       "REF_FRAME = ITRF2000",
       {"a.oem:9: REF_FRAME: a frame that rotates, got \"ITRF2000\"", "TOD"}},
      {"REF_FRAME = EME2000",
       "REF_FRAME = MY_FRAME",
       {"REF_FRAME: unknown frame, got \"MY_FRAME\""}},
      {"TIME_SYSTEM = UTC",
       "TIME_SYSTEM = UT1",
       {"a.oem:10: TIME_SYSTEM: unknown time system, got \"UT1\"", "UTC, TAI, TT, GPS, TDB"}},
      {"TIME_SYSTEM = UTC",
       "TIME_SYSTEM = TAI",
       {"a.oem:22: TIME_SYSTEM: changes", "must be TAI in all"}},
      {"STOP_TIME = 2019-12-28T21:28:00.331",
       "STOP_TIME = 2019-12-17T21:28:00.331",
       {"a.oem:14: STOP_TIME: before START_TIME"}},
      {"2019-12-18T12:01:00.331 2783.419",
       "2019-12-18T12:00:00.331 2783.419",
       {"a.oem:19: epochs out of order, got 2019-12-18T12:00:00.331, must be after"}},
      {"2019-12-18T12:01:00.331 2783.419",
       "2018-12-18T12:01:00.331 2783.419",
       {"a.oem:19: an epoch outside of the span", "START_TIME 2019-12-18T12:00:00.331"}},
      {"2019-12-28T21:28:00.331 -3881.024",
       "2019-12-28T21:28:00.332 -3881.024",
       {"a.oem:21: an epoch outside of the span", "STOP_TIME 2019-12-28T21:28:00.331"}},
      {"2783.419", "nan", {"a.oem:19: no number, got \"nan\", must be a finite number"}},
      {"2783.419", "1e999", {"a.oem:19: no number, got \"1e999\""}},
      {"2783.419", "2783,419", {"a.oem:19: no number, got \"2783,419\""}},
      {"2783.419", "2783.419[km]", {"a.oem:19: no number, got \"2783.419[km]\""}},
      {" -1.99608", "", {"a.oem:19: wrong length, got 5 numbers", "must be 6"}},
      {" -1.99608", " -1.99608 0 0", {"a.oem:19: wrong length, got 8 numbers"}},
      {"2783.419",
       "2783\xb0",
       {"a.oem:19: not a text, got the byte 0xb0, must be printable ASCII"}},
      {"2783.419", "2783\x01", {"a.oem:19: not a text, got the byte 0x01"}},
      {"COVARIANCE_STOP", "", {"COVARIANCE_STOP: missing, got the end of the file", "line 39"}},
      {"3.3313494e-04", "3.33x", {"a.oem:42: no number, got \"3.33x\""}},
      {"COV_REF_FRAME", "COV_REF", {"a.oem:41: COV_REF: unknown keyword here"}},
  };
  for (const Damage& damage : damages) {
    expect_refused(read, changed(standard_oem, damage.from, damage.to), damage.words);
  }
  expect_refused(read, "", {"a.oem:1: CCSDS_OEM_VERS: missing, got an empty file"});
  expect_refused(read, "\xff\xfe", {"a.oem:1: not ASCII, got a UTF-16 byte order mark"});
}

TEST(OrbitMessage, AnEphemerisThatEndsAnywhereIsReadOrRefused) {
  const std::string whole = standard_oem;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    try {
      EXPECT_FALSE(read_oem("a.oem", whole.substr(0, length)).segments.empty());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_output) << error.what();
      EXPECT_EQ(std::string(error.what()).rfind("a.oem:", 0), 0U) << error.what();
    }
  }
}

TEST(OrbitMessage, DamagedParametersAreRefusedWithTheirLine) {
  const auto read = [](const std::string& text) { read_opm("a.opm", text); };
  const std::vector<Damage> damages = {
      {"CCSDS_OPM_VERS     =   3.0", "CCSDS_OPM_VERS = 4.0", {"a.opm:1: CCSDS_OPM_VERS: unknown"}},
      {"6655.9942        [km]",
       "6655994.2 [m]",
       {"a.opm:17: X: wrong unit, got \"[m]\", must be [km]"}},
      {"0.47042605    [km/s]", "0.47042605 [km]", {"Y_DOT: wrong unit, got \"[km]\""}},
      {"6655.9942        [km]", "[km]", {"a.opm:17: X: no number, got \"\""}},
      {"6655.9942 ", "inf ", {"a.opm:17: X: no number, got \"inf\""}},
      {"Z_DOT              =     -0.00101495    [km/s]\n",
       "",
       {"Z_DOT: missing, got nothing up to here, must be a finite number of km/s"}},
      {"EPOCH              = 2021-06-03T00:00:00.000\n", "", {"EPOCH: missing"}},
      {"Y_DOT ", "X_DOT ", {"a.opm:21: X_DOT: there twice, got it in line 20 too"}},
      {"Y_DOT ", "Y-DOT ", {"a.opm:21: Y-DOT: unknown keyword here, did you mean Y_DOT?"}},
      {"TOD", "itrf2000", {"REF_FRAME: a frame that rotates, got \"ITRF2000\""}},
      {"ORIGINATOR         =   GSOC\n", "DATA_START\n", {"no assignment, got \"DATA_START\""}},
  };
  for (const Damage& damage : damages) {
    expect_refused(read, changed(standard_opm, damage.from, damage.to), damage.words);
  }
  const std::vector<Damage> of_manoeuvre = {
      {"132.60 ",
       "-1 ",
       {"a.opm:43: MAN_DURATION: a burn that ends before it begins, got -1 s, must be 0"}},
      {"-18.418", "18.418", {"a.opm:44: MAN_DELTA_MASS: a mass that grows, got 18.418 kg"}},
      {"EME2000",
       "LVLH",
       {"a.opm:45: MAN_REF_FRAME: axes along which no thrust is flown, got \"LVLH\""}},
      {"0.01683160       [km/s]", "16.8 [m/s]", {"a.opm:47: MAN_DV_2: wrong unit, got \"[m/s]\""}},
      {"MAN_DV_3 ", "MAN_DV_4 ", {"a.opm:48: MAN_DV_4: unknown keyword here"}},
      {"MAN_DURATION       =    132.60             [s]\n",
       "",
       {"a.opm:48: MAN_DURATION: missing, got nothing up to here"}},
      {"MAN_DURATION ", "MAN_DV_1 ", {"a.opm:46: MAN_DV_1: there twice, got it in line 43 too"}}};
  for (const Damage& damage : of_manoeuvre) {
    expect_refused(read,
                   std::string(standard_opm) + changed(standard_maneuver, damage.from, damage.to),
                   damage.words);
  }
  expect_refused(read, standard_rotating_opm, {"a.opm:8: REF_FRAME: a frame that rotates"});
}

// The two manoeuvres of the standard's example: a burn, and an impulse, of which the standard says
// that its duration is 0.
TEST(OrbitMessage, ManoeuvresAreReadAndWrittenAsTheyAre) {
  const std::string impulse =
      "MAN_EPOCH_IGNITION = 2021-06-05T18:59:21\nMAN_DURATION = 0.00 [s]\n"
      "MAN_DELTA_MASS = -1.469 [kg]\nMAN_REF_FRAME = rtn\nMAN_DV_1 = 0.00101500 [km/s]\n"
      "MAN_DV_2 = -0.00187300 [km/s]\nMAN_DV_3 = 0 [km/s]\n";
  const std::string text = std::string(standard_opm) + standard_maneuver + impulse;
  const OrbitParameterMessage message = read_opm("a.opm", text);
  ASSERT_EQ(message.manoeuvres.size(), 2U);
  const OpmManoeuvre& burn = message.manoeuvres[0];
  EXPECT_EQ(format_epoch(burn.ignition), "2021-06-03T09:00:34.100000000000");
  EXPECT_EQ(burn.duration_s, 132.6);
  EXPECT_EQ(burn.mass_change_kg, -18.418);
  EXPECT_EQ(burn.reference_frame, "EME2000");
  EXPECT_EQ(burn.change_km_s, (std::array<double, 3>{-0.023257, 0.0168316, -0.00893444}));
  EXPECT_EQ(burn.line, 42U);
  EXPECT_EQ(message.manoeuvres[1].duration_s, 0);
  EXPECT_EQ(message.manoeuvres[1].reference_frame, "RTN");
  // Written and read again it is the same text.
  const std::string written = opm_text(message);
  const OrbitParameterMessage again = read_opm("b.opm", written);
  EXPECT_EQ(opm_text(again), written);
  EXPECT_EQ(again.manoeuvres[0].change_km_s, burn.change_km_s);
  EXPECT_EQ(again.manoeuvres[0].ignition, burn.ignition);
}

TEST(OrbitMessage, ParametersOfVersion1AreRead) {
  // CCSDS 502.0-B-1 (2004) has the keywords of version 2.0.
  const std::string old = changed(standard_opm, "=   3.0", "= 1.0");
  EXPECT_EQ(read_opm("a.opm", old).version, "1.0");
  EXPECT_EQ(read_opm("a.opm", old).state.position_km,
            read_opm("a.opm", standard_opm).state.position_km);
}

TEST(OrbitMessage, MetadataOfParametersMayBeMarkedAsThoseOfAnEphemeris) {
  std::string marked = changed(standard_opm, "OBJECT_NAME ", "META_START\nOBJECT_NAME ");
  marked = changed(marked, "COMMENT   State Vector", "META_STOP");
  EXPECT_EQ(opm_text(read_opm("a.opm", marked)), opm_text(read_opm("a.opm", standard_opm)));
}

TEST(OrbitMessage, ExponentsOfFortranAreNumbers) {
  const std::string parameters = changed(standard_opm, "6655.9942  ", "0.66559942D+04");
  EXPECT_EQ(read_opm("a.opm", parameters).state.position_km[0], 6655.9942);
  std::string ephemeris = changed(standard_oem, "2783.419", "2.783419d3");
  ephemeris = changed(ephemeris, "3.3313494e-04", "3.3313494D-04");
  const OrbitEphemerisMessage message = read_oem("a.oem", ephemeris);
  EXPECT_EQ(message.segments[0].states[1].position_km[0], 2783.419);
  EXPECT_EQ(message.segments[1].covariances[0].matrix[0][0], 3.3313494e-04);
  expect_refused([](const std::string& text) { read_opm("a.opm", text); },
                 changed(standard_opm, "6655.9942  ", "1D2D3"), {"X: no number, got \"1D2D3\""});
}

// A mistake in numbers that are not used does not keep the state from being read.
TEST(OrbitMessage, WhatIsWrongWithNumbersThatAreNotUsedIsADoubt) {
  std::string text = changed(standard_opm, "1913.000             [kg]", "1913 [g]");
  text = changed(text, "0.020842611", "0.020842611 [n/a]");
  text = changed(text, "DRAG_COEFF       =       2.300", "DRAG_COEFF =");
  const OrbitParameterMessage message = read_opm("a.opm", text);
  EXPECT_EQ(message.state.position_km, read_opm("a.opm", standard_opm).state.position_km);
  EXPECT_FALSE(message.elements);
  EXPECT_EQ(message.doubts,
            (std::vector<std::string>{
                "a.opm:34: MASS: wrong unit, got \"[g]\", must be [kg]; it is not used",
                "a.opm:26: ECCENTRICITY: wrong unit, got \"[n/a]\", must be without a unit; it is "
                "not used"}));
  // The degree of an interpolation that is not done does not keep it from being read either, nor
  // does a text in another language.
  std::string ephemeris =
      changed(standard_oem, "INTERPOLATION_DEGREE = 7", "INTERPOLATION_DEGREE = seven");
  ephemeris = changed(ephemeris, "INTERPOLATION = HERMITE", "INTERPOLATION = H\xc3\xa9rmite");
  EXPECT_EQ(read_oem("a.oem", ephemeris).segments.size(), 2U);
}

TEST(OrbitMessage, ElementsAreReadBesideTheState) {
  const auto elements = read_opm("a.opm", standard_opm).elements;
  ASSERT_TRUE(elements);
  EXPECT_EQ(elements->semi_major_axis_km, 41399.5123);
  EXPECT_EQ(elements->argument_of_perigee_deg, 218.242943);
  EXPECT_EQ(elements->anomaly_deg, 41.922339);
  EXPECT_FALSE(elements->is_mean_anomaly);
  EXPECT_EQ(elements->line, 25U);
}

// An error about a file of another kind, named by mistake or by somebody else, quotes nothing of
// the file.
TEST(OrbitMessage, AFileOfAnotherKindIsNamedAndNotQuoted) {
  const auto problem = [](const std::string& text) {
    try {
      read_oem("a.oem", text);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string right = "must be CCSDS_OEM_VERS = 1.0 or 2.0 or 3.0";
  for (const char* secret : {"hunter2:x:0:0\n", "hunter2 = 1\n", "hunter2\n\x1b[31m"}) {
    EXPECT_EQ(problem(secret),
              "a.oem:1: CCSDS_OEM_VERS: missing, got another first line, " + right);
  }
  // The published elements of Vanguard 1, with and without a name.
  const std::string elements =
      "1 00005U 58002B   00179.78495062  .00000023  00000-0  28098-4 0  4753\n"
      "2 00005  34.2682 348.7242 1859667 331.7664  19.3264 10.82419157413667\n";
  for (const std::string& tle : {elements, "VANGUARD 1\n" + elements}) {
    EXPECT_EQ(
        problem(tle).rfind("a.oem:1: CCSDS_OEM_VERS: missing, got two-line elements (TLE)", 0), 0U)
        << problem(tle);
  }
  EXPECT_NE(problem("CCSDS_OMM_VERS = 2.0\n").find("mean-elements message (OMM)"),
            std::string::npos);
  EXPECT_NE(problem("CCSDS_CDM_VERS = 1.0\n").find("the key file of [uncertainty] reads"),
            std::string::npos);
}

}  // namespace
}  // namespace hamjet::io
