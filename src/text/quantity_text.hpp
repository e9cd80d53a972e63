#pragma once

#include <string>

namespace hamjet {

/// "12.3 ms", "4.56 km", "1.2 MB": three digits and a prefix, for people.
std::string duration_text(double seconds);
std::string length_text(double metres);
std::string memory_text(double bytes);
std::string count_text(double count);

}  // namespace hamjet
