#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace hamjet {

/// A value for people, with three digits and a prefix: "12.3 ms", "4.56 km", "1.2 MB".
std::string duration_text(double seconds);
std::string memory_text(double bytes);
std::string count_text(double count);
/// So many of what a noun names: "1 deputy", "2 deputies". A number that is written already has the
/// same words.
std::string counted(std::string_view number, std::string_view noun);
template <std::integral Number>
std::string counted(Number count, std::string_view noun) {
  return counted(std::string_view(std::to_string(count)), noun);
}

/// A length with so many digits and a prefix, but in kilometres from one of them on, as orbits are
/// told: "42,200 km".
std::string length_text(double metres, int digits = 3);

}  // namespace hamjet
