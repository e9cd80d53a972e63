#pragma once

namespace hamjet::io {

/// The unit of an axis or a column of times: minutes or hours where seconds would be long numbers.
struct TimeAxis {
  double seconds;    ///< in one unit
  const char* name;  ///< as in "transfer time (h)"
};
TimeAxis time_axis(double longest_s);

}  // namespace hamjet::io
