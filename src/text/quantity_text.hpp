#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace hamjet {

/// A duration, an amount of memory or a count for people, with three digits and a prefix: "12.3
/// ms", "1.2 MB".
std::string duration_text(double seconds);
std::string memory_text(double bytes);
std::string count_text(double count);
/// A number with the noun that it counts: "1 deputy", "2 deputies". `number` may have been
/// formatted already.
std::string counted(std::string_view number, std::string_view noun);
template <std::integral Number>
std::string counted(Number count, std::string_view noun) {
  return counted(std::string_view(std::to_string(count)), noun);
}

/// " (6.56 days)" behind a time in seconds of two days or more; empty for shorter ones.
std::string days_behind(double seconds);

/// A length with this number of digits and a prefix. From one kilometre on it is in kilometres
/// without a further prefix, as is usual for orbits: "42,200 km".
std::string length_text(double metres, int digits = 3);

}  // namespace hamjet
