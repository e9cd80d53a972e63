#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "scene_samples.hpp"
#include "support/temporary_directory.hpp"

// Covariances from messages must belong to the moment, centre, state and object of the chief or the
// deputy; other covariances are refused.

namespace hamjet::io {
namespace {

const std::string closest = "2010-03-13T22:37:52.618";

std::string dated(const std::string& epoch, const std::string& time_system = "UTC",
                  const std::string& frame = "EME2000", const std::string& more = "") {
  return fmt::format(
      "[ephemeris]\nepoch = \"{}\"\ntime_system = \"{}\"\nreference_frame = \"{}\"\n"
      "center_name = \"EARTH\"\n{}",
      epoch, time_system, frame, more);
}

/// The first and the second state of the conjunction.
const std::string first_state =
    "position_km = [2570.097065, 2244.654904, 6281.497978]\n"
    "velocity_km_s = [4.418769571, 4.833547743, -3.526774282]\n";
const std::string second_state =
    "position_km = [2569.540800, 2245.093614, 6281.599946]\n"
    "velocity_km_s = [-2.888612500, -6.007247516, 3.328770172]\n";

std::string earth_scene(const std::string& state = first_state) {
  return "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\n" + state +
         "[jet]\nduration_s = 6000\n";
}

const std::string conjunction_file =
    "file = \"" HAMJET_SOURCE_DIR "/tests/fuzz/corpus/orbit_message/conjunction.cdm\"\n";
const std::string of_conjunction = "[uncertainty]\n" + conjunction_file;

std::string conjunction() {
  std::ifstream file(HAMJET_SOURCE_DIR "/tests/fuzz/corpus/orbit_message/conjunction.cdm");
  return {std::istreambuf_iterator<char>(file), {}};
}

Scene parsed_scene(const std::string& text) { return parse_scene(text, "file.toml"); }

/// The scene with a message beside it.
Scene scene_beside(const std::string& message, const std::string& text) {
  const test::TemporaryDirectory directory;
  std::ofstream(directory.path() / "message") << message;
  return parse_scene(text, (directory.path() / "file.toml").string());
}

void expect_refused_beside(const std::string& message, const std::string& text,
                           const std::vector<std::string>& words) {
  expect_error([&] { scene_beside(message, text); }, ErrorKind::scene, words, text);
}

const std::string of_message = "[uncertainty]\nfile = \"message\"\n";

TEST(CovarianceFile, OfAConjunctionIsReadForBothObjects) {
  const Scene scene = parsed_scene(earth_scene() + dated(closest) + "[deputy]\n" + second_state +
                                   of_conjunction + "[uncertainty.deputy]\n" + conjunction_file +
                                   "[uncertainty.collision]\nradius_m = 10\n");
  const StateUncertainty& chief = *scene.uncertainty->chief;
  EXPECT_EQ(chief.frame, RelativeFrame::rtn_inertial);
  // Values in m^2 as in the file: CT_T and CRDOT_T of OBJECT1, CT_T of OBJECT2.
  EXPECT_NEAR(chief.covariance.matrix()(1, 1), 2533, 1e-9);
  EXPECT_NEAR(chief.covariance.matrix()(3, 1), -2.476, 1e-12);
  EXPECT_NEAR(scene.uncertainty->deputy->covariance.matrix()(1, 1), 2.492e6, 1e-6);
  const Scene other = parsed_scene(earth_scene(second_state) + dated(closest) + of_conjunction +
                                   "object = \"FENGYUN 1C DEB\"\n");
  EXPECT_NEAR(other.uncertainty->chief->covariance.matrix()(1, 1), 2.492e6, 1e-6);
}

TEST(CovarianceFile, OfAnEphemerisIsReadInItsAxes) {
  // km^2 become m^2.
  const Scene scene = parsed_scene(
      "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 42828.37\n[nominal]\n"
      "position_km = [-2432.166, -63.042, 1742.754]\n"
      "velocity_km_s = [7.33702, -3.495867, -1.041945]\n[jet]\nduration_s = 600\n" +
      changed(dated("2019-12-28T21:29:07.267"), "EARTH", "MARS") +
      "[uncertainty]\nfile = \"" HAMJET_SOURCE_DIR
      "/tests/fuzz/corpus/orbit_message/ephemeris.oem\"\n");
  EXPECT_EQ(scene.uncertainty->chief->frame, RelativeFrame::inertial);
  const Matrix<double> matrix = scene.uncertainty->chief->covariance.matrix();
  EXPECT_NEAR(matrix(0, 0), 333.13494, 1e-8);
  EXPECT_NEAR(matrix(2, 1), -422.12341, 1e-8);
  EXPECT_NEAR(matrix(5, 5), 6.2244443e-4, 1e-13);
}

TEST(CovarianceFile, OfAnotherMomentObjectOrFormIsRefused) {
  const auto refuse = [](const std::string& tables, const std::vector<std::string>& words) {
    expect_scene_error(earth_scene() + tables, words);
  };
  refuse(of_conjunction, {"uncertainty.file", "beside a chief without a date", closest});
  refuse(dated("2010-03-13T22:37:52") + of_conjunction,
         {"uncertainty.file", "no covariance of the chief's moment", closest});
  refuse(dated(closest, "TAI") + of_conjunction,
         {"uncertainty.file", "no covariance of the chief's moment", "TAI"});
  refuse(dated(closest) + "[uncertainty]\nobject = \"SATELLITE B\"\n" + conjunction_file,
         {"uncertainty.object", "SATELLITE B"});
  refuse(dated(closest) + "[uncertainty]\nposition_m = [1, 1, 1]\n" + conjunction_file,
         {"uncertainty.position_m", "beside a file"});
  refuse("[uncertainty]\nobject = \"OBJECT1\"\nposition_m = [1, 1, 1]\n",
         {"uncertainty.object", "there is no file"});
  expect_scene_error(earth_scene() + "[uncertainty]\nfile = \"nowhere.cdm\"\n",
                     {"uncertainty.file", "nowhere.cdm"}, ErrorKind::input_output);
}

// Six standard deviations of OBJECT1 are 6 sqrt(41.42 + 2533 + 70.98) m = 308.6 m, and five digits
// of the distance are 71.4 m. For the velocity these are 0.457 m/s and 0.0744 m/s.
TEST(CovarianceFile, OfAnotherStateIsRefused) {
  const auto with = [](const std::string& from, const std::string& to) {
    return earth_scene(changed(first_state, from, to)) + dated(closest) + of_conjunction;
  };
  EXPECT_NO_THROW(parsed_scene(with("2570.097065", "2570.467065")));
  EXPECT_NO_THROW(parsed_scene(with("4.418769571", "4.419289571")));
  expect_scene_error(with("2570.097065", "2570.487065"),
                     {"uncertainty.file: a covariance of another state than the chief's",
                      "SATELLITE A, 1997-030E, 12345", "at 390 m and 0 m/s from it",
                      "must be within 380 m and 0.532 m/s (6 standard deviations, five digits"});
  expect_scene_error(with("4.418769571", "4.419319571"), {"another state", "0.55 m/s from it"});
  // The other object of the conjunction is some 700 m away, but flies the other way.
  expect_scene_error(earth_scene(second_state) + dated(closest) + of_conjunction,
                     {"another state", "at 716 m and 1.48e+04 m/s from it",
                      "object = \"OBJECT1\" or \"OBJECT2\" chooses"});
  expect_scene_error(earth_scene() + dated(closest) + "[deputy]\nposition_m = [0, 5000, 0]\n" +
                         "[uncertainty.deputy]\n" + conjunction_file,
                     {"uncertainty.deputy.file", "another state than the deputy's"});
}

TEST(CovarianceFile, AboutAnotherCentreIsRefused) {
  const std::string about_moon =
      changed(conjunction(), "REF_FRAME     ", "ORBIT_CENTER = MOON\nREF_FRAME     ");
  expect_refused_beside(
      about_moon, earth_scene() + dated(closest) + of_message,
      {"uncertainty.file: a covariance about another centre than the chief's, got "
       "MOON in ",
       "must be EARTH"});
}

TEST(CovarianceFile, OfAnotherObjectIsRefusedUnlessItIsNamed) {
  const auto with = [](const std::string& name, const std::string& more) {
    return earth_scene() + dated(closest, "UTC", "EME2000", "object_name = \"" + name + "\"\n") +
           of_conjunction + more;
  };
  EXPECT_NO_THROW(parsed_scene(with("Satellite A", "")));
  EXPECT_NO_THROW(parsed_scene(with("12345", "")));
  EXPECT_NO_THROW(parsed_scene(with("A2", "object = \"OBJECT1\"\n")));
  expect_scene_error(with("A2", ""),
                     {"uncertainty.file: a covariance of another object than the chief, got "
                      "SATELLITE A, 1997-030E, 12345 in",
                      "must be A2; object = \"OBJECT1\" says that it is meant"});
}

// The message is read in spite of its mistakes, and each mistake is printed once for a table.
TEST(CovarianceFile, NumbersThatAreNotUsedAreWarnedOf) {
  std::string message = changed(conjunction(), "-7.2            [m/s]", "-7.2 [m]");
  message = changed(message, "14762           [m/s]", "14762 [m]");
  const auto warnings = scene_beside(message, earth_scene() + dated(closest) + of_message).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("uncertainty.file: "), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find(":9: RELATIVE_SPEED: wrong unit, got \"[m]\", must be [m/s]; it is "
                             "not used, and 1 more such"),
            std::string::npos)
      << warnings[0];
}

// States in other axes are compared as far as the angle between the axes allows.
TEST(CovarianceFile, OtherAxesAreNoOtherState) {
  for (const char* frame : {"J2000", "GCRF", "TOD"}) {
    EXPECT_NO_THROW(parsed_scene(earth_scene() + dated(closest, "UTC", frame) + of_conjunction));
  }
  expect_scene_error(earth_scene(second_state) + dated(closest, "UTC", "TOD") + of_conjunction,
                     {"another state", "EME2000 beside TOD"});
  // For axes that turn with the Earth by an unknown angle, the distances decide, to their digits.
  constexpr double rate = 7.292115e-5, angle = 2.1;
  const auto turned = [&](double x, double y, double vx, double vy, std::string message) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double ux = vx + rate * y, uy = vy - rate * x;
    message = changed(message, "2570.097065", fmt::format("{:.9f}", c * x - s * y));
    message = changed(message, "2244.654904", fmt::format("{:.9f}", s * x + c * y));
    message = changed(message, "4.418769571", fmt::format("{:.9f}", c * ux - s * uy));
    message = changed(message, "4.833547743", fmt::format("{:.9f}", s * ux + c * uy));
    return changed(message, "= EME2000", "= ITRF");
  };
  const std::string itrf =
      turned(2570.097065, 2244.654904, 4.418769571, 4.833547743, conjunction());
  EXPECT_NO_THROW(scene_beside(itrf, earth_scene() + dated(closest) + of_message));
  expect_refused_beside(itrf, earth_scene(second_state) + dated(closest) + of_message,
                        {"another state", "ITRF beside EME2000"});
}

/// An OPM of the first state with a covariance of (10 m)^2 and (1 cm/s)^2.
std::string opm(const std::string& axes, const std::string& metadata = "EME2000") {
  std::string text = fmt::format(
      "CCSDS_OPM_VERS = 2.0\nCREATION_DATE = 2010-03-13T00:00:00\nORIGINATOR = T\nOBJECT_NAME = A\n"
      "OBJECT_ID = 1997-030E\nCENTER_NAME = EARTH\nREF_FRAME = {}\nTIME_SYSTEM = UTC\n"
      "EPOCH = {}\nX = 2570.097065\nY = 2244.654904\nZ = 6281.497978\nX_DOT = 4.418769571\n"
      "Y_DOT = 4.833547743\nZ_DOT = -3.526774282\nCOV_REF_FRAME = {}\n",
      metadata, closest, axes);
  const char* const names[] = {"X", "Y", "Z", "X_DOT", "Y_DOT", "Z_DOT"};
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      text += fmt::format("C{}_{} = {}\n", names[i], names[j],
                          i != j  ? "0"
                          : i < 3 ? "1D-4"
                                  : "1e-10");
    }
  }
  return text;
}

TEST(CovarianceFile, AxesHaveSeveralNames) {
  const auto frame_of = [](const std::string& axes, const std::string& of_scene = "EME2000") {
    return scene_beside(opm(axes), earth_scene() + dated(closest, "UTC", of_scene) + of_message)
        .uncertainty->chief->frame;
  };
  for (const char* axes : {"RTN", "RSW", "QSW", "RIC", "RSW_INERTIAL", "qsw_inertial"}) {
    EXPECT_EQ(frame_of(axes), RelativeFrame::rtn_inertial) << axes;
  }
  EXPECT_EQ(frame_of("RSW_ROTATING"), RelativeFrame::rtn_rotating);
  EXPECT_EQ(frame_of("EME2000"), RelativeFrame::inertial);
  EXPECT_EQ(frame_of("J2000"), RelativeFrame::inertial);
  EXPECT_EQ(frame_of("EME2000", "J2000"), RelativeFrame::inertial);
  expect_refused_beside(opm("TNW"), earth_scene() + dated(closest) + of_message,
                        {"a covariance in other axes, got TNW in", ":17, must be RTN (or RSW"});
  expect_refused_beside(opm("GCRF"), earth_scene() + dated(closest) + of_message,
                        {"a covariance in other axes, got GCRF", "the chief's EME2000"});
}

// On a circle of 7000 km, a state a minute, and the covariance half a minute after the first.
TEST(CovarianceFile, BetweenTheStatesOfAnEphemerisTheStateIsInterpolated) {
  const double r = 7000, n = std::sqrt(398600.4415 / (r * r * r));
  const auto circle = [&](double seconds, const char* form) {
    const double c = r * std::cos(n * seconds), s = r * std::sin(n * seconds);
    return fmt::format(fmt::runtime(form), c, s, 0.0, -n * s, n * c, 0.0);
  };
  const auto ephemeris = [&](const std::string& object) {
    std::string text = fmt::format(
        "META_START\nOBJECT_NAME = {0}\nOBJECT_ID = {0}\nCENTER_NAME = EARTH\nREF_FRAME = EME2000\n"
        "TIME_SYSTEM = UTC\nSTART_TIME = 2020-01-01T00:00:00\nSTOP_TIME = 2020-01-01T00:01:00\n"
        "META_STOP\n",
        object);
    text += "2020-01-01T00:00:00 " + circle(0, "{} {} {} {} {} {}\n");
    text += "2020-01-01T00:01:00 " + circle(60, "{} {} {} {} {} {}\n");
    text += "COVARIANCE_START\nEPOCH = 2020-01-01T00:00:30\nCOV_REF_FRAME = RTN\n";
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < i; ++j) text += "0 ";
      text += i < 3 ? "1e-6\n" : "1e-12\n";
    }
    return text + "COVARIANCE_STOP\n";
  };
  const std::string header =
      "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2020-01-01T00:00:00\nORIGINATOR = T\n";
  const auto scene = [&](double seconds, const std::string& more) {
    return earth_scene(
               circle(seconds, "position_km = [{}, {}, {}]\nvelocity_km_s = [{}, {}, {}]\n")) +
           dated("2020-01-01T00:00:30", "UTC", "EME2000", more) + of_message;
  };
  EXPECT_NO_THROW(scene_beside(header + ephemeris("A"), scene(30, "")));
  // A fiftieth of a second corresponds to 150 m along the orbit.
  expect_refused_beside(header + ephemeris("A"), scene(30.02, ""), {"another state", "151 m"});
  // After the last state there is no state for comparison, as the output says.
  std::string late = header + ephemeris("A");
  late.replace(late.find("00:00:30"), 8, "00:01:30");
  std::string late_scene = scene(90, "");
  late_scene.replace(late_scene.find("00:00:30"), 8, "00:01:30");
  const std::vector<std::string> warnings = scene_beside(late, late_scene).warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& text) {
    return text.find("was not compared with the chief's state") != std::string::npos;
  })) << ::testing::PrintToString(warnings);
  // Of two objects the one with the chief's name is used; without a name neither is.
  const std::string two = header + ephemeris("A") + ephemeris("B");
  EXPECT_NO_THROW(scene_beside(two, scene(30, "object_name = \"B\"\n")));
  expect_refused_beside(two, scene(30, ""), {"uncertainty.object: missing", "of A and of B"});
}

}  // namespace
}  // namespace hamjet::io
