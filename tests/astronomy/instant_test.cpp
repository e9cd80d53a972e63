#include "hamjet/astronomy/instant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "hamjet/error.hpp"

// Dates in the time systems. Expected values: definitions of the systems (CCSDS 502.0-B-3, annex
// B3), IERS Bulletin C, and for UTC before 1972 the table of the U.S. Naval Observatory.

namespace hamjet {
namespace {

Epoch date_of(const std::string& text) { return parse_epoch(text).value(); }

std::string in(const std::string& text, TimeSystem from, TimeSystem to) {
  const std::string result = format_epoch(epoch_of(instant_of(date_of(text), from), to));
  EXPECT_EQ(instant_of(date_of(result), to), instant_of(date_of(text), from)) << text;
  return result;
}

TEST(Instant, TheLeapSecondOf2016) {
  using enum TimeSystem;
  EXPECT_EQ(in("2016-12-31T23:59:59", utc, tai), "2017-01-01T00:00:35.000000000000");
  EXPECT_EQ(in("2016-12-31T23:59:60", utc, tai), "2017-01-01T00:00:36.000000000000");
  EXPECT_EQ(in("2016-12-31T23:59:60.75", utc, tt), "2017-01-01T00:01:08.934000000000");
  EXPECT_EQ(in("2017-01-01T00:00:00", utc, tai), "2017-01-01T00:00:37.000000000000");
  EXPECT_EQ(in("2017-01-01T00:00:36.5", tai, utc), "2016-12-31T23:59:60.500000000000");
  EXPECT_EQ(seconds_between(instant_of(date_of("2016-12-31T23:59:59"), utc),
                            instant_of(date_of("2017-01-01T00:00:01"), utc)),
            3);
}

TEST(Instant, GpsBeginsAtMidnightOfItsFirstDay) {
  using enum TimeSystem;
  EXPECT_EQ(in("1980-01-06T00:00:00", utc, gps), "1980-01-06T00:00:00.000000000000");
  EXPECT_EQ(in("1980-01-06T00:00:00", utc, tai), "1980-01-06T00:00:19.000000000000");
  EXPECT_EQ(in("2010-07-27T00:00:00", gps, utc), "2010-07-26T23:59:45.000000000000");
}

TEST(Instant, TerrestrialTime) {
  using enum TimeSystem;
  EXPECT_EQ(in("2000-01-01T12:00:00", tt, utc), "2000-01-01T11:58:55.816000000000");
  EXPECT_EQ(in("2000-01-01T12:00:00", tt, tai), "2000-01-01T11:59:27.816000000000");
}

TEST(Instant, UtcBefore1972HadOtherRates) {
  // TAI - UTC = 4.2131700 s + (MJD - 39126) 0.002592 s from 1968-02-01 on; 1970-01-01 12:00 is MJD
  // 40587.5.
  const Instant instant = instant_of(date_of("1970-01-01T12:00:00"), TimeSystem::utc);
  const double expected = 4.2131700 + (40587.5 - 39126) * 0.002592 + 32.184;
  EXPECT_NEAR(convert<double>(seconds_between({date_of("1970-01-01T12:00:00")}, instant)), expected,
              2e-12);
  const Epoch back = epoch_of(instant, TimeSystem::utc);
  EXPECT_NEAR(seconds_between(back, date_of("1970-01-01T12:00:00")), 0, 2e-12);
  // 1.4178180 s + (MJD - 37300) 0.001296 s from 1961-01-01 on and, as ERFA has it, in 1960.
  EXPECT_NEAR(tai_minus_utc(date_of("1961-01-01T00:00:00")), 1.4228180, 1e-12);
}

TEST(Instant, DynamicalTimeIsNearTerrestrialTime) {
  // The Astronomical Almanac's formula, right to 30 microseconds in our time.
  for (const char* date : {"1980-03-01T00:00:00", "2000-01-01T12:00:00", "2023-05-16T20:00:00"}) {
    const Instant instant{date_of(date)};
    const double day_count =
        convert<double>(seconds_between({date_of("2000-01-01T12:00:00")}, instant)) / 86400;
    const double g = (357.53 + 0.98560028 * day_count) * std::numbers::pi / 180;
    const double expected = 0.001657 * std::sin(g) + 0.000014 * std::sin(2 * g);
    EXPECT_NEAR(seconds_between(date_of(date), epoch_of(instant, TimeSystem::tdb)), expected,
                40e-6);
    EXPECT_NEAR(
        seconds_between(date_of(date),
                        epoch_of(instant_of(epoch_of(instant, TimeSystem::tdb), TimeSystem::tdb),
                                 TimeSystem::tt)),
        0, 2e-12);
  }
}

TEST(Instant, JulianDates) {
  const JulianDate date = julian_date(date_of("2000-01-01T12:00:00"), TimeSystem::tt);
  EXPECT_EQ(date.day, 2451544.5);
  EXPECT_EQ(date.fraction, 0.5);
  // The example of SOFA's routine d2dtf: MJD 49533.99999 in UTC is within the leap second of
  // 1994-06-30, whose day has 86 401 s.
  EXPECT_EQ(
      format_epoch(epoch_of_julian_date({2400000.5, 49533.99999}, TimeSystem::utc)).substr(0, 24),
      "1994-06-30T23:59:60.1359");
  for (const JulianDate& parts : {JulianDate{2451545, 0},
                                  {0, 2451545},
                                  {2451544.75, 0.25},
                                  {2451546, -1},
                                  {51544.5, 2400000.5}}) {
    EXPECT_EQ(epoch_of_julian_date(parts, TimeSystem::tt), date_of("2000-01-01T12:00:00"));
  }
  EXPECT_THROW(epoch_of_julian_date({std::numeric_limits<double>::quiet_NaN(), 0}, TimeSystem::tt),
               Error);
  EXPECT_THROW(epoch_of_julian_date({1e9, 0}, TimeSystem::tt), Error);
}

TEST(Instant, WhatUtcDoesNotKnow) {
  try {
    instant_of(date_of("1959-12-31T23:00:00"), TimeSystem::utc);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "no date of UTC, got 1959-12-31, must be from 1960-01-01 on, or in TAI, TT, GPS or TDB");
  }
  EXPECT_THROW(epoch_of({date_of("1959-12-31T23:00:00")}, TimeSystem::utc), Error);
  EXPECT_NO_THROW(instant_of(date_of("1959-12-31T23:00:00"), TimeSystem::tai));
  EXPECT_FALSE(doubt_of_utc(date_of("2016-12-31T23:59:60")));
  const auto doubt = doubt_of_utc(date_of("2049-01-01T00:00:00"));
  ASSERT_TRUE(doubt);
  EXPECT_NE(doubt->find("2049-01-01 UTC is so far ahead"), std::string::npos) << *doubt;
  EXPECT_NE(doubt->find("UTC - TAI is taken as -37 s"), std::string::npos) << *doubt;
}

}  // namespace
}  // namespace hamjet
