#include "hamjet/formats/orbit_message_axes.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "hamjet/error.hpp"
#include "orbit_message_samples.hpp"
#include "support/errors.hpp"

// Messages along other axes. Expected values: D. A. Vallado's worked example (Fundamentals of
// Astrodynamics and Applications, 4th edition, section 3.7), and identities.

namespace hamjet::io {
namespace {

using Vector = std::array<double, 3>;

double distance(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

std::shared_ptr<const EarthOrientation> table_of_example() {
  std::vector<EarthOrientationDay> days;
  for (int i = 0; i < 5; ++i) {
    days.push_back({std::chrono::sys_days(std::chrono::year(2004) / 4 / 4) + std::chrono::days(i),
                    -0.4399619, -0.140682, 0.333309, 0, 0, false});
  }
  return std::make_shared<EarthOrientation>("table", days);
}

const std::string terrestrial_oem = R"(CCSDS_OEM_VERS = 2.0
CREATION_DATE = 2004-04-07T00:00:00
ORIGINATOR = TEST
META_START
OBJECT_NAME = EXAMPLE
OBJECT_ID = 2004-999A
CENTER_NAME = EARTH
REF_FRAME = ITRF2000
TIME_SYSTEM = GPS
START_TIME = 2004-04-06T07:51:41.386009
STOP_TIME = 2004-04-06T07:52:41.386009
META_STOP
2004-04-06T07:51:41.386009 -1033.4793830 7901.2952754 6380.3565958 -3.225636520 -2.872451450 5.531924446
2004-04-06T07:52:41.386009 -1033.4793830 7901.2952754 6380.3565958 -3.225636520 -2.872451450 5.531924446
COVARIANCE_START
EPOCH = 2004-04-06T07:52:41.386009
4
0.1 5
0.2 0.3 6
0 0 0 1e-6
0 0 0 0 2e-6
1e-4 0 0 0 0 3e-6
COVARIANCE_STOP
)";

TEST(OrbitMessageAxes, AnEphemerisInEarthFixedAxesIsTurnedStateByState) {
  test::expect_error(ErrorKind::input_output,
                     "a.oem:8: REF_FRAME: a frame that rotates, got \"ITRF2000\"",
                     [&] { read_oem("a.oem", terrestrial_oem); });
  const OrbitEphemerisMessage message =
      read_oem("a.oem", terrestrial_oem, AcceptedFrames::terrestrial_too);
  const EphemerisSegment& given = message.segments[0];
  const EphemerisSegment turned = in_frame(given, {"GCRF"}, table_of_example());
  EXPECT_EQ(turned.metadata.reference_frame, "GCRF");
  // GPS time was 13 s ahead of UTC. The book's date of UT1 is rounded to 40 microseconds, 2 cm.
  EXPECT_LT(distance(turned.states[0].position_km, {5102.5089578, 6123.0114038, 6378.1369253}),
            1.2e-5);
  EXPECT_LT(distance(turned.states[0].velocity_km_s, {-4.743220156, 0.790536497, 5.533755728}),
            4e-8);
  // Each state has a matrix of its own: what rests on the Earth for a minute goes round its axis by
  // 60 s of 7.2921e-5 rad/s.
  const double off_axis =
      std::hypot(given.states[0].position_km[0], given.states[0].position_km[1]);
  EXPECT_NEAR(distance(turned.states[1].position_km, turned.states[0].position_km) / off_axis,
              60 * 7.2921e-5, 1e-7);
  // Written and read again, in the axes in which it came.
  OrbitEphemerisMessage back = message;
  back.segments[0] = in_frame(turned, {"ITRF2000"}, table_of_example());
  const EphemerisSegment again =
      read_oem("b.oem", oem_text(back), AcceptedFrames::terrestrial_too).segments[0];
  EXPECT_EQ(again.metadata.reference_frame, "ITRF2000");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(distance(again.states[i].position_km, given.states[i].position_km), 1e-10);
    EXPECT_LT(distance(again.states[i].velocity_km_s, given.states[i].velocity_km_s), 1e-13);
  }
}

TEST(OrbitMessageAxes, CovariancesGoWithTheStates) {
  const EphemerisSegment given =
      read_oem("a.oem", terrestrial_oem, AcceptedFrames::terrestrial_too).segments[0];
  const EphemerisSegment turned = in_frame(given, {"EME2000"}, table_of_example());
  ASSERT_EQ(turned.covariances.size(), 1U);
  EXPECT_EQ(turned.covariances[0].reference_frame, "EME2000");
  // The variance along any direction is that along the turned one: d' C d = (A^-T d)' C' (A^-T d),
  // here with the direction of the state itself, x' C^-1 x.
  const auto matrix = [](const OrbitCovariance& covariance) {
    Eigen::Matrix<double, 6, 6> result;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        result(i, j) = covariance.matrix[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      }
    }
    return result;
  };
  const auto quotient = [&](const EphemerisSegment& segment) {
    Eigen::Matrix<double, 6, 1> x;
    for (int k = 0; k < 3; ++k) {
      x[k] = segment.states[1].position_km[static_cast<std::size_t>(k)];
      x[3 + k] = segment.states[1].velocity_km_s[static_cast<std::size_t>(k)];
    }
    return x.dot(matrix(segment.covariances[0]).inverse() * x);
  };
  EXPECT_NEAR(quotient(turned) / quotient(given), 1, 1e-9);
  const auto inertial = matrix(turned.covariances[0]);
  EXPECT_EQ((inertial - inertial.transpose()).norm(), 0);
  EXPECT_NEAR(inertial.topLeftCorner(3, 3).trace(), 4 + 5 + 6, 1e-12);

  // A covariance along R, T, N stays.
  EphemerisSegment rtn = given;
  rtn.covariances[0].reference_frame = "RTN";
  EXPECT_EQ(in_frame(rtn, {"GCRF"}, table_of_example()).covariances[0].matrix,
            given.covariances[0].matrix);
}

TEST(OrbitMessageAxes, AxesOfDateAndOfAnEpoch) {
  OrbitParameterMessage message = read_opm("a.opm", standard_opm);
  ASSERT_TRUE(message.elements);
  const OrbitParameterMessage of_date = in_frame(message, {"GCRF"});
  EXPECT_FALSE(of_date.elements);
  message.metadata.reference_frame_epoch = message.state.epoch;
  EXPECT_EQ(in_frame(message, {"GCRF"}).state.position_km, of_date.state.position_km);
  // Twenty years of precession are 0.28 degrees.
  message.metadata.reference_frame_epoch = parse_epoch("2001-06-03T00:00:00");
  const double apart =
      distance(in_frame(message, {"GCRF"}).state.position_km, of_date.state.position_km);
  EXPECT_NEAR(apart / 40766 / 4.9e-3, 1, 0.1);
  // Nothing changes where the axes are the same.
  const OrbitParameterMessage same =
      in_frame(message, {"TOD", message.metadata.reference_frame_epoch});
  EXPECT_EQ(same.state.position_km, message.state.position_km);
  EXPECT_EQ(same.state.velocity_km_s, message.state.velocity_km_s);
}

TEST(OrbitMessageAxes, ObjectsOfAConjunction) {
  ConjunctionObject object;
  object.reference_frame = "ITRF";
  object.position_km = {-1033.4793830, 7901.2952754, 6380.3565958};
  object.velocity_km_s = {-3.225636520, -2.872451450, 5.531924446};
  object.covariance[0][0] = 7;
  const ConjunctionObject turned =
      in_frame(object, *parse_epoch("2004-04-06T07:51:28.386009"), "GCRF", table_of_example());
  EXPECT_LT(distance(turned.position_km, {5102.5089578, 6123.0114038, 6378.1369253}), 1.2e-5);
  EXPECT_EQ(turned.reference_frame, "GCRF");
  EXPECT_EQ(turned.covariance, object.covariance);
}

TEST(OrbitMessageAxes, WhatCannotBeTurnedIsRefused) {
  const OrbitParameterMessage message = read_opm("a.opm", standard_opm);
  const auto refused = [&](const OrbitParameterMessage& of, const MessageFrame& frame,
                           const std::string& words) {
    test::expect_error(ErrorKind::input_output, words,
                       [&] { in_frame(of, frame, table_of_example()); });
  };
  refused(message, {"B1950"},
          "REF_FRAME: axes that are not known here, got \"B1950\", must be one of");
  refused(message, {"TEMEOFEPOCH"}, "REF_FRAME_EPOCH: missing, must be the epoch of the axes");
  refused(message, {"ITRF2020"}, "table: no Earth orientation for 2021-06-03");
  OrbitParameterMessage other = message;
  other.metadata.center_name = "MARS";
  refused(other, {"GCRF"}, "CENTER_NAME: axes of the Earth about another centre, got \"MARS\"");
  other = message;
  other.state.epoch = *parse_epoch("1955-01-01T00:00:00");
  refused(other, {"GCRF"}, "no date of UTC, got 1955-01-01, must be from 1960-01-01 on");
  other.metadata.time_system = TimeSystem::tt;
  EXPECT_NO_THROW(in_frame(other, {"GCRF"}));
  test::expect_error(ErrorKind::input_output, "no date of UTC, got 1954-12-31",
                     [&] { in_frame(other, {"ITRF"}); });
}

}  // namespace
}  // namespace hamjet::io
