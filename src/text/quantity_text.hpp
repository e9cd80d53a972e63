#pragma once

#include <string>

namespace hamjet {

/// A value for people, with three digits and a prefix: "12.3 ms", "4.56 km", "1.2 MB".
std::string duration_text(double seconds);
std::string memory_text(double bytes);
std::string count_text(double count);
/// A length likewise, but in kilometres from one of them on, as orbits are told: "42,200 km".
std::string length_text(double metres, int digits = 3);

}  // namespace hamjet
