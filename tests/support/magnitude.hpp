#pragma once

#include <cmath>

#include "hamjet/algebra/extended.hpp"

namespace hamjet::test {

inline double magnitude_of(const Extended& x) { return std::abs(static_cast<double>(x)); }

}  // namespace hamjet::test
