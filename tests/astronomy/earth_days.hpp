#pragma once

#include <memory>
#include <vector>

#include "hamjet/astronomy/earth_orientation.hpp"

namespace hamjet {

/// A table of the Earth's orientation that begins on a day and gives each following day by a
/// function of the number of days since then.
template <class OfDay>
std::shared_ptr<const EarthOrientation> table_of_days(std::chrono::sys_days first, int count,
                                                      const OfDay& of_day) {
  std::vector<EarthOrientationDay> days;
  for (int i = 0; i < count; ++i) {
    EarthOrientationDay day = of_day(i);
    day.day = first + std::chrono::days(i);
    days.push_back(day);
  }
  return std::make_shared<EarthOrientation>("table", days);
}

/// The moment of a date in UTC.
inline Instant instant(const char* utc) {
  return instant_of(parse_epoch(utc).value(), TimeSystem::utc);
}

}  // namespace hamjet
