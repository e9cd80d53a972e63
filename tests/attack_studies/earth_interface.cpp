// The attack's Earth for Python, whose interface hands numbers over by their address.
#include <erfa.h>

#include <algorithm>

#include "earth_forces.hpp"

using attack::Axes;
using attack::Earth;
using attack::EarthSettings;
using attack::Matrix;

extern "C" {

/// `constants` are mu, radius, mu of Sun and Moon, seconds of TT after the midnight at the Julian
/// date `tt_day`, UT1 - TT, C_D A / m, and C_R A / m; of `rows` there are six numbers each, as in
/// OrientationRow. Of `pieces` of each of `profiles` there are nine, as in DensityPiece.
void* make_earth(int degree, const long double* C, const long double* S,
                 const long double* constants, const double* tt_day, int rows,
                 const long double* of_rows, int exponent, int profiles, int pieces,
                 const long double* of_pieces) {
  EarthSettings settings{};
  const int count = (degree + 1) * (degree + 2) / 2;
  settings.degree = degree;
  settings.C.assign(C, C + count);
  settings.S.assign(S, S + count);
  settings.mu = constants[0];
  settings.radius = constants[1];
  settings.mu_sun = constants[2];
  settings.mu_moon = constants[3];
  settings.tt_day = *tt_day;
  settings.tt_seconds = constants[4];
  settings.ut1_minus_tt_s = constants[5];
  for (int i = 0; i < rows; ++i, of_rows += 6) {
    settings.rows.push_back(
        {of_rows[0], of_rows[1], of_rows[2], of_rows[3], of_rows[4], of_rows[5]});
  }
  settings.air.drag_m2_kg = constants[6];
  settings.radiation_m2_kg = constants[7];
  settings.air.exponent = exponent;
  for (int p = 0; p < profiles; ++p) {
    auto& profile = settings.air.profiles.emplace_back(pieces);
    for (attack::DensityPiece& piece : profile) {
      piece.height_km = *of_pieces++;
      for (attack::Real& coefficient : piece.log_density) coefficient = *of_pieces++;
    }
  }
  return new Earth(settings);
}

void delete_earth(void* earth) { delete static_cast<Earth*>(earth); }

/// The matrix from GCRF at a time and its derivative, nine numbers each.
void axes_of_earth(void* earth, int axes, const long double* time, long double* out) {
  Earth& of = *static_cast<Earth*>(earth);
  const Matrix both[] = {of.axes(Axes(axes), *time),
                         Axes(axes) == Axes::itrf ? of.rate_of_itrf(*time) : Matrix{}};
  for (const Matrix& matrix : both) {
    for (const auto& row : matrix) out = std::copy(row.begin(), row.end(), out);
  }
}

/// TAI - UTC in seconds at a part of a day of UTC.
double tai_minus_utc(int year, int month, int day, const double* fraction) {
  double offset = 0;
  eraDat(year, month, day, *fraction, &offset);
  return offset;
}
}
