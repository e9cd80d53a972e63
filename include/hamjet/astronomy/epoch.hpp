#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// The time systems of orbit messages in which states can be dated by adding seconds.
enum class TimeSystem { utc, tai, tt, gps, tdb };

/// The time systems' names (CCSDS 502.0-B-3, annex B3), in the order of the enumeration.
const std::vector<std::string_view>& time_system_names();

inline std::string_view time_system_name(TimeSystem system) {
  return time_system_names()[static_cast<std::size_t>(system)];
}

/// The time system of a name; no value for any other text.
std::optional<TimeSystem> time_system_named(std::string_view name);

inline constexpr std::int64_t picoseconds_per_second = 1'000'000'000'000;
/// The picoseconds of a day without a leap second.
inline constexpr std::int64_t picoseconds_per_day = 86'400 * picoseconds_per_second;

/// A moment on the calendar of a time system, to the picosecond (in which a satellite moves by 8
/// nanometres).
struct Epoch {
  std::chrono::sys_days day;
  std::int64_t picoseconds =
      0;  ///< since the beginning of the day; 86 400 s or more within a leap second of UTC

  auto operator<=>(const Epoch&) const = default;
  bool is_within_leap_second() const { return picoseconds >= picoseconds_per_day; }
};

/// Reads YYYY-MM-DDThh:mm:ss or YYYY-DDDThh:mm:ss, each with an optional fraction of a second
/// (digits below a picosecond are cut off) and an optional Z (CCSDS 502.0-B-3, 7.5.10; CCSDS
/// 301.0-B-4, ASCII time codes A and B). The second 60 is read only where UTC had one. No value for
/// any other text, or a day that the calendar does not have.
std::optional<Epoch> parse_epoch(std::string_view text);

/// An epoch as YYYY-MM-DDThh:mm:ss with 12 digits after the point.
std::string format_epoch(const Epoch& epoch);

/// The moment `seconds` later (earlier, if negative), rounded to a picosecond; every day counts 86
/// 400 s. No value outside the years 1 to 9999. `epoch` must not be within a leap second.
std::optional<Epoch> later(const Epoch& epoch, const Extended& seconds);

/// Seconds from one moment to another, to binary64; every day counts 86 400 s.
inline double seconds_between(const Epoch& first, const Epoch& last) {
  return 86400.0 * static_cast<double>((last.day - first.day).count()) +
         1e-12 * static_cast<double>(last.picoseconds - first.picoseconds);
}

/// Days of UTC that ended with a leap second, ascending: all from the introduction of leap seconds
/// in 1972 to the last one that ERFA knows, at the end of 2016. Source: IERS Bulletin C.
const std::vector<std::chrono::sys_days>& days_with_leap_second();

/// Whether a day of UTC is one of them, and has 86 401 s.
bool has_leap_second(std::chrono::sys_days day);

/// The first day whose leap second lies between two moments of UTC, so that counting 86 400 s per
/// day does not lead from one to the other. No value if there is none.
std::optional<std::chrono::sys_days> leap_second_between(const Epoch& first, const Epoch& last);

}  // namespace hamjet
