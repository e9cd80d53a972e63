#pragma once

#include <string>
#include <vector>

#include "hamjet/astronomy/instant.hpp"

namespace hamjet {

/// How the Earth lies at the beginning of a day of UTC, as the IERS has measured or predicted it.
struct EarthOrientationDay {
  std::chrono::sys_days day;
  double ut1_minus_utc_s = 0;
  double pole_x_arcsec = 0;  ///< polar motion
  double pole_y_arcsec = 0;
  double offset_x_arcsec = 0;  ///< dX, the celestial pole's offset from IAU 2006/2000A
  double offset_y_arcsec = 0;  ///< dY
  bool is_predicted = false;
};

/// Universal time and the poles day by day. Between days they are interpolated, UT1 as UT1 - TAI,
/// which does not jump at leap seconds; tides of a day and half a day in UT1 and polar motion (0.1
/// ms and 0.5 mas, 3 cm at the equator) are not added.
class EarthOrientation {
 public:
  /// Values at one moment.
  struct Values {
    double ut1_minus_tt_s = 0;
    double pole_x = 0;  ///< rad, as the other angles
    double pole_y = 0;
    double offset_x = 0;
    double offset_y = 0;
  };
  /// Values at the beginnings of days.
  struct Day {
    Instant start;
    Values values;
  };

  /// `name` is that of the file, for messages. Throws Error(input_output) without two days in
  /// succession, and for days that do not ascend; Error(usage) for a day before 1960.
  EarthOrientation(std::string name, const std::vector<EarthOrientationDay>& days);

  /// The days from the last one that begins at `first` or before to the first one that begins at
  /// `last` or later, with up to `beyond` more on either side. Throws Error(input_output) for
  /// moments outside of the table or in a gap of it, with the dates that it has.
  std::vector<Day> between(const Instant& first, const Instant& last, std::size_t beyond) const;

  /// The dates that the table has, for messages: "2010-07-18 to 2010-08-07".
  std::string dates() const;

  /// The first day whose values are predictions; no value if there is none.
  const std::optional<std::chrono::sys_days>& first_prediction() const { return first_prediction_; }

  /// What is taken without a table, in one sentence: UT1 = UTC at the start, no polar motion, and
  /// how large these are.
  static std::string without_table();

 private:
  std::string name_;
  std::vector<std::vector<Day>> runs_;  ///< days that follow each other without a gap
  std::optional<std::chrono::sys_days> first_prediction_;
};

}  // namespace hamjet
