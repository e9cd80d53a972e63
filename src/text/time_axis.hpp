#pragma once

namespace hamjet::io {

/// The unit of an axis or a column of times: minutes, hours or days where the numbers in seconds
/// would be long.
struct TimeAxis {
  double seconds;    ///< seconds in one unit
  const char* name;  ///< name of the unit, as in "transfer time (h)"
};
TimeAxis time_axis(double longest_s);

}  // namespace hamjet::io
