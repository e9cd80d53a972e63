#include "arithmetic.hpp"

#include <cfenv>
#include <limits>

#include "hamjet/error.hpp"

namespace hamjet::cli {

void reset_arithmetic() {
  std::fesetenv(FE_DFL_ENV);
  const volatile double smallest_normal = std::numeric_limits<double>::min();
  const volatile double one = 1;
  const volatile double half_epsilon = std::numeric_limits<double>::epsilon() / 2;
  const bool keeps_denormals = smallest_normal / 2 > 0;
  // Ties go to the even neighbour, 1 and -1; other modes move one of the two away.
  const bool rounds_to_nearest = one + half_epsilon == 1 && -one - half_epsilon == -1;
  if (!keeps_denormals || !rounds_to_nearest) {
    throw Error(ErrorKind::numerical,
                "the processor does not round to nearest, or takes denormal numbers for zero, and "
                "cannot be made to do otherwise; results would be wrong");
  }
}

}  // namespace hamjet::cli
