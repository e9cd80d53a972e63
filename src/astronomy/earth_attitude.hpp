#pragma once

#include <array>
#include <memory>
#include <optional>

#include "hamjet/astronomy/earth_orientation.hpp"
#include "piecewise_hermite.hpp"

namespace hamjet {

/// What turns the Earth besides its steady rotation: the celestial pole (IAU 2006/2000A and
/// measured offsets), the origins of longitudes, UT1, and polar motion, interpolated in time. X, Y
/// and the origins come from ERFA every quarter of a day; interpolation adds less than 1e-18.
class EarthAttitude {
 public:
  /// Taylor coefficients; `longitude` is the slow part of ERA - s + s', the angle from the
  /// celestial intermediate origin to that of terrestrial longitudes, about the intermediate pole.
  template <class Real>
  struct Series {
    using Coefficients = PiecewiseHermite::Coefficients<Real>;
    Coefficients X, Y, longitude, pole_x, pole_y;
  };

  /// Times are counted from `epoch` in `unit_s` and go from `first` to `last`. Without a table UT1
  /// is UTC at the epoch and keeps its distance from TAI. Throws as EarthOrientation::between, and
  /// without a table Error(usage) for an epoch before 1960.
  EarthAttitude(const Instant& epoch, const Extended& unit_s, double first, double last,
                std::shared_ptr<const EarthOrientation> orientation);

  /// Coefficients up to min(most, 7); those above are zero. Throws Error(numerical) outside the
  /// span.
  void expand(double t, int most, Series<double>& out) const;
  void expand(const Extended& t, int most, Series<Extended>& out) const;

  /// Whole turns of the Earth rotation angle at a time, less a whole number, for the part that is
  /// linear in TT; the rest is in `longitude`.
  double turns(double t) const;
  Extended turns(const Extended& t) const;
  const Extended& turns_per_time() const { return rate_; }
  bool has_table() const { return orientation_.has_value(); }

 private:
  template <class Real>
  void expand_as(const Real& t, int most, Series<Real>& out) const;

  double first_;
  double last_;
  double unit_s_;
  PiecewiseHermite pole_;
  std::optional<PiecewiseHermite> orientation_;
  double constant_longitude_ = 0;  ///< that of UT1 - TT, without a table
  Extended rate_;
  Extended turns_at_epoch_;
  double rate_high_;
  double rate_low_;
  double turns_at_epoch_high_;
};

}  // namespace hamjet
