#pragma once

#include <memory>

#include "hamjet/astronomy/earth_orientation.hpp"
#include "hamjet/detail/dynamics/time_function.hpp"

namespace hamjet {

class EarthAttitude;

/// The matrix from GCRF to the Earth's own axes (ITRF) along time, row after row: precession and
/// nutation IAU 2006/2000A with measured offsets, Earth rotation angle, polar motion (IERS
/// Conventions (2010), chapter 5, CIO based). It agrees with ERFA's eraC2t06a to 1e-14.
class EarthRotation final : public TimeFunction {
 public:
  /// Times are counted from `epoch`, in `unit_s` seconds of TT, and go from `first` to `last`, in
  /// either order; a quarter of a day beyond is allowed. What holds without a table of orientation
  /// is said at EarthOrientation::without_table. Throws Error(input_output) if the table does not
  /// have the span, Error(usage) for an epoch before 1960 if there is no table, and
  /// Error(too_large).
  EarthRotation(const Instant& epoch, const Extended& unit_s, double first, double last,
                std::shared_ptr<const EarthOrientation> orientation = nullptr);
  ~EarthRotation() override;

  std::size_t components() const override { return 9; }
  void expand(double t, int degree, double* out) const override;
  void expand(const Extended& t, int degree, Extended* out) const override;

 private:
  std::unique_ptr<const EarthAttitude> attitude_;
};

}  // namespace hamjet
