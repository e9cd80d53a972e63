#include "hamjet/astronomy/body_position.hpp"

#include <erfa.h>
#include <erfam.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "hamjet/error.hpp"

// Sun and Moon along time. Expected values: the test cases that come with SOFA, and ERFA's routines
// at other moments.

namespace hamjet {
namespace {

using std::chrono::days;
using std::chrono::sys_days;
using std::chrono::year;

constexpr double au_km = ERFA_DAU / 1000;

/// A moment told by its modified Julian date in TT.
Instant of_mjd(int day, double fraction) {
  return {{sys_days(year(1858) / 11 / 17) + days(day),
           static_cast<std::int64_t>(std::llround(fraction * 86400e12))}};
}

std::array<double, 6> state_at(const BodyPosition& body, double t) {
  std::array<double, 6> out{};
  body.expand(t, 1, out.data());
  return out;
}

TEST(BodyPosition, TestCasesOfSofa) {
  // iauMoon98 of MJD 43999.9 and iauEpv00 of MJD 53411.52501161 (the Earth about the Sun), in AU
  // and AU per day.
  const BodyPosition moon(PerturbingBody::moon, of_mjd(43999, 0.9), 86400, au_km, 0, 1);
  const auto of_moon = state_at(moon, 0);
  EXPECT_NEAR(of_moon[0], -0.2601295959971044180e-2, 1e-14);
  EXPECT_NEAR(of_moon[2], 0.6139750944302742189e-3, 1e-14);
  EXPECT_NEAR(of_moon[4], 0.2640794528229828909e-3, 1e-14);
  // ERFA's velocities are derivatives of its series, but of the precession.
  EXPECT_NEAR(of_moon[1], -0.1244321506649895021e-3, 1e-8);
  EXPECT_NEAR(of_moon[3], -0.5219076942678119398e-3, 1e-8);
  EXPECT_NEAR(of_moon[5], -0.1716132214378462047e-3, 1e-8);

  const BodyPosition sun(PerturbingBody::sun, of_mjd(53411, 0.52501161), 86400, au_km, 0, 1);
  const auto of_sun = state_at(sun, 0);
  EXPECT_NEAR(of_sun[0], 0.7757238809297706813, 1e-12);
  EXPECT_NEAR(of_sun[2], -0.5598052241363340596, 1e-12);
  EXPECT_NEAR(of_sun[4], -0.2426998466481686993, 1e-12);
  EXPECT_NEAR(of_sun[1], 0.1091891824147313846e-1, 1e-9);
  EXPECT_NEAR(of_sun[3], 0.1247187268440845008e-1, 1e-9);
  EXPECT_NEAR(of_sun[5], 0.5407569418065039061e-2, 1e-9);
}

TEST(BodyPosition, AgreesWithErfaAlongTheSpan) {
  const Instant epoch{parse_epoch("2023-05-16T20:01:09.184").value()};
  const JulianDate date = julian_date(epoch.tt, TimeSystem::tt);
  const double unit_s = 806.810991, unit_km = 6378.1363;
  // Backwards as well.
  const double span = -30 * 86400 / unit_s;
  const BodyPosition sun(PerturbingBody::sun, epoch, unit_s, unit_km, 0, span);
  const BodyPosition moon(PerturbingBody::moon, epoch, unit_s, unit_km, 0, span);
  double of_sun = 0, of_moon = 0, rounding = 0;
  for (int i = 0; i <= 300; ++i) {
    const double t = span * i / 300;
    const double fraction = date.fraction + t * unit_s / 86400;
    double heliocentric[2][3], barycentric[2][3], lunar[2][3];
    eraEpv00(date.day, fraction, heliocentric, barycentric);
    eraMoon98(date.day, fraction, lunar);
    std::array<double, 3> a{}, b{};
    sun.expand(t, 0, a.data());
    moon.expand(t, 0, b.data());
    const auto relative = [&](const std::array<double, 3>& got, const double(&of)[3], double sign) {
      const double unit = sign * au_km / unit_km;
      return std::hypot(got[0] - unit * of[0], got[1] - unit * of[1], got[2] - unit * of[2]) /
             std::hypot(got[0], got[1], got[2]);
    };
    of_sun = std::max(of_sun, relative(a, heliocentric[0], -1));
    of_moon = std::max(of_moon, relative(b, lunar[0], 1));
    std::array<Extended, 3> exact{};
    moon.expand(Extended(t), 0, exact.data());
    for (std::size_t k = 0; k < 3; ++k) {
      rounding = std::max(rounding, std::abs(convert<double>(Extended(exact[k] - b[k]))) / 60);
    }
  }
  // ERFA's own values have a rounding error of 3e-13, from arguments of 1e5 degrees.
  EXPECT_LT(of_sun, 1e-12);
  EXPECT_LT(of_moon, 2e-12);
  EXPECT_LT(rounding, 1e-15);
}

TEST(BodyPosition, TaylorCoefficientsJoinSmoothly) {
  const Instant epoch{parse_epoch("2023-05-16T20:00:00").value()};
  const BodyPosition moon(PerturbingBody::moon, epoch, 3600, 1, 0, 100);
  // Nodes lie six hours apart.
  const Extended little("1e-18");
  std::array<Extended, 12> before{}, after{};
  moon.expand(Extended(18 - little), 3, before.data());
  moon.expand(Extended(18 + little), 3, after.data());
  for (std::size_t i = 0; i < 12; ++i) EXPECT_LT(abs(before[i] - after[i]), Extended(1e-12)) << i;
  std::array<double, 3 * 13> taylor{};
  std::array<double, 3> later{};
  moon.expand(19.0, 12, taylor.data());
  moon.expand(23.0, 0, later.data());
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    for (std::size_t k = 13; k-- > 0;) sum = sum * 4 + taylor[13 * c + k];
    EXPECT_NEAR(sum, later[c], 1e-9);
    EXPECT_EQ(taylor[13 * c + 8], 0);
  }
  EXPECT_THROW(moon.expand(150.0, 0, later.data()), Error);
}

}  // namespace
}  // namespace hamjet
