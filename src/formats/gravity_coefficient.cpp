#include "gravity_coefficient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cstddef>

#include "../text/scene_message.hpp"
#include "../text/whole_number.hpp"
#include "hamjet/error.hpp"
#include "number_table.hpp"

namespace hamjet::io {
namespace {

constexpr double seconds_per_julian_year = 365.25 * 86400;

Extended years_between(const Epoch& from, const Epoch& to) {
  const Extended seconds = Extended((to.day - from.day).count()) * 86400 +
                           Extended(to.picoseconds - from.picoseconds) / 1000000000000;
  return seconds / seconds_per_julian_year;
}

/// A date in the form yyyymmdd or yyyymmdd.hhmm. The minute may be 60, and the hour 24 if the
/// minute is 0: EIGEN-6S4v2 has the earthquake of 2004-12-26, 00:58:53, at 20041226.0060, which is
/// 01:00.
std::optional<Epoch> date_in(std::string_view word) {
  constexpr std::size_t day_digits = 8, digits = 13;
  if (word.size() != day_digits && (word.size() != digits || word[day_digits] != '.')) {
    return std::nullopt;
  }
  const auto day = parse_epoch(
      fmt::format("{}-{}-{}T00:00:00", word.substr(0, 4), word.substr(4, 2), word.substr(6, 2)));
  if (!day || word.size() == day_digits) return day;
  const auto hours = whole_number<unsigned>(word.substr(day_digits + 1, 2));
  const auto minutes = whole_number<unsigned>(word.substr(day_digits + 3));
  if (!hours || !minutes || *minutes > 60) return std::nullopt;
  if (*hours > 23 && (*hours != 24 || *minutes != 0)) return std::nullopt;
  return later(*day, Extended(60 * *hours + *minutes) * 60);
}

/// A date to the minute, as the files have it.
std::string date_text(const Epoch& epoch) { return format_epoch(epoch).substr(0, 16); }

}  // namespace

void NamedFile::fail_at(int line, const std::string& problem) const {
  throw Error(ErrorKind::input_output, fmt::format("{}:{}: {}", name, line, problem));
}

std::optional<Extended> gravity_number(std::string_view word) {
  std::string text(word);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd' || c == 'E'; }, 'e');
  // The number must also fit into double precision, in which scenes have their numbers.
  if (!finite_number(text)) return std::nullopt;
  if (text.starts_with('+')) text.erase(0, 1);
  return finite_extended_number(text);
}

const std::vector<std::string_view>& gravity_record_keys() {
  static const std::vector<std::string_view> keys = {"gfc", "gfct", "trnd", "dot", "asin", "acos"};
  return keys;
}

GravityCoefficient::Kind GravityCoefficient::kind_of(std::string_view key) {
  if (key == "gfc") return Kind::constant;
  if (key == "gfct") return Kind::value;
  if (key == "asin") return Kind::sine;
  return key == "acos" ? Kind::cosine : Kind::trend;
}

std::string GravityCoefficient::name() const {
  return fmt::format("{}({},{})", letter_, degree_, order_);
}

void GravityCoefficient::add(const NamedFile& file, int line,
                             const std::vector<std::string_view>& words, GravityFormat format) {
  Record record;
  record.key = words[0];
  record.kind = kind_of(record.key);
  record.line = line;
  const bool has_interval = format == GravityFormat::icgem2 && record.kind != Kind::constant;
  const bool has_start = has_interval || record.kind == Kind::value;
  const bool has_period = record.kind == Kind::sine || record.kind == Kind::cosine;
  const std::size_t dates = (has_start ? 1U : 0U) + (has_interval ? 1U : 0U);
  const std::size_t behind = dates + (has_period ? 1U : 0U);
  const std::size_t columns = words.size();
  if (columns != 5 + behind && columns != 7 + behind && columns != 9 + behind) {
    file.fail_at(line, fmt::format("{}: has {} columns, must have {} (key, degree, order, C, S{}{}"
                                   "{}), or {} or {} with standard deviations",
                                   record.key, columns, 5 + behind, has_start ? ", t0" : "",
                                   has_interval ? ", t1" : "", has_period ? ", period" : "",
                                   7 + behind, 9 + behind));
  }
  const std::string_view word = words[letter_ == 'C' ? 3 : 4];
  const auto amplitude = gravity_number(word);
  if (!amplitude) {
    file.fail_at(line, fmt::format("{}: must be a finite number, got {}", name(), in_quotes(word)));
  }
  record.amplitude = *amplitude;
  const auto date = [&](std::size_t column, std::string_view which) {
    const auto found = date_in(words[column]);
    if (!found) {
      file.fail_at(line, fmt::format("{}: {} must be a date, yyyymmdd or yyyymmdd.hhmm, got {}",
                                     record.key, which, in_quotes(words[column])));
    }
    return *found;
  };
  if (has_start) record.start = date(columns - behind, "t0");
  if (has_interval) {
    record.end = date(columns - behind + 1, "t1");
    if (*record.end <= *record.start) {
      file.fail_at(line, fmt::format("{}: t1 must be later than t0, got {} and {}", record.key,
                                     date_text(*record.start), date_text(*record.end)));
    }
  }
  if (has_period) {
    const auto period = gravity_number(words.back());
    if (!period || *period <= 0) {
      file.fail_at(line, fmt::format("{}: the period must be a positive number of years, got {}",
                                     record.key, in_quotes(words.back())));
    }
    record.period_years = *period;
  }
  const auto earlier = std::find_if(records_.begin(), records_.end(), [&](const Record& other) {
    return other.is_value() && record.is_value() &&
           (other.kind == Kind::constant || record.kind == Kind::constant);
  });
  if (earlier != records_.end()) {
    file.fail_at(line, fmt::format("{} is there twice, first in line {}", name(), earlier->line));
  }
  records_.push_back(std::move(record));
}

bool GravityCoefficient::varies() const {
  return std::any_of(records_.begin(), records_.end(),
                     [](const Record& record) { return record.kind != Kind::constant; });
}

int GravityCoefficient::line() const {
  const auto value = std::find_if(records_.begin(), records_.end(),
                                  [](const Record& record) { return record.is_value(); });
  return value != records_.end() ? value->line : records_.front().line;
}

const GravityCoefficient::Record& GravityCoefficient::value_at(
    const NamedFile& file, const std::vector<const Record*>& in_force, const Epoch& epoch) const {
  const auto value = std::find_if(in_force.begin(), in_force.end(),
                                  [](const Record* record) { return record->is_value(); });
  if (value != in_force.end()) return **value;
  std::vector<std::string> intervals;
  for (const Record& record : records_) {
    if (!record.is_value()) continue;
    intervals.push_back(
        fmt::format("from {} to {}", date_text(*record.start), date_text(*record.end)));
  }
  if (intervals.empty()) {
    file.fail_at(line(), fmt::format("{}: {} has no gfct or gfc, to which this would be added",
                                     records_.front().key, name()));
  }
  file.fail_at(line(), fmt::format("gfct: {} is not given at the epoch {}, must be {}", name(),
                                   date_text(epoch), fmt::join(intervals, " or ")));
}

Extended GravityCoefficient::contribution(const NamedFile& file, const Record& record,
                                          const Record& value, const Epoch& epoch) const {
  if (record.is_value()) return record.amplitude;
  const auto& start = record.start ? record.start : value.start;
  if (!start) {
    file.fail_at(record.line, fmt::format("{}: {} has no gfct, from whose t0 this is counted",
                                          record.key, name()));
  }
  const Extended years = years_between(*start, epoch);
  if (record.kind == Kind::trend) return record.amplitude * years;
  const Extended phase = 2 * boost::math::constants::pi<Extended>() * years / record.period_years;
  return record.amplitude *
         (record.kind == Kind::sine ? Extended(sin(phase)) : Extended(cos(phase)));
}

Extended GravityCoefficient::at(const NamedFile& file, const std::optional<Epoch>& epoch) const {
  if (!varies()) return records_.front().amplitude;
  if (!epoch) {
    const auto variable = std::find_if(records_.begin(), records_.end(), [](const Record& record) {
      return record.kind != Kind::constant;
    });
    file.fail_at(variable->line,
                 fmt::format("{}: {} varies with time, and nothing says when: must have the key "
                             "gravity_epoch in [system], epoch in [ephemeris], or a nominal from "
                             "an orbit message",
                             variable->key, name()));
  }
  std::vector<const Record*> in_force;
  for (const Record& record : records_) {
    if (!record.holds_at(*epoch)) continue;
    for (const Record* other : in_force) {
      if (!record.is_same_term(*other)) continue;
      file.fail_at(record.line, fmt::format("{}: {} is there twice at the epoch {}, first in line "
                                            "{}",
                                            record.key, name(), date_text(*epoch), other->line));
    }
    in_force.push_back(&record);
  }
  const Record& value = value_at(file, in_force, *epoch);
  Extended sum = 0;
  for (const Record* record : in_force) sum += contribution(file, *record, value, *epoch);
  return sum;
}

}  // namespace hamjet::io
