#include "hamjet/astronomy/earth_axes.hpp"

#include <erfa.h>
#include <gtest/gtest.h>

#include "astronomy/earth_days.hpp"
#include "hamjet/error.hpp"

// Changes of axes. Expected values: the worked example of D. A. Vallado, Fundamentals of
// Astrodynamics and Applications, 4th edition (2013), section 3.7, and D. A. Vallado et al., AIAA
// 2006-6753; the frame bias of the IERS Conventions (2010), section 5.4.4; ERFA at the same moment.

namespace hamjet {
namespace {

using enum EarthAxes;
using std::chrono::sys_days;
using std::chrono::year;
using State = Eigen::Matrix<double, 6, 1>;

/// UT1 - UTC = -0.4399619 s at the example's moment, and 1.5563 ms a day.
std::shared_ptr<const EarthOrientation> table_of_example() {
  const double at = (7 * 3600 + 51 * 60 + 28.386009) / 86400;
  return table_of_days(sys_days(year(2004) / 4 / 1), 10, [at](int i) {
    return EarthOrientationDay{
        {}, -0.4399619 - 0.0015563 * (i - 5 - at), -0.140682, 0.333309, 0, 0, false};
  });
}

TEST(EarthAxes, ExampleOfVallado) {
  const Instant moment = instant("2004-04-06T07:51:28.386009");
  State terrestrial;
  terrestrial << -1033.4793830, 7901.2952754, 6380.3565958, -3.225636520, -2.872451450, 5.531924446;
  const auto in = [&](EarthAxes axes) -> State {
    return axes_change(itrf, axes, moment, table_of_example()).of_state() * terrestrial;
  };
  const auto expect_near = [&](EarthAxes axes, const State& expected) {
    const State got = in(axes);
    // The book's Julian date of UT1 stands in one double, 40 microseconds: 2.9e-9 rad, 2 cm.
    EXPECT_LT((got - expected).head<3>().norm(), 1.2e-5) << got.transpose();
    // Its velocities leave out the rates of precession and nutation.
    EXPECT_LT((got - expected).tail<3>().norm(), 4e-8) << got.transpose();
  };
  expect_near(gcrf, (State() << 5102.5089578, 6123.0114038, 6378.1369253, -4.743220156, 0.790536497,
                     5.533755728)
                        .finished());
  expect_near(mod, (State() << 5094.0289611, 6127.8711350, 6380.2477420, -4.746262480, 0.786014193,
                    5.531791032)
                       .finished());
  expect_near(teme, (State() << 5094.1801621, 6127.6446595, 6380.3445327, -4.746131487, 0.785818041,
                     5.531931288)
                        .finished());
}

TEST(EarthAxes, FrameBias) {
  // The bias moves the pole by (-16.617, -6.819) and the equinox by -14.6 milliarcseconds.
  const Eigen::Matrix3d bias = axes_change(gcrf, eme2000, instant("2023-05-16T20:00:00")).rotation;
  constexpr double mas = 4.84813681109536e-9;
  EXPECT_NEAR(bias(2, 0), -16.617 * mas, 3e-12);
  EXPECT_NEAR(bias(2, 1), -6.819 * mas, 3e-12);
  EXPECT_NEAR(bias(0, 1), -14.6 * mas, 2.5e-10);
}

TEST(EarthAxes, AxesOfTheTrueEquator) {
  const Instant first = instant("1972-03-01T00:00:00"), last = later(first, 20 * 86400);
  const EarthAxesConversion to_tod(gcrf, tod, first, last), to_cirf(gcrf, cirf, first, last);
  for (int i = 0; i <= 20; ++i) {
    const Instant moment = later(first, 86400 * i + 1234.5);
    if (last < moment) break;
    const JulianDate date = julian_date(moment.tt, TimeSystem::tt);
    double of_date[3][3], intermediate[3][3];
    eraPnm06a(date.day, date.fraction, of_date);
    eraC2i06a(date.day, date.fraction, intermediate);
    const AxesChange a = to_tod.at(moment), b = to_cirf.at(moment);
    for (int j = 0; j < 9; ++j) {
      EXPECT_NEAR(a.rotation(j / 3, j % 3), of_date[j / 3][j % 3], 1e-14);
      EXPECT_NEAR(b.rotation(j / 3, j % 3), intermediate[j / 3][j % 3], 1e-15);
    }
    EXPECT_EQ(a.rate.norm(), 0);
  }
  EXPECT_THROW(to_tod.at(later(last, 86400)), Error);
  // All three have the same pole.
  const Instant moment = instant("2023-05-16T20:00:00");
  for (const EarthAxes other : {tod, cirf}) {
    const Eigen::Matrix3d turn = axes_change(teme, other, moment).rotation;
    EXPECT_NEAR(turn(2, 2), 1, 1e-15);
    EXPECT_NEAR(turn(0, 2), 0, 1e-15);
  }
  // GMST differs from GAST by the equation of the equinoxes, below 1.2 s of time.
  EXPECT_LT(std::abs(axes_change(teme, tod, moment).rotation(0, 1)), 1.2 * 7.3e-5);
}

TEST(EarthAxes, StatesGoThereAndBack) {
  const Instant moment = instant("2010-07-27T01:23:45");
  const State state =
      (State() << 5102.5, 6123.0, 6378.1, -4.743220156, 0.790536497, 5.533755728).finished();
  for (const EarthAxes from : {gcrf, eme2000, mod, tod, teme, cirf, itrf}) {
    for (const EarthAxes to : {gcrf, eme2000, mod, tod, teme, cirf, itrf}) {
      const AxesChange change = axes_change(from, to, moment);
      EXPECT_LT(
          (change.rotation * change.rotation.transpose() - Eigen::Matrix3d::Identity()).norm(),
          3e-15);
      const State back = axes_change(to, from, moment).of_state() * (change.of_state() * state);
      EXPECT_LT((back - state).norm(), 1e-11);
      EXPECT_LT((change.inverse().of_state() * change.of_state() * state - state).norm(), 1e-11);
    }
  }
}

TEST(EarthAxes, VelocitiesAreDerivativesOfCoordinates) {
  // A straight line in GCRF.
  const Instant moment = instant("2010-07-27T01:23:45");
  const Eigen::Vector3d r(5102.5, 6123.0, 6378.1), v(-4.7, 0.79, 5.5);
  const EarthAxesConversion conversion(gcrf, itrf, later(moment, -10), later(moment, 10));
  const auto at = [&](double t) -> Eigen::Vector3d {
    return conversion.at(later(moment, t)).rotation * (r + t * v);
  };
  const AxesChange change = conversion.at(moment);
  const Eigen::Vector3d expected = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / 12;
  EXPECT_LT((change.rotation * v + change.rate * r - expected).norm(), 1e-11);
}

TEST(EarthAxes, Names) {
  EXPECT_EQ(axes_named("ICRF"), gcrf);
  EXPECT_EQ(axes_named("J2000"), eme2000);
  EXPECT_EQ(axes_named("TEMEOFDATE"), teme);
  for (const char* name :
       {"ITRF", "ITRF2000", "ITRF-97", "ITRF1997", "ITRF2020", "IGS14", "WGS84"}) {
    EXPECT_EQ(axes_named(name), itrf) << name;
  }
  for (const char* name : {"", "itrf", "ITRFX", "ITRF2000X", "RTN", "B1950", "GRC"}) {
    EXPECT_FALSE(axes_named(name)) << name;
  }
}

}  // namespace
}  // namespace hamjet
