#include "hamjet/astronomy/earth_rotation.hpp"

#include <erfa.h>
#include <erfam.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <vector>

#include "astronomy/earth_days.hpp"
#include "hamjet/error.hpp"

// The matrix from GCRF to ITRF along time. Expected values: the test cases that come with SOFA, the
// worked example of its cookbook ("SOFA Tools for Earth Attitude", section 5.5), and ERFA's
// routines at the same moment, with the Earth rotation angle in extended precision; ERFA's own has
// a rounding error of 5e-14 in our time.

namespace hamjet {
namespace {

using std::chrono::sys_days;
using std::chrono::year;

template <class Real>
std::vector<Real> expanded(const TimeFunction& function, const Real& t, int degree) {
  std::vector<Real> out(function.components() * static_cast<std::size_t>(degree + 1));
  function.expand(t, degree, out.data());
  return out;
}

double largest_difference(const std::vector<double>& one, const double (&other)[3][3]) {
  double largest = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    largest = std::max(largest, std::abs(one[i] - other[i / 3][i % 3]));
  }
  return largest;
}

TEST(EarthRotation, TestCaseOfSofa) {
  // iauC2t06a of MJD 53736.0 in TT and in UT1. At that time TAI - UTC was 33 s.
  const auto table = table_of_days(sys_days(year(2005) / 12 / 27), 12, [](int i) {
    EarthOrientationDay day;
    day.ut1_minus_utc_s = (i < 5 ? 32 : 33) + 32.184;
    day.pole_x_arcsec = 2.55060238e-7 / ERFA_DAS2R;
    day.pole_y_arcsec = 1.860359247e-6 / ERFA_DAS2R;
    return day;
  });
  const Instant start{{sys_days(year(2006) / 1 / 1), 0}};
  const EarthRotation rotation(start, 1, 0, 1, table);
  const double expected[3][3] = {
      {-0.1810332128305897282, 0.9834769806938592296, 0.6555550962998436505e-4},
      {-0.9834768134136214897, -0.1810332203649130832, 0.5749800844905594110e-3},
      {0.5773474024748545878e-3, 0.3961816829632690581e-4, 0.9999998325501747785}};
  EXPECT_LT(largest_difference(expanded(rotation, 0.0, 0), expected), 1e-14);
}

TEST(EarthRotation, ExampleOfTheCookbook) {
  const auto table = table_of_days(sys_days(year(2007) / 4 / 1), 10, [](int) {
    return EarthOrientationDay{{},        -0.072073685, 0.0349282, 0.4833163,
                               0.1750e-3, -0.2259e-3,   false};
  });
  const EarthRotation rotation(instant("2007-04-05T12:00:00"), 1, 0, 1, table);
  const double expected[3][3] = {{0.973104317697536, 0.230363826239128, -0.000703163482198},
                                 {-0.230363800456037, 0.973104570632801, 0.000118545366625},
                                 {0.000711560162668, 0.000046626403995, 0.999999745754024}};
  EXPECT_LT(largest_difference(expanded(rotation, 0.0, 0), expected), 2e-15);
}

/// The matrix as ERFA makes it, for UT1 - TT, in radians of the poles' coordinates.
void matrix_of_erfa(const Instant& epoch, const Extended& seconds, double ut1_minus_tt,
                    double pole_x, double pole_y, double (&matrix)[3][3]) {
  const JulianDate date = julian_date(epoch.tt, TimeSystem::tt);
  const Extended since_midnight = seconds + Extended(epoch.tt.picoseconds) / 1e12;
  const Extended day_count = since_midnight / 86400;
  const Extended ut1 = (Extended(date.day) - 2451545) + day_count + Extended(ut1_minus_tt) / 86400;
  Extended angle = Extended("0.7790572732640") + Extended("1.00273781191135448") * ut1;
  angle = (angle - floor(angle)) * boost::math::constants::two_pi<Extended>();
  double intermediate[3][3], pole[3][3];
  eraC2i06a(date.day, convert<double>(day_count), intermediate);
  eraPom00(pole_x, pole_y, eraSp00(date.day, convert<double>(day_count)), pole);
  eraC2tcio(intermediate, convert<double>(angle), pole, matrix);
}

TEST(EarthRotation, AgreesWithErfaAlongTheSpan) {
  // UT1 and the pole are linear in time, which the interpolation of the table meets to rounding.
  const Instant epoch = instant("2023-05-16T20:00:00");
  const auto table = table_of_days(sys_days(year(2023) / 5 / 10), 40, [](int i) {
    return EarthOrientationDay{{}, -0.03 - 1e-3 * i, 0.1 + 2e-3 * i, 0.4 - 1e-3 * i, 0, 0, false};
  });
  const double unit_s = 806.810991;
  const double span = 30 * 86400 / unit_s;
  for (const bool has_table : {false, true}) {
    const EarthRotation rotation(epoch, unit_s, 0, span, has_table ? table : nullptr);
    double largest = 0, rounding = 0, largest_product = 0;
    for (int i = 0; i <= 500; ++i) {
      const double t = span * i / 500;
      const Extended seconds = Extended(t) * unit_s;
      const double day_count = convert<double>(seconds) / 86400 + 6 + 20.0 / 24;
      const double ut1_minus_utc = has_table ? -0.03 - 1e-3 * day_count : 0;
      double expected[3][3];
      matrix_of_erfa(epoch, seconds, ut1_minus_utc - 37 - 32.184,
                     has_table ? (0.1 + 2e-3 * day_count) * ERFA_DAS2R : 0,
                     has_table ? (0.4 - 1e-3 * day_count) * ERFA_DAS2R : 0, expected);
      const std::vector<double> matrix = expanded(rotation, t, 0);
      largest = std::max(largest, largest_difference(matrix, expected));
      if (i % 50 != 0) continue;
      const std::vector<Extended> exact = expanded(rotation, Extended(t), 0);
      for (std::size_t k = 0; k < 9; ++k) {
        rounding = std::max(rounding, std::abs(convert<double>(Extended(exact[k] - matrix[k]))));
      }
      for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t other = 0; other < 3; ++other) {
          Extended product = row == other ? -1 : 0;
          for (std::size_t k = 0; k < 3; ++k) product += exact[3 * row + k] * exact[3 * other + k];
          largest_product = std::max(largest_product, std::abs(convert<double>(product)));
        }
      }
    }
    EXPECT_LT(largest, 1e-14);
    EXPECT_LT(rounding, 1e-14);
    EXPECT_LT(largest_product, 1e-30) << "the matrix is not orthogonal";
  }
}

TEST(EarthRotation, TaylorCoefficientsAreThoseOfTheFunction) {
  const Instant epoch = instant("2010-07-27T00:00:00");
  const auto table = table_of_days(sys_days(year(2010) / 7 / 20), 14, [](int i) {
    return EarthOrientationDay{
        {}, -0.05 + 1e-4 * i * i, 0.1 + 2e-3 * i, 0.48 - 1e-3 * i * (i % 2), 1e-4, 2e-4, false};
  });
  const double unit_s = 5000;
  const EarthRotation rotation(epoch, unit_s, 0, 30, table);
  const int degree = 24;
  // Within a quarter of a day, 4.32 units, the function is one of analytic pieces.
  const Extended t = 9.5, step = Extended(1) / 4;
  const std::vector<Extended> taylor = expanded(rotation, t, degree);
  const std::vector<Extended> after = expanded(rotation, Extended(t + step), 0);
  const std::vector<double> in_double = expanded(rotation, 9.5, degree);
  for (std::size_t c = 0; c < 9; ++c) {
    Extended sum = 0;
    for (std::size_t k = degree + 1; k-- > 0;) sum = sum * step + taylor[c * (degree + 1) + k];
    EXPECT_LT(abs(sum - after[c]), Extended(1e-26)) << c;
    for (std::size_t k = 0; k <= degree; ++k) {
      const std::size_t place = c * (degree + 1) + k;
      EXPECT_LT(std::abs(convert<double>(Extended(taylor[place] - in_double[place]))), 1e-14) << k;
    }
  }
  // The rate of the rotation is that of the IERS Conventions, 7.292115146706979e-5 rad/s of UT1.
  const std::vector<double> once = expanded(rotation, 9.5, 1);
  double rate = 0;
  for (std::size_t k = 0; k < 3; ++k) rate += once[2 * k + 1] * once[2 * (3 + k)];
  EXPECT_NEAR(rate / unit_s / 7.292115146706979e-5, 1, 1e-7);
}

TEST(EarthRotation, PiecesJoinSmoothly) {
  // Nodes lie a quarter of a day apart from the epoch, and at midnights of UTC.
  const Instant epoch = instant("2016-12-31T06:00:00");
  const auto table = table_of_days(sys_days(year(2016) / 12 / 26), 12, [](int i) {
    return EarthOrientationDay{
        {}, (i < 6 ? -0.4 : 0.6) - 1.1e-3 * i, 0.08 + 1e-3 * (i % 3), 0.27, 0, 0, false};
  });
  const EarthRotation rotation(epoch, 1, 0, 4 * 86400, table);
  const Extended little("1e-20");
  // The second of these is the midnight behind the leap second.
  for (const double t : {21600.0, 64801.0, 86400.0, 151201.0}) {
    const auto before = expanded(rotation, Extended(t - little), 3);
    const auto after = expanded(rotation, Extended(t + little), 3);
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_LT(abs(before[i] - after[i]), Extended(1e-22)) << t << " " << i;
    }
    const auto in_double = expanded(rotation, std::nextafter(t, 0.0), 0);
    const auto at_node = expanded(rotation, t, 0);
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(in_double[i], at_node[i], 5e-15);
  }
}

TEST(EarthRotation, LeapSecondsDoNotTurnTheEarth) {
  // UT1 - TAI is linear; UT1 - UTC jumps by one second at the end of 2016.
  const auto table = table_of_days(sys_days(year(2016) / 12 / 26), 12, [](int i) {
    return EarthOrientationDay{{}, (i < 6 ? -0.4 : 0.6) - 1.1e-3 * i, 0, 0, 0, 0, false};
  });
  const Instant epoch = instant("2016-12-31T12:00:00");
  const EarthRotation rotation(epoch, 1, 0, 86400, table);
  for (const double t : {0.0, 43199.5, 43200.5, 43201.5, 80000.0}) {
    const double day_count = 5.5 + (t < 43200 ? t / 86400 : (t - 1) / 86400);
    double expected[3][3];
    matrix_of_erfa(epoch, t, -36.4 - 1.1e-3 * day_count - 32.184, 0, 0, expected);
    // The interpolation is linear in TT, not in UTC: 1e-5 of a day differs by 13 ns of UT1.
    EXPECT_LT(largest_difference(expanded(rotation, t, 0), expected), 2e-12) << t;
  }
}

TEST(EarthRotation, OutsideItsSpanItIsRefused) {
  const Instant epoch = instant("2023-05-16T20:00:00");
  const EarthRotation rotation(epoch, 10, -100, 100);
  std::array<double, 9> out{};
  EXPECT_NO_THROW(rotation.expand(-2200.0, 0, out.data()));
  try {
    rotation.expand(2300.0, 0, out.data());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    EXPECT_EQ(std::string(error.what()),
              "axes and bodies of the Earth are known from -1000 s to 1000 s after the epoch, got "
              "23000 s");
  }
  EXPECT_THROW(rotation.expand(std::nan(""), 0, out.data()), Error);
  EXPECT_THROW(EarthRotation({parse_epoch("1950-01-01T00:00:00").value()}, 1, 0, 1), Error);
}

}  // namespace
}  // namespace hamjet
