#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "hamjet/astronomy/earth_orientation.hpp"
#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

class EarthRotation;
class PiecewiseHermite;

/// Axes with the Earth's centre as their origin. Precession and nutation are IAU 2006/2000A.
enum class EarthAxes {
  gcrf,     ///< geocentric celestial reference frame; ICRF has the same axes
  eme2000,  ///< mean equator and equinox of J2000, also called J2000: GCRF and the frame bias
  mod,      ///< mean equator and equinox of date
  tod,      ///< true equator and equinox of date, by the model alone
  teme,     ///< true equator of date, mean equinox as GMST of 1982 counts it: axes of TLEs
  cirf,     ///< celestial intermediate reference frame of date, by the model alone
  itrf,     ///< the Earth's own axes, which turn with it
};

/// The axes that a name in capitals means, as orbit messages have it: GCRF, ICRF, ICRF1 to ICRF3,
/// EME2000, J2000, MOD, TOD, TEME, TEMEOFDATE, TEMEOFEPOCH, CIRF, ITRF and its realisations
/// (ITRF2014, ITRF-97, ITRF1997, IGS14, IGB08, WGS84), which differ by centimetres and are taken as
/// one. No value for other names.
std::optional<EarthAxes> axes_named(std::string_view name);

/// A change of axes at one moment: r' = rotation r, v' = rotation v + rate r, with the rate per
/// second.
struct AxesChange {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();

  /// Changes a position and its velocity, of double or Extended.
  template <class Vector3>
  void apply(Vector3& position, Vector3& velocity) const {
    using Real = typename Vector3::Scalar;
    velocity = (rotation.cast<Real>() * velocity + rate.cast<Real>() * position).eval();
    position = (rotation.cast<Real>() * position).eval();
  }
  /// A covariance of (r, v). Its two halves stay equal.
  Eigen::Matrix<double, 6, 6> of_covariance(const Eigen::Matrix<double, 6, 6>& covariance) const;
  /// The matrix that takes a state (r, v).
  Eigen::Matrix<double, 6, 6> of_state() const;
  AxesChange inverse() const;
  /// First this one, then the other one.
  AxesChange followed_by(const AxesChange& other) const;
};

/// The change from one kind of axes to another at moments of a span. Axes of date, other than ITRF,
/// are taken to rest as they lie at the moment, as is usual: their velocities leave out 1e-11
/// rad/s. Velocities in ITRF are the derivatives of the coordinates in it.
class EarthAxesConversion {
 public:
  /// The table is needed for ITRF alone; without one see EarthOrientation::without_table. Throws as
  /// EarthRotation if ITRF is one of the two, and Error(usage) for TEME before 1960.
  EarthAxesConversion(EarthAxes from, EarthAxes to, const Instant& first, const Instant& last,
                      const std::shared_ptr<const EarthOrientation>& orientation = nullptr);
  ~EarthAxesConversion();
  EarthAxesConversion(EarthAxesConversion&&) noexcept;
  EarthAxesConversion& operator=(EarthAxesConversion&&) noexcept;

  /// Throws Error(numerical) for a moment outside the span.
  AxesChange at(const Instant& instant) const;

 private:
  AxesChange from_gcrf(EarthAxes axes, const Instant& instant) const;

  EarthAxes from_;
  EarthAxes to_;
  Instant first_;
  double span_s_;
  /// X, Y, s and the equation of the origins, where axes of the true equator need them.
  std::unique_ptr<const PiecewiseHermite> pole_;
  std::unique_ptr<const EarthRotation> rotation_;
};

/// The change at one moment.
AxesChange axes_change(EarthAxes from, EarthAxes to, const Instant& instant,
                       const std::shared_ptr<const EarthOrientation>& orientation = nullptr);

}  // namespace hamjet
