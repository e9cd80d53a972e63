#include "earth_forces.hpp"

#include <erfa.h>
#include <erfam.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "light.hpp"

namespace attack {
namespace {

constexpr Real pi = 3.14159265358979323846264338327950288L;
constexpr Real day_s = 86400;

std::size_t at(int n, int m) { return std::size_t(n) * std::size_t(n + 1) / 2 + std::size_t(m); }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

/// Coordinates along axes that are turned by an angle about one of them.
Matrix turned(int axis, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  Matrix a{};
  a[axis][axis] = 1;
  a[j][j] = a[k][k] = c;
  a[j][k] = s;
  a[k][j] = -s;
  return a;
}

Vector apply(const Matrix& a, const Vector& x) {
  Vector y;
  for (int i = 0; i < 3; ++i) y[i] = a[i][0] * x[0] + a[i][1] * x[1] + a[i][2] * x[2];
  return y;
}

Vector apply_transposed(const Matrix& a, const Vector& x) {
  Vector y;
  for (int i = 0; i < 3; ++i) y[i] = a[0][i] * x[0] + a[1][i] * x[1] + a[2][i] * x[2];
  return y;
}

Matrix of_doubles(const double (&m)[3][3]) {
  Matrix a;
  for (int i = 0; i < 3; ++i) std::copy(m[i], m[i] + 3, a[i].begin());
  return a;
}

Real cube(const Vector& x) {
  const Real r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  return r * r * r;
}

/// Value and three derivatives, over factorials, at the third of five points, of the polynomial
/// through them, whose products are multiplied out.
std::array<Real, 4> about_middle(const std::array<Real, 5>& x, const std::array<Real, 5>& f) {
  std::array<Real, 4> sum{};
  for (int i = 0; i < 5; ++i) {
    std::array<Real, 6> basis{f[i]};
    for (int j = 0; j < 5; ++j) {
      if (j == i) continue;
      const Real shift = x[2] - x[j], over = x[i] - x[j];
      for (int k = 5; k >= 0; --k) {
        basis[k] = (basis[k] * shift + (k > 0 ? basis[k - 1] : 0)) / over;
      }
    }
    for (int k = 0; k < 4; ++k) sum[k] += basis[k];
  }
  return sum;
}

/// Newton's form of the polynomial of degree 7 that has value and three derivatives at two points:
/// divided differences with points that coincide.
std::array<Real, 8> newton_between(Real x0, const std::array<Real, 4>& left, Real x1,
                                   const std::array<Real, 4>& right) {
  std::array<Real, 8> point, table, newton;
  for (int i = 0; i < 8; ++i) {
    point[i] = i < 4 ? x0 : x1;
    table[i] = i < 4 ? left[0] : right[0];
  }
  newton[0] = table[0];
  for (int order = 1; order < 8; ++order) {
    for (int i = 0; i + order < 8; ++i) {
      const Real width = point[i + order] - point[i];
      table[i] = width == 0 ? (i < 4 ? left : right)[order] : (table[i + 1] - table[i]) / width;
    }
    newton[order] = table[0];
  }
  return newton;
}

constexpr Real OrientationRow::*members[] = {&OrientationRow::ut1_minus_tt_s,
                                             &OrientationRow::pole_x, &OrientationRow::pole_y,
                                             &OrientationRow::offset_x, &OrientationRow::offset_y};

/// The height above the ellipsoid of WGS 84, in metres, of a point outside it. With the foot's
/// normal x - x_f = s (x_f/a^2, y_f/a^2, z_f/b^2) the foot lies on the ellipsoid where
///   (a p / (a^2 + s))^2 + (b z / (b^2 + s))^2 = 1 ,
/// whose left side is convex, so that Newton's method from s = 0 never goes too far.
Real height_of(const Vector& x) {
  constexpr Real a = 6378137, b = a * (1 - 1 / 298.257223563L);
  const Real p = std::hypot(x[0], x[1]), z = x[2];
  Real s = 0;
  for (int k = 0; k < 30; ++k) {
    const Real across = p / (a * a + s), along = z / (b * b + s);
    const Real excess = a * a * across * across + b * b * along * along - 1;
    const Real slope =
        -2 * (a * a * across * across / (a * a + s) + b * b * along * along / (b * b + s));
    const Real step = -excess / slope;
    s += step;
    if (std::abs(step) <= 1e-20L * a * a) break;
  }
  return s * std::hypot(p / (a * a + s), z / (b * b + s));
}

Real density_of(const std::vector<DensityPiece>& profile, Real height_km) {
  const auto above = std::upper_bound(
      profile.begin(), profile.end(), height_km,
      [](Real height, const DensityPiece& piece) { return height < piece.height_km; });
  const bool is_below = above == profile.begin();
  const DensityPiece& piece = is_below ? *above : *(above - 1);
  const Real d = height_km - piece.height_km;
  Real log_density = 0;
  for (int k = is_below ? 1 : 7; k >= 0; --k) log_density = log_density * d + piece.log_density[k];
  return std::exp(log_density);
}

}  // namespace

Earth::Earth(EarthSettings settings) : settings_(std::move(settings)) {
  // Factors of the recursion of Legendre's functions, normalised fully and divided by cos^m.
  const int n_most = settings_.degree + 1;
  of_diagonal_.resize(n_most + 1);
  first_factor_.resize(at(n_most, n_most) + 1);
  second_factor_ = of_slope_ = first_factor_;
  for (int n = 1; n <= n_most; ++n) {
    of_diagonal_[n] = std::sqrt(Real(2 * n + 1) / (n == 1 ? 1 : 2 * n));
    for (int m = 0; m < n; ++m) {
      const Real across = Real(n - m) * (n + m);
      first_factor_[at(n, m)] = std::sqrt(Real(2 * n + 1) * (2 * n - 1) / across);
      if (m < n - 1) {
        second_factor_[at(n, m)] =
            std::sqrt(Real(2 * n + 1) * (n - m - 1) * (n + m - 1) / (across * (2 * n - 3)));
      }
      of_slope_[at(n, m)] = std::sqrt(Real(n - m) * (n + m + 1) / (m == 0 ? 2 : 1));
    }
  }
}

/// Pines's form, which has no poles: with (s, t, u) = x/r, A_nm(u) = P_nm/cos^m and
/// (s + i t)^m = a_m + i b_m the potential is U = sum mu/r (R/r)^n A_nm (C a_m + S b_m), and
///   grad U = (U_s, U_t, U_u)/r + x/r (U_r - (s U_s + t U_t + u U_u)/r).
Vector Earth::harmonics(const Vector& x) const {
  const int degree = settings_.degree;
  const Real r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  const Real s = x[0] / r, t = x[1] / r, u = x[2] / r;
  constexpr int most = 80;  // above the highest degree that is drawn, by more than 1
  std::array<Real, most> a{}, b{}, before{}, last{}, here{};
  a[0] = 1;
  for (int m = 1; m <= degree; ++m) {
    a[m] = s * a[m - 1] - t * b[m - 1];
    b[m] = s * b[m - 1] + t * a[m - 1];
  }
  last[0] = 1;
  Real slope_s = 0, slope_t = 0, slope_u = 0, radial = 0;
  Real ratio = settings_.mu / (r * r);
  for (int n = 1; n <= degree; ++n) {
    for (int m = 0; m < n; ++m) {
      here[m] = first_factor_[at(n, m)] * u * last[m] - second_factor_[at(n, m)] * before[m];
    }
    here[n] = of_diagonal_[n] * last[n - 1];
    here[n + 1] = 0;
    ratio *= settings_.radius / r;
    for (int m = 0; n >= 2 && m <= n; ++m) {
      const Real C = settings_.C[at(n, m)], S = settings_.S[at(n, m)];
      const Real wave = C * a[m] + S * b[m];
      const Real rise = (m < n ? of_slope_[at(n, m)] * here[m + 1] : 0) * wave;
      slope_u += ratio * rise;
      if (m > 0) {
        slope_s += ratio * m * here[m] * (C * a[m - 1] + S * b[m - 1]);
        slope_t += ratio * m * here[m] * (S * a[m - 1] - C * b[m - 1]);
      }
      radial -= ratio * ((n + m + 1) * here[m] * wave + u * rise);
    }
    before = last;
    last = here;
  }
  return {slope_s + s * radial, slope_t + t * radial, slope_u + u * radial};
}

void Earth::sample(Real time, double* values) const {
  const double fraction = double((settings_.tt_seconds + time) / day_s);
  double s = 0;
  eraXys06a(settings_.tt_day, fraction, &values[0], &values[1], &s);
  values[2] = s;
  values[3] = eraSp00(settings_.tt_day, fraction);
  double of_sun[2][3], barycentric[2][3], moon[2][3];
  eraEpv00(settings_.tt_day, fraction, of_sun, barycentric);
  eraMoon98(settings_.tt_day, fraction, moon);
  for (int i = 0; i < 3; ++i) {
    values[4 + i] = -of_sun[0][i] * ERFA_DAU;
    values[7 + i] = moon[0][i] * ERFA_DAU;
  }
}

const Earth::Day& Earth::day(long number) {
  const auto found = days_.find(number);
  if (found != days_.end()) return found->second;
  Day& coefficients = days_[number];
  for (int k = 0; k < nodes; ++k) {
    const Real angle = pi * (k + 0.5L) / nodes;
    double values[components];
    sample((Real(number) + std::cos(angle) / 2) * day_s, values);
    for (int j = 0; j < nodes; ++j) {
      const Real weight = (j == 0 ? 1 : 2) * std::cos(j * angle) / nodes;
      for (int c = 0; c < components; ++c) coefficients[j][c] += weight * values[c];
    }
  }
  return coefficients;
}

const Earth::Values& Earth::slow(Real time) {
  if (has_slow_ && slow_time_ == time) return slow_;
  const Real whole = std::round(time / day_s);
  const Day& coefficients = day(long(whole));
  const Real x = 2 * (time / day_s - whole);
  // Clenshaw's recurrence.
  Values next{}, after{};
  for (int j = nodes - 1; j > 0; --j) {
    for (int c = 0; c < components; ++c) {
      const Real value = coefficients[j][c] + 2 * x * next[c] - after[c];
      after[c] = next[c];
      next[c] = value;
    }
  }
  for (int c = 0; c < components; ++c) slow_[c] = coefficients[0][c] + x * next[c] - after[c];
  slow_time_ = time;
  has_slow_ = true;
  return slow_;
}

OrientationRow Earth::orientation(Real time) {
  OrientationRow result{time, settings_.ut1_minus_tt_s, 0, 0, 0, 0};
  const auto& rows = settings_.rows;
  if (rows.empty()) return result;
  const auto later =
      std::upper_bound(rows.begin(), rows.end(), time,
                       [](Real moment, const OrientationRow& row) { return moment < row.time_s; });
  const auto i = std::clamp<std::ptrdiff_t>(later - rows.begin() - 1, 2, std::ssize(rows) - 4);
  const Real x0 = rows[i].time_s / day_s, x1 = rows[i + 1].time_s / day_s;
  auto& forms = between_rows_[i];
  if (forms.empty()) {
    for (const auto member : members) {
      const auto node = [&](std::ptrdiff_t middle) {
        std::array<Real, 5> x, f;
        for (int k = 0; k < 5; ++k) {
          x[k] = rows[middle + k - 2].time_s / day_s;
          f[k] = rows[middle + k - 2].*member;
        }
        return about_middle(x, f);
      };
      forms.push_back(newton_between(x0, node(i), x1, node(i + 1)));
    }
  }
  const Real from0 = time / day_s - x0, from1 = time / day_s - x1;
  for (std::size_t c = 0; c < forms.size(); ++c) {
    Real value = forms[c][7];
    for (int k = 6; k >= 0; --k) value = value * (k < 4 ? from0 : from1) + forms[c][k];
    result.*members[c] = value;
  }
  return result;
}

/// R1(-yp) R2(-xp) R3(s') R3(ERA) R3(-(e + s)) R2(d) R3(e), where (d, e) is the direction of the
/// pole (IERS Conventions 2010, equations 5.1, 5.6 and 5.15).
Matrix Earth::itrf(Real time) {
  if (has_itrf_ && itrf_time_ == time) return itrf_;
  const Values& now = slow(time);
  const OrientationRow row = orientation(time);
  const Real X = now[0] + row.offset_x, Y = now[1] + row.offset_y;
  const Real e = std::atan2(Y, X), d = std::asin(std::hypot(X, Y));
  // Whole turns are left out before they are rounded.
  const Real since_noon = (settings_.tt_seconds + time + row.ut1_minus_tt_s) / day_s - 0.5L;
  const Real days = Real(settings_.tt_day - 2451544.5);
  const Real turns =
      0.7790572732640L + 0.00273781191135448L * days + 1.00273781191135448L * since_noon;
  const Real angle = 2 * pi * (turns - std::floor(turns));
  itrf_ = product(turned(2, angle + now[3] - (e + now[2])), product(turned(1, d), turned(2, e)));
  itrf_ = product(turned(0, -row.pole_y), product(turned(1, -row.pole_x), itrf_));
  itrf_time_ = time;
  has_itrf_ = true;
  return itrf_;
}

Matrix Earth::axes(Axes axes, Real time) {
  if (axes == Axes::itrf) return itrf(time);
  const double fraction = double((settings_.tt_seconds + time) / day_s);
  double bias[3][3], precession[3][3], both[3][3], matrix[3][3];
  eraBp06(settings_.tt_day, fraction, bias, precession, both);
  if (axes == Axes::eme2000) return of_doubles(bias);
  if (axes == Axes::mod) return of_doubles(both);
  eraPnm06a(settings_.tt_day, fraction, matrix);
  return of_doubles(matrix);
}

Matrix Earth::rate_of_itrf(Real time) {
  // Differences of the eighth order over minutes, in which the Earth turns by 4e-3.
  constexpr Real weights[] = {4.0L / 5, -1.0L / 5, 4.0L / 105, -1.0L / 280};
  constexpr Real step = 60;
  Matrix rate{};
  for (int k = 1; k <= 4; ++k) {
    const Matrix ahead = itrf(time + k * step), behind = itrf(time - k * step);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        rate[i][j] += weights[k - 1] * (ahead[i][j] - behind[i][j]) / step;
      }
    }
  }
  return rate;
}

/// The apex of the bulge is the direction of the Sun, turned by two hours about the z axis of GCRF
/// (Montenbruck and Gill, section 3.5); its share is cos^n(psi/2) of the angle to it. The air turns
/// about the third axis of ITRF.
Drag Earth::drag(const Vector& x, Real time) {
  const Matrix fixed = itrf(time);
  const Real height_km = height_of(apply(fixed, x)) / 1000;
  const auto& profiles = settings_.air.profiles;
  Real density = density_of(profiles[0], height_km);
  if (profiles.size() > 1) {
    const Values& now = slow(time);
    const Vector apex = apply(turned(2, -pi / 6), {now[4], now[5], now[6]});
    const Real cosine =
        (apex[0] * x[0] + apex[1] * x[1] + apex[2] * x[2]) / std::cbrt(cube(apex) * cube(x));
    const Real share = std::pow((1 + cosine) / 2, settings_.air.exponent / Real(2));
    density += share * (density_of(profiles[1], height_km) - density);
  }
  constexpr Real turn = 7.292115e-5L;
  const Vector& w = fixed[2];
  return {density * settings_.air.drag_m2_kg / 2,
          {turn * (w[1] * x[2] - w[2] * x[1]), turn * (w[2] * x[0] - w[0] * x[2]),
           turn * (w[0] * x[1] - w[1] * x[0])}};
}

Vector Earth::sun(Real time) {
  const Values& now = slow(time);
  return {now[4], now[5], now[6]};
}

Vector Earth::acceleration(const Vector& x, Real time) {
  const Real r3 = cube(x);
  Vector sum{};
  if (settings_.degree >= 2) {
    const Matrix fixed = itrf(time);
    sum = apply_transposed(fixed, harmonics(apply(fixed, x)));
  }
  const auto add = [&](Real mu, int first) {
    if (mu == 0) return;
    const Values& now = slow(time);
    const Vector body = {now[first], now[first + 1], now[first + 2]};
    const Vector way = {body[0] - x[0], body[1] - x[1], body[2] - x[2]};
    const Real near = cube(way), far = cube(body);
    for (int i = 0; i < 3; ++i) sum[i] += mu * (way[i] / near - body[i] / far);
  };
  add(settings_.mu_sun, 4);
  add(settings_.mu_moon, 7);
  if (settings_.radiation_m2_kg != 0) {
    // The irradiance of 1361 W/m^2 at one astronomical unit over the speed of light.
    const Values& now = slow(time);
    const Vector way = {now[4] - x[0], now[5] - x[1], now[6] - x[2]};
    const Real seen = piece_ ? piece_->at(time) : 1;
    const Real pressure =
        seen * 1361.0L / 299792458.0L * Real(ERFA_DAU) * Real(ERFA_DAU) / cube(way);
    for (int i = 0; i < 3; ++i) sum[i] -= settings_.radiation_m2_kg * pressure * way[i];
  }
  for (int i = 0; i < 3; ++i) sum[i] -= settings_.mu * x[i] / r3;
  return sum;
}

}  // namespace attack
