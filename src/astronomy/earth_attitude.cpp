#include "earth_attitude.hpp"

#include <erfa.h>
#include <erfam.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "sampled_days.hpp"

namespace hamjet {
namespace {

/// The Earth rotation angle in turns at the origin of UT1, 2000-01-01 12:00, and its rate in turns
/// per day of UT1 (IERS Conventions (2010), equation 5.15).
constexpr const char* turns_at_origin = "0.7790572732640";
constexpr const char* turns_per_day = "1.00273781191135448";
/// The same rate in radians for each second of UT1.
constexpr double radians_per_s = ERFA_D2PI * 1.00273781191135448 / ERFA_DAYSEC;

void pole_at(double day, double fraction, double* out) {
  double s = 0;
  eraXys06a(day, fraction, &out[0], &out[1], &s);
  out[2] = eraSp00(day, fraction) - s;
}

std::optional<PiecewiseHermite> orientation_between(const Instant& epoch, const Extended& unit_s,
                                                    double first, double last,
                                                    const EarthOrientation* table) {
  if (table == nullptr) return std::nullopt;
  const auto [low, high] = std::minmax(first, last);
  constexpr std::size_t reach = 2;
  const auto days =
      table->between(later(epoch, low * unit_s), later(epoch, high * unit_s), reach + 1);
  std::vector<double> nodes;
  std::vector<std::vector<double>> values(5);
  for (const EarthOrientation::Day& day : days) {
    nodes.push_back(convert<double>(seconds_between(epoch, day.start) / Extended(ERFA_DAYSEC)));
    const EarthOrientation::Values& v = day.values;
    const std::array<double, 5> of_day = {radians_per_s * v.ut1_minus_tt_s, v.pole_x, v.pole_y,
                                          v.offset_x, v.offset_y};
    for (std::size_t c = 0; c < 5; ++c) values[c].push_back(of_day[c]);
  }
  return PiecewiseHermite(std::move(nodes), values, reach, unit_s / Extended(ERFA_DAYSEC));
}

}  // namespace

EarthAttitude::EarthAttitude(const Instant& epoch, const Extended& unit_s, double first,
                             double last, std::shared_ptr<const EarthOrientation> orientation)
    : first_(first),
      last_(last),
      unit_s_(convert<double>(unit_s)),
      pole_(sampled_days(epoch, unit_s, first, last, 3, pole_at)),
      orientation_(orientation_between(epoch, unit_s, first, last, orientation.get())) {
  if (!orientation_) {
    const double ut1_minus_tt = -tai_minus_utc(epoch_of(epoch, TimeSystem::utc)) - ERFA_TTMTAI;
    constant_longitude_ = radians_per_s * ut1_minus_tt;
  }
  const Instant origin{{std::chrono::sys_days(std::chrono::year(2000) / 1 / 1),
                        std::int64_t{43'200} * 1'000'000'000'000}};
  const Extended days = seconds_between(origin, epoch) / Extended(ERFA_DAYSEC);
  const Extended per_day(turns_per_day);
  rate_ = per_day * unit_s / Extended(ERFA_DAYSEC);
  turns_at_epoch_ = Extended(turns_at_origin) + per_day * days;
  turns_at_epoch_ -= floor(turns_at_epoch_);
  rate_high_ = convert<double>(rate_);
  rate_low_ = convert<double>(Extended(rate_ - rate_high_));
  turns_at_epoch_high_ = convert<double>(turns_at_epoch_);
}

double EarthAttitude::turns(double t) const {
  // The product is exact in the fused operation, whose result is small.
  const double whole = std::nearbyint(rate_high_ * t);
  return std::fma(rate_high_, t, -whole) + (rate_low_ * t + turns_at_epoch_high_);
}

Extended EarthAttitude::turns(const Extended& t) const {
  const Extended sum = rate_ * t + turns_at_epoch_;
  return sum - floor(sum);
}

template <class Real>
void EarthAttitude::expand_as(const Real& t, int most, Series<Real>& out) const {
  require_within_span(convert<double>(t), first_, last_, unit_s_);
  using Coefficients = PiecewiseHermite::Coefficients<Real>;
  const auto count = static_cast<std::size_t>(std::min(most, PiecewiseHermite::degree)) + 1;
  std::array<Coefficients, 3> pole;
  pole_.expand(t, most, pole.data());
  std::array<Coefficients, 5> orientation{};
  if (orientation_) {
    orientation_->expand(t, most, orientation.data());
  } else {
    orientation[0][0] = constant_longitude_;
  }
  out = {};
  for (std::size_t k = 0; k < count; ++k) {
    out.X[k] = pole[0][k] + orientation[3][k];
    out.Y[k] = pole[1][k] + orientation[4][k];
    out.longitude[k] = pole[2][k] + orientation[0][k];
    out.pole_x[k] = orientation[1][k];
    out.pole_y[k] = orientation[2][k];
  }
}

void EarthAttitude::expand(double t, int most, Series<double>& out) const {
  expand_as(t, most, out);
}
void EarthAttitude::expand(const Extended& t, int most, Series<Extended>& out) const {
  expand_as(t, most, out);
}

}  // namespace hamjet
