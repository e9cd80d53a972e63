#pragma once

#include <string>

namespace hamjet {

/// A value for people, with three digits and a prefix: "12.3 ms", "4.56 km", "1.2 MB".
std::string duration_text(double seconds);
std::string length_text(double metres);
std::string memory_text(double bytes);
std::string count_text(double count);

}  // namespace hamjet
