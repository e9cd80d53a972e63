#include "hamjet/astronomy/epoch.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

// Moments of the calendar. Expected values: the Gregorian calendar, and Debian's copy of the list
// of leap seconds of the IERS.

namespace hamjet {
namespace {

using std::chrono::days;
using std::chrono::sys_days;
using std::chrono::year;

Epoch epoch(const std::string& text) {
  const auto parsed = parse_epoch(text);
  EXPECT_TRUE(parsed) << text;
  return parsed.value_or(Epoch{});
}

TEST(Epoch, BothFormsOfTheStandardAreRead) {
  EXPECT_EQ(format_epoch(epoch("2000-02-29T01:02:03")), "2000-02-29T01:02:03.000000000000");
  EXPECT_EQ(epoch("2000-060T01:02:03Z"), epoch("2000-02-29T01:02:03.0"));
  EXPECT_EQ(epoch("2001-365T23:59:59"), epoch("2001-12-31T23:59:59"));
  EXPECT_EQ(epoch("1996-12-18T14:28:15.1172"), epoch("1996-12-18T14:28:15.117200000000999"));
  EXPECT_LT(epoch("1996-12-18T14:28:15.1172"), epoch("1996-12-18T14:28:15.117200000001"));
}

TEST(Epoch, WhatIsNoMomentIsRefused) {
  for (const char* text : {"",
                           "2000",
                           "2001-02-29T00:00:00",
                           "2001-366T00:00:00",
                           "2001-000T00:00:00",
                           "2000-13-01T00:00:00",
                           "2000-00-01T00:00:00",
                           "2000-01-32T00:00:00",
                           "0000-01-01T00:00:00",
                           "2000-01-01T24:00:00",
                           "2000-01-01T00:60:00",
                           "2000-01-01T00:00:60",
                           "2000-01-01T00:00:00.",
                           "2000-01-01T00:00:00,5",
                           "2000-01-01 00:00:00",
                           "2000-01-01T00:00:00z",
                           "2000-1-1T0:0:0",
                           "2000-01-01T00:00:00ZZ",
                           "2000-01-01T00:00",
                           "-200-01-01T00:00:00",
                           "2000-01-01T00:00:+1",
                           "2000-06-30T23:59:60",
                           "20000-01-01T00:00:00",
                           "2000-01-01T00:00:00+00:00"}) {
    EXPECT_FALSE(parse_epoch(text)) << text;
  }
}

TEST(Epoch, SecondsAreAddedOnTheCalendar) {
  // The cases are a thousand million seconds after the start of 1970, a leap day, and a year
  // without a leap day.
  EXPECT_EQ(later(epoch("1970-01-01T00:00:00"), 1e9), epoch("2001-09-09T01:46:40"));
  EXPECT_EQ(later(epoch("2024-02-28T23:59:59.5"), 1), epoch("2024-02-29T00:00:00.5"));
  EXPECT_EQ(later(epoch("2025-01-01T00:00:00"), 365 * 86400), epoch("2026-01-01T00:00:00"));
  EXPECT_EQ(later(epoch("2000-01-01T00:00:00"), Extended("-1e-12")),
            epoch("1999-12-31T23:59:59.999999999999"));
  EXPECT_EQ(later(epoch("2000-01-01T00:00:00"), Extended("-4e-13")), epoch("2000-01-01T00:00:00"));
  EXPECT_EQ(later(epoch("1999-12-31T23:59:59"), Extended("0.9999999999996")),
            epoch("2000-01-01T00:00:00"));
}

TEST(Epoch, TheCalendarEndsSomewhere) {
  EXPECT_TRUE(later(epoch("9999-12-31T23:59:59"), 0.5));
  EXPECT_FALSE(later(epoch("9999-12-31T23:59:59"), 1));
  EXPECT_FALSE(later(epoch("0001-01-01T00:00:00"), -1));
  EXPECT_FALSE(later(epoch("2000-01-01T00:00:00"), 1e300));
  EXPECT_FALSE(later(epoch("2000-01-01T00:00:00"), std::numeric_limits<double>::quiet_NaN()));
}

TEST(Epoch, LeapSeconds) {
  EXPECT_EQ(format_epoch(epoch("2016-12-31T23:59:60.25")), "2016-12-31T23:59:60.250000000000");
  EXPECT_LT(epoch("2016-12-31T23:59:59.9"), epoch("2016-12-31T23:59:60"));
  EXPECT_LT(epoch("2016-12-31T23:59:60.9"), epoch("2017-01-01T00:00:00"));
  const Epoch before = epoch("2016-12-31T12:00:00");
  const Epoch after = epoch("2017-01-01T00:00:00");
  EXPECT_EQ(leap_second_between(before, after), sys_days(year(2016) / 12 / 31));
  EXPECT_EQ(leap_second_between(after, before), sys_days(year(2016) / 12 / 31));
  EXPECT_FALSE(leap_second_between(after, epoch("2100-01-01T00:00:00")));
  EXPECT_FALSE(leap_second_between(epoch("2015-07-01T00:00:00"), before));
}

TEST(Epoch, TheTableOfLeapSecondsIsThatOfTheIers) {
  // Seconds since 1900 at which the difference of TAI and UTC begins to hold; the first line is the
  // difference of 10 s at the start of 1972, when there was no leap second yet.
  const std::filesystem::path list = "/usr/share/zoneinfo/leap-seconds.list";
  std::ifstream file(list);
  if (!file) GTEST_SKIP() << "no " << list;
  std::vector<sys_days> expected;
  for (std::string line; std::getline(file, line);) {
    long seconds = 0;
    if (line.starts_with('#') || !(std::istringstream(line) >> seconds)) continue;
    expected.push_back(sys_days(year(1900) / 1 / 1) + days(seconds / 86400 - 1));
  }
  ASSERT_GE(expected.size(), 28U);
  expected.erase(expected.begin());
  EXPECT_EQ(days_with_leap_second(), expected);
}

}  // namespace
}  // namespace hamjet
