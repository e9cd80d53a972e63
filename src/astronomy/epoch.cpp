#include "hamjet/astronomy/epoch.hpp"

#include <erfa.h>
#include <fmt/format.h>

#include <algorithm>

namespace hamjet {
namespace {

using std::chrono::day;
using std::chrono::days;
using std::chrono::month;
using std::chrono::sys_days;
using std::chrono::year;
using std::chrono::year_month_day;

constexpr std::int64_t seconds_per_day = 86'400;
constexpr std::size_t most_digits = 12;

constexpr sys_days first_day = sys_days(year(1) / 1 / 1);
constexpr sys_days last_day = sys_days(year(9999) / 12 / 31);

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes exactly `count` digits off the text.
std::optional<int> take_number(std::string_view& text, std::size_t count) {
  if (text.size() < count || !std::all_of(text.begin(), text.begin() + count, is_digit)) {
    return std::nullopt;
  }
  int value = 0;
  for (const char c : text.substr(0, count)) value = 10 * value + (c - '0');
  text.remove_prefix(count);
  return value;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

/// Takes month and day, or the day of the year, which follow the year.
std::optional<sys_days> take_day(std::string_view& text) {
  const auto years = take_number(text, 4);
  if (!years || *years < 1 || !take(text, '-')) return std::nullopt;
  if (text.size() > 3 && text[3] == 'T') {
    const auto number = take_number(text, 3);
    if (!number || *number < 1) return std::nullopt;
    const sys_days found = sys_days(year(*years) / 1 / 1) + days(*number - 1);
    return year_month_day(found).year() == year(*years) ? std::optional(found) : std::nullopt;
  }
  const auto months = take_number(text, 2);
  if (!months || !take(text, '-')) return std::nullopt;
  const auto number = take_number(text, 2);
  if (!number) return std::nullopt;
  const year_month_day found(year(*years), month(static_cast<unsigned>(*months)),
                             day(static_cast<unsigned>(*number)));
  return found.ok() ? std::optional(sys_days(found)) : std::nullopt;
}

/// The digits after a decimal point, in picoseconds.
std::optional<std::int64_t> take_fraction(std::string_view& text) {
  if (!take(text, '.')) return 0;
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  const auto count = static_cast<std::size_t>(end - text.begin());
  if (count == 0) return std::nullopt;
  std::int64_t picoseconds = 0;
  for (std::size_t i = 0; i < most_digits; ++i) {
    picoseconds = 10 * picoseconds + (i < count ? text[i] - '0' : 0);
  }
  text.remove_prefix(count);
  return picoseconds;
}

}  // namespace

const std::vector<std::string_view>& time_system_names() {
  static const std::vector<std::string_view> names = {"UTC", "TAI", "TT", "GPS", "TDB"};
  return names;
}

std::optional<TimeSystem> time_system_named(std::string_view name) {
  const auto& names = time_system_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<TimeSystem>(found - names.begin());
}

const std::vector<sys_days>& days_with_leap_second() {
  static const std::vector<sys_days> table = [] {
    std::vector<sys_days> result;
    double before = 0;
    // Leap seconds stand at the ends of months. A library that is newer than this file may know
    // more.
    for (year_month_day first(year(1972), month(1), day(1)); first.year() < year(2100);
         first += std::chrono::months(1)) {
      double offset = 0;
      eraDat(static_cast<int>(first.year()), static_cast<int>(static_cast<unsigned>(first.month())),
             1, 0.0, &offset);
      if (before > 0 && offset > before) result.push_back(sys_days(first) - days(1));
      before = offset;
    }
    return result;
  }();
  return table;
}

bool has_leap_second(sys_days of_day) {
  const auto& table = days_with_leap_second();
  return std::binary_search(table.begin(), table.end(), of_day);
}

std::optional<Epoch> parse_epoch(std::string_view text) {
  const auto found = take_day(text);
  if (!found || !take(text, 'T')) return std::nullopt;
  const auto hours = take_number(text, 2);
  if (!hours || *hours > 23 || !take(text, ':')) return std::nullopt;
  const auto minutes = take_number(text, 2);
  if (!minutes || *minutes > 59 || !take(text, ':')) return std::nullopt;
  const auto seconds = take_number(text, 2);
  const bool is_last_minute = *hours == 23 && *minutes == 59;
  if (!seconds || *seconds > (is_last_minute && has_leap_second(*found) ? 60 : 59)) {
    return std::nullopt;
  }
  const auto picoseconds = take_fraction(text);
  if (!picoseconds) return std::nullopt;
  take(text, 'Z');
  if (!text.empty()) return std::nullopt;
  const std::int64_t whole = (*hours * 60 + *minutes) * 60 + *seconds;
  return Epoch{*found, whole * picoseconds_per_second + *picoseconds};
}

std::string format_epoch(const Epoch& epoch) {
  const year_month_day date(epoch.day);
  const std::int64_t whole = epoch.picoseconds / picoseconds_per_second;
  const std::int64_t minutes = std::min<std::int64_t>(whole / 60, 24 * 60 - 1);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:012}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     minutes / 60, minutes % 60, whole - 60 * minutes,
                     epoch.picoseconds % picoseconds_per_second);
}

std::optional<Epoch> later(const Epoch& epoch, const Extended& seconds) {
  // This many seconds lead beyond the calendar from any epoch; the comparison is written so that
  // NaN is refused too.
  if (!(abs(seconds) < Extended(seconds_per_day) * (last_day - first_day).count())) {
    return std::nullopt;
  }
  const Extended whole_days = floor(seconds / seconds_per_day);
  const Extended rest = (seconds - whole_days * seconds_per_day) * picoseconds_per_second;
  const std::int64_t picoseconds =
      epoch.picoseconds + static_cast<std::int64_t>(floor(rest + Extended(0.5)));
  const days count(static_cast<int>(whole_days) +
                   static_cast<int>(picoseconds / picoseconds_per_day));
  const Epoch result{epoch.day + count, picoseconds % picoseconds_per_day};
  if (result.day < first_day || result.day > last_day) return std::nullopt;
  return result;
}

std::optional<sys_days> leap_second_between(const Epoch& first, const Epoch& last) {
  const auto& table = days_with_leap_second();
  const auto [begin, end] = std::minmax(first, last);
  const auto next = std::lower_bound(table.begin(), table.end(), begin.day);
  return next != table.end() && *next < end.day ? std::optional(*next) : std::nullopt;
}

}  // namespace hamjet
