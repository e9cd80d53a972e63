#include "time_axis.hpp"

#include <cmath>

namespace hamjet::io {

TimeAxis time_axis(double longest_s) {
  if (std::abs(longest_s) > 4 * 86400) return {86400, "days"};
  if (std::abs(longest_s) > 3 * 3600) return {3600, "h"};
  if (std::abs(longest_s) > 600) return {60, "min"};
  return {1, "s"};
}

}  // namespace hamjet::io
