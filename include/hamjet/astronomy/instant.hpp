#pragma once

#include <compare>
#include <optional>
#include <string>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/astronomy/epoch.hpp"

namespace hamjet {

/// A moment that no time system tells apart: the same for all dates of it. It is kept as its date
/// in Terrestrial Time (TT), whose days all have 86 400 s of the SI.
struct Instant {
  Epoch tt;

  auto operator<=>(const Instant&) const = default;
};

/// The moment of a date: TT is TAI + 32.184 s, GPS TAI - 19 s, TDB TT and its periodic terms of
/// 1.7 ms at the Earth's centre (ERFA's eraDtdb, right to microseconds), UTC by the table of leap
/// seconds and, from 1960 to 1971, of its other rates (eraDat). Throws Error(usage) for a date in
/// UTC before 1960, when it began.
Instant instant_of(const Epoch& epoch, TimeSystem system);

/// The date of a moment; a moment within a leap second of UTC has 86 400 s or more of its day.
/// Throws as instant_of.
Epoch epoch_of(const Instant& instant, TimeSystem system);

/// The moment `seconds` of TT later (earlier, if negative), to the picosecond. Throws Error(usage)
/// outside the years 1 to 9999.
Instant later(const Instant& instant, const Extended& seconds);

/// Seconds of TT from one moment to another.
Extended seconds_between(const Instant& first, const Instant& last);

/// A Julian date in two parts, whose sum it is: that of the midnight at which its day begins, which
/// ends in .5, and the part of the day, from 0 to 1. A day of UTC with a leap second has 86 401 s.
struct JulianDate {
  double day = 0;
  double fraction = 0;
};
JulianDate julian_date(const Epoch& epoch, TimeSystem system);

/// The date of a Julian date, however it is divided into two parts, to some 10 ps where the second
/// part is below one day. Throws Error(usage) outside the years 1 to 9999, and for numbers that are
/// not finite.
Epoch epoch_of_julian_date(const JulianDate& date, TimeSystem system);

/// TAI - UTC, in seconds, at a date in UTC. Throws Error(usage) before 1960.
double tai_minus_utc(const Epoch& utc);

/// Why a date in UTC may be wrong by seconds: it lies so far ahead that leap seconds may come which
/// are not known here. No value for other dates.
std::optional<std::string> doubt_of_utc(const Epoch& utc);

}  // namespace hamjet
