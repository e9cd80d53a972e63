#include "hamjet/astronomy/instant.hpp"

#include <erfa.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using std::chrono::days;
using std::chrono::sys_days;
using std::chrono::year;
using std::chrono::year_month_day;

constexpr std::int64_t tt_minus_tai_ps = 32'184 * (picoseconds_per_second / 1000);
constexpr std::int64_t tai_minus_gps_ps = 19 * picoseconds_per_second;

constexpr sys_days first_day_of_utc = sys_days(year(1960) / 1 / 1);
/// From this day on UTC differs from TAI by whole seconds.
constexpr sys_days first_day_of_leap_seconds = sys_days(year(1972) / 1 / 1);
/// The midnight whose Julian date is 2 440 587.5.
constexpr double julian_date_of_1970 = 2440587.5;

/// Takes whole days out of the picoseconds. Within a leap second there is none to take out, so that
/// this is for systems without them.
Epoch normalised(sys_days day, std::int64_t picoseconds) {
  std::int64_t whole = picoseconds / picoseconds_per_day;
  if (picoseconds % picoseconds_per_day < 0) --whole;
  return {day + days(whole), picoseconds - whole * picoseconds_per_day};
}

/// TAI - UTC in seconds at this part of a day of UTC, and ERFA's word on it: 1 for a year so far
/// ahead that leap seconds may be missing.
int dat(sys_days day, double fraction, double& offset) {
  const year_month_day date(day);
  return eraDat(static_cast<int>(date.year()),
                static_cast<int>(static_cast<unsigned>(date.month())),
                static_cast<int>(static_cast<unsigned>(date.day())), fraction, &offset);
}

void require_utc(sys_days day) {
  if (day >= first_day_of_utc) return;
  throw Error(
      ErrorKind::usage,
      fmt::format("no date of UTC, got {}, must be from 1960-01-01 on, or in TAI, TT, GPS or "
                  "TDB",
                  format_epoch({day, 0}).substr(0, 10)));
}

std::int64_t offset_ps(sys_days day, std::int64_t picoseconds) {
  double offset = 0;
  const double fraction = std::clamp(static_cast<double>(picoseconds) / picoseconds_per_day, 0.0,
                                     std::nextafter(1.0, 0.0));
  dat(day, day >= first_day_of_leap_seconds ? 0.0 : fraction, offset);
  return std::llround(offset * picoseconds_per_second);
}

/// Picoseconds of a day.
std::int64_t length_of_day(sys_days day, TimeSystem system) {
  return picoseconds_per_day +
         (system == TimeSystem::utc && has_leap_second(day) ? picoseconds_per_second : 0);
}

Epoch utc_of_tai(const Epoch& tai) {
  // A day of UTC begins later than the same day of TAI, by the offset at its beginning.
  const auto start = [](sys_days day) { return offset_ps(day, 0); };
  sys_days day = tai.day;
  std::int64_t since = tai.picoseconds - start(day);
  if (since < 0) {
    day -= days(1);
    require_utc(day);
    since = tai.picoseconds + picoseconds_per_day - start(day);
  }
  require_utc(day);
  if (day >= first_day_of_leap_seconds) return {day, since};
  // UTC then ran at another rate than TAI: the offset grows by up to 3e-8 of the time.
  std::int64_t utc = since;
  for (int i = 0; i < 3; ++i) utc = since - (offset_ps(day, utc) - start(day));
  return {day, std::min(utc, picoseconds_per_day - 1)};
}

/// TDB - TT in picoseconds at the Earth's centre.
std::int64_t tdb_minus_tt_ps(const Epoch& tt) {
  const JulianDate date = julian_date(tt, TimeSystem::tt);
  return std::llround(eraDtdb(date.day, date.fraction, 0, 0, 0, 0) * picoseconds_per_second);
}

}  // namespace

Instant instant_of(const Epoch& epoch, TimeSystem system) {
  switch (system) {
    case TimeSystem::tt:
      return {epoch};
    case TimeSystem::tai:
      return {normalised(epoch.day, epoch.picoseconds + tt_minus_tai_ps)};
    case TimeSystem::gps:
      return {normalised(epoch.day, epoch.picoseconds + tai_minus_gps_ps + tt_minus_tai_ps)};
    case TimeSystem::tdb:
      // The difference changes by 3e-10 of the time, so that its own size does not matter.
      return {normalised(epoch.day, epoch.picoseconds - tdb_minus_tt_ps(epoch))};
    case TimeSystem::utc:
      break;
  }
  require_utc(epoch.day);
  return {normalised(
      epoch.day, epoch.picoseconds + offset_ps(epoch.day, epoch.picoseconds) + tt_minus_tai_ps)};
}

Epoch epoch_of(const Instant& instant, TimeSystem system) {
  const auto before = [&](std::int64_t picoseconds) {
    return normalised(instant.tt.day, instant.tt.picoseconds - picoseconds);
  };
  switch (system) {
    case TimeSystem::tt:
      return instant.tt;
    case TimeSystem::tai:
      return before(tt_minus_tai_ps);
    case TimeSystem::gps:
      return before(tt_minus_tai_ps + tai_minus_gps_ps);
    case TimeSystem::tdb:
      return before(-tdb_minus_tt_ps(instant.tt));
    case TimeSystem::utc:
      break;
  }
  return utc_of_tai(before(tt_minus_tai_ps));
}

Instant later(const Instant& instant, const Extended& seconds) {
  const auto result = later(instant.tt, seconds);
  if (!result) {
    throw Error(ErrorKind::usage,
                fmt::format("{} TT and {:.6g} s are outside of the calendar, must be within the "
                            "years 1 to 9999",
                            format_epoch(instant.tt), convert<double>(seconds)));
  }
  return {*result};
}

Extended seconds_between(const Instant& first, const Instant& last) {
  return Extended((last.tt.day - first.tt.day).count()) * 86400 +
         Extended(last.tt.picoseconds - first.tt.picoseconds) / picoseconds_per_second;
}

JulianDate julian_date(const Epoch& epoch, TimeSystem system) {
  return {julian_date_of_1970 + static_cast<double>(epoch.day.time_since_epoch().count()),
          static_cast<double>(epoch.picoseconds) /
              static_cast<double>(length_of_day(epoch.day, system))};
}

Epoch epoch_of_julian_date(const JulianDate& date, TimeSystem system) {
  // The years 1 to 9999 are those from 1 721 425.5 to 5 373 484.5; comparisons refuse NaN.
  const double sum = date.day + date.fraction;
  if (!(sum >= 1721425.5 && sum < 5373484.5)) {
    throw Error(ErrorKind::usage,
                fmt::format("no Julian date of the years 1 to 9999, got {} and {}", date.day,
                            date.fraction));
  }
  const double whole = std::floor(date.day - julian_date_of_1970);
  double rest =
      (date.day - julian_date_of_1970 - whole) + (date.fraction - std::floor(date.fraction));
  double count = whole + std::floor(date.fraction);
  if (rest >= 1) {
    rest -= 1;
    count += 1;
  }
  const sys_days day{days(static_cast<int>(count))};
  const std::int64_t length = length_of_day(day, system);
  const auto picoseconds =
      static_cast<std::int64_t>(std::llround(rest * static_cast<double>(length)));
  return picoseconds < length ? Epoch{day, picoseconds} : Epoch{day + days(1), 0};
}

double tai_minus_utc(const Epoch& utc) {
  require_utc(utc.day);
  return static_cast<double>(offset_ps(utc.day, utc.picoseconds)) / picoseconds_per_second;
}

std::optional<std::string> doubt_of_utc(const Epoch& utc) {
  double offset = 0;
  if (utc.day < first_day_of_utc || dat(utc.day, 0, offset) != 1) return std::nullopt;
  return fmt::format(
      "{} UTC is so far ahead that leap seconds may come before it which are not known here: the "
      "last "
      "one known is that at the end of {}, and UTC - TAI is taken as {:g} s",
      format_epoch(utc).substr(0, 10),
      format_epoch({days_with_leap_second().back(), 0}).substr(0, 10), -offset);
}

}  // namespace hamjet
