#include "hamjet/astronomy/earth_axes.hpp"

#include <erfa.h>
#include <erfam.h>

#include <algorithm>
#include <cmath>

#include "hamjet/astronomy/earth_rotation.hpp"
#include "sampled_days.hpp"

namespace hamjet {
namespace {

using Eigen::Matrix3d;

struct NamedAxes {
  std::string_view name;
  EarthAxes axes;
};

constexpr NamedAxes names[] = {{"GCRF", EarthAxes::gcrf},       {"ICRF", EarthAxes::gcrf},
                               {"ICRF1", EarthAxes::gcrf},      {"ICRF2", EarthAxes::gcrf},
                               {"ICRF3", EarthAxes::gcrf},      {"EME2000", EarthAxes::eme2000},
                               {"J2000", EarthAxes::eme2000},   {"MOD", EarthAxes::mod},
                               {"TOD", EarthAxes::tod},         {"TEME", EarthAxes::teme},
                               {"TEMEOFDATE", EarthAxes::teme}, {"TEMEOFEPOCH", EarthAxes::teme},
                               {"CIRF", EarthAxes::cirf}};

/// The beginnings of names of the Earth's own axes, behind which stands a year or a number.
constexpr std::string_view terrestrial[] = {"ITRF", "IGS", "IGB", "WGS84", "WGS-84"};

Matrix3d matrix_of(const double (&m)[3][3]) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&m[0][0]);
}

/// R3(angle): coordinates along axes that are turned by an angle about z.
Matrix3d about_z(double angle) {
  Matrix3d result = Matrix3d::Identity();
  result(0, 0) = result(1, 1) = std::cos(angle);
  result(0, 1) = std::sin(angle);
  result(1, 0) = -result(0, 1);
  return result;
}

bool is_of_true_equator(EarthAxes axes) {
  return axes == EarthAxes::tod || axes == EarthAxes::teme || axes == EarthAxes::cirf;
}

void true_equator_at(double day, double fraction, double* out) {
  double matrix[3][3];
  eraPnm06a(day, fraction, matrix);
  eraBpn2xy(matrix, &out[0], &out[1]);
  out[2] = eraS06(day, fraction, out[0], out[1]);
  out[3] = eraEors(matrix, out[2]);
}

/// ERA - GMST of 1982, of which UT1 - UTC changes less than 1e-11 rad.
double origins_of_1982(const Instant& instant) {
  const Epoch utc = epoch_of(instant, TimeSystem::utc);
  // Without leap seconds in the length of the day: what is wanted is UT1 to some seconds.
  const JulianDate date = julian_date(utc, TimeSystem::tt);
  return eraEra00(date.day, date.fraction) - eraGmst82(date.day, date.fraction);
}

}  // namespace

std::optional<EarthAxes> axes_named(std::string_view name) {
  for (const NamedAxes& named : names) {
    if (named.name == name) return named.axes;
  }
  for (const std::string_view beginning : terrestrial) {
    if (!name.starts_with(beginning)) continue;
    std::string_view rest = name.substr(beginning.size());
    if (rest.starts_with('-')) rest.remove_prefix(1);
    const bool is_number =
        std::all_of(rest.begin(), rest.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (is_number) return EarthAxes::itrf;
  }
  return std::nullopt;
}

Eigen::Matrix<double, 6, 6> AxesChange::of_state() const {
  Eigen::Matrix<double, 6, 6> result = Eigen::Matrix<double, 6, 6>::Zero();
  result.topLeftCorner<3, 3>() = result.bottomRightCorner<3, 3>() = rotation;
  result.bottomLeftCorner<3, 3>() = rate;
  return result;
}

Eigen::Matrix<double, 6, 6> AxesChange::of_covariance(
    const Eigen::Matrix<double, 6, 6>& covariance) const {
  const Eigen::Matrix<double, 6, 6> change = of_state();
  const Eigen::Matrix<double, 6, 6> turned = change * covariance * change.transpose();
  // Rounding must not leave the two halves different.
  return (turned + turned.transpose()) / 2;
}

AxesChange AxesChange::inverse() const { return {rotation.transpose(), rate.transpose()}; }

AxesChange AxesChange::followed_by(const AxesChange& other) const {
  return {other.rotation * rotation, other.rotation * rate + other.rate * rotation};
}

EarthAxesConversion::EarthAxesConversion(EarthAxes from, EarthAxes to, const Instant& first,
                                         const Instant& last,
                                         const std::shared_ptr<const EarthOrientation>& orientation)
    : from_(from), to_(to), first_(first), span_s_(convert<double>(seconds_between(first, last))) {
  if (from == to) return;
  if (is_of_true_equator(from) || is_of_true_equator(to)) {
    pole_ =
        std::make_unique<PiecewiseHermite>(sampled_days(first, 1, 0, span_s_, 4, true_equator_at));
  }
  if (from == EarthAxes::itrf || to == EarthAxes::itrf) {
    rotation_ = std::make_unique<EarthRotation>(first, 1, 0, span_s_, orientation);
  }
}

EarthAxesConversion::~EarthAxesConversion() = default;
EarthAxesConversion::EarthAxesConversion(EarthAxesConversion&&) noexcept = default;
EarthAxesConversion& EarthAxesConversion::operator=(EarthAxesConversion&&) noexcept = default;

AxesChange EarthAxesConversion::from_gcrf(EarthAxes axes, const Instant& instant) const {
  AxesChange result;
  const double t = convert<double>(seconds_between(first_, instant));
  if (axes == EarthAxes::itrf) {
    std::array<double, 18> matrix{};
    rotation_->expand(t, 1, matrix.data());
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const auto place = static_cast<std::size_t>(2 * (3 * i + j));
        result.rotation(i, j) = matrix[place];
        result.rate(i, j) = matrix[place + 1];
      }
    }
  } else if (axes == EarthAxes::eme2000 || axes == EarthAxes::mod) {
    const JulianDate date = julian_date(instant.tt, TimeSystem::tt);
    double bias[3][3], precession[3][3], both[3][3];
    eraBp06(date.day, date.fraction, bias, precession, both);
    result.rotation = matrix_of(axes == EarthAxes::mod ? both : bias);
  } else if (is_of_true_equator(axes)) {
    require_within_span(t, 0, span_s_, 1);
    std::array<PiecewiseHermite::Coefficients<double>, 4> pole;
    pole_->expand(t, 0, pole.data());
    double intermediate[3][3];
    eraC2ixys(pole[0][0], pole[1][0], pole[2][0], intermediate);
    const double origins = axes == EarthAxes::cirf  ? 0
                           : axes == EarthAxes::tod ? pole[3][0]
                                                    : origins_of_1982(instant);
    result.rotation = about_z(origins) * matrix_of(intermediate);
  }
  return result;
}

AxesChange EarthAxesConversion::at(const Instant& instant) const {
  if (from_ == to_) return {};
  return from_gcrf(from_, instant).inverse().followed_by(from_gcrf(to_, instant));
}

AxesChange axes_change(EarthAxes from, EarthAxes to, const Instant& instant,
                       const std::shared_ptr<const EarthOrientation>& orientation) {
  return EarthAxesConversion(from, to, instant, instant, orientation).at(instant);
}

}  // namespace hamjet
