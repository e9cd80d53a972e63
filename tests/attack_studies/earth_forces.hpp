// The Earth of the attack: its harmonics, how it lies, the Sun and the Moon, in the long double of
// the machine. Nothing of hamjet is included; ERFA gives what functions of the date alone are.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace attack {

using Real = long double;
using Vector = std::array<Real, 3>;
using Matrix = std::array<Vector, 3>;

/// The coefficients of ln rho, kg/m^3, in kilometres above a height; below the first height the
/// line through it goes on.
struct DensityPiece {
  Real height_km;
  std::array<Real, 8> log_density;
};

/// Air that turns with the Earth, of one profile or of two: the least density and that of a bulge
/// which follows the Sun.
struct Air {
  std::vector<std::vector<DensityPiece>> profiles;
  Real drag_m2_kg;  ///< C_D A / m times the factor of all densities
  int exponent;     ///< the exponent of the bulge's cosine
};

/// Drag is -rate |v - wind| (v - wind) per unit of mass.
struct Drag {
  Real rate = 0;
  Vector wind{};
};

class Light;
struct LightPiece;

enum class Axes { itrf, eme2000, mod, tod };

/// A row of finals2000A, with angles in radians.
struct OrientationRow {
  Real time_s;  ///< when its day of UTC begins, after the epoch
  Real ut1_minus_tt_s;
  Real pole_x, pole_y, offset_x, offset_y;
};

struct EarthSettings {
  int degree;
  std::vector<Real> C, S;  ///< normalised fully, those of degree n and order m at n (n + 1)/2 + m
  Real mu, radius, mu_sun, mu_moon;  ///< metres and seconds
  double tt_day;                     ///< Julian date of the midnight before the epoch, in TT
  Real tt_seconds;                   ///< of the epoch after it
  Real ut1_minus_tt_s;               ///< at all times, without rows
  std::vector<OrientationRow> rows;
  Air air;               ///< without profiles there is none
  Real radiation_m2_kg;  ///< C_R A / m
};

class Earth {
 public:
  explicit Earth(EarthSettings settings);

  /// The acceleration at a place along GCRF, at a time in seconds after the epoch.
  Vector acceleration(const Vector& x, Real time);
  bool has_air() const { return !settings_.air.profiles.empty(); }
  Drag drag(const Vector& x, Real time);
  /// The Sun from the centre, along GCRF.
  Vector sun(Real time);
  Real radius() const { return settings_.radius; }
  /// The light along a chief, which a flight asks for; without one it shines at all times.
  Light* light() const { return light_.get(); }
  const std::shared_ptr<Light>& shared_light() const { return light_; }
  void set_light(std::shared_ptr<Light> light) { light_ = std::move(light); }
  /// What is seen of the Sun in the step that follows; null: all of it.
  void light_by(const LightPiece* piece) { piece_ = piece; }
  /// The matrix from GCRF.
  Matrix axes(Axes axes, Real time);
  /// d/dt of that to ITRF, per second.
  Matrix rate_of_itrf(Real time);

 private:
  /// Celestial pole X and Y, the locators s and s', Sun and Moon.
  static constexpr int components = 10;
  static constexpr int nodes = 15;
  using Values = std::array<Real, components>;
  /// Coefficients of Chebyshev's polynomials on a day about a whole number of days after the epoch:
  /// a rate at the epoch has no seam of two pieces, which ERFA's own rounding parts.
  using Day = std::array<Values, nodes>;

  void sample(Real time, double* values) const;
  const Day& day(long number);
  const Values& slow(Real time);
  OrientationRow orientation(Real time);
  Matrix itrf(Real time);
  Vector harmonics(const Vector& x) const;

  EarthSettings settings_;
  std::shared_ptr<Light> light_;
  const LightPiece* piece_ = nullptr;
  std::vector<Real> of_diagonal_, first_factor_, second_factor_, of_slope_;
  std::map<long, Day> days_;
  std::map<std::ptrdiff_t, std::vector<std::array<Real, 8>>> between_rows_;
  Real slow_time_ = 0, itrf_time_ = 0;
  bool has_slow_ = false, has_itrf_ = false;
  Values slow_{};
  Matrix itrf_{};
};

}  // namespace attack
