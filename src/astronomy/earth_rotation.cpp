#include "hamjet/astronomy/earth_rotation.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <type_traits>
#include <vector>

#include "earth_attitude.hpp"
#include "univariate_series.hpp"

namespace hamjet {
namespace {

/// How many coefficients of slow series are kept in their products.
template <class Real>
constexpr std::size_t most_slow =
    std::is_same_v<Real, double> ? PiecewiseHermite::degree + 1 : 2 * PiecewiseHermite::degree + 1;

/// With Q(X, Y) that takes GCRF to the intermediate pole, of rows (1 - a X^2, -a X Y, -X),
/// (-a X Y, 1 - a Y^2, -Y), (X, Y, Z), a = 1/(1 + Z), the matrix is R1(-yp) R2(-xp) R3(ERA - s +
/// s') Q.
template <class Real>
void expand_rotation(const EarthAttitude& attitude, const Real& t, int degree, Real* out) {
  using namespace univariate;
  EarthAttitude::Series<Real> slow;
  attitude.expand(t, degree, slow);
  const Real two_pi = boost::math::constants::two_pi<Real>();
  slow.longitude[0] += two_pi * attitude.turns(t);
  slow.longitude[1] += two_pi * convert<Real>(attitude.turns_per_time());

  const std::size_t n = static_cast<std::size_t>(degree) + 1;
  // In products of slow series the coefficients beyond are below 1e-20 in the longest units of
  // time.
  const std::size_t m = std::min(n, most_slow<Real>);
  // Small degrees need no memory of their own.
  constexpr std::size_t rows = 17;
  constexpr std::size_t most_on_stack = 4;
  std::array<Real, rows * most_on_stack> on_stack;
  std::vector<Real> on_heap(n <= most_on_stack ? 0 : rows * n);
  Real* const memory = n <= most_on_stack ? on_stack.data() : on_heap.data();
  const auto row = [&](std::size_t i) { return memory + i * n; };
  const auto padded = [&](const PiecewiseHermite::Coefficients<Real>& series, Real* to) {
    const std::size_t known = std::min(n, series.size());
    std::copy(series.begin(), series.begin() + static_cast<std::ptrdiff_t>(known), to);
    std::fill(to + known, to + n, Real(0));
    return to;
  };
  Real *const work = row(0), *const Z = row(1), *const a = row(2);
  Real* const X = padded(slow.X, row(3));
  Real* const Y = padded(slow.Y, row(4));
  combine(m, m, X, X, 1, Y, Y, work);
  for (std::size_t k = 0; k < m; ++k) work[k] = -work[k];
  work[0] += 1;
  square_root(m, work, Z);
  std::fill(Z + m, Z + n, Real(0));
  std::copy(Z, Z + m, work);
  work[0] += 1;
  reciprocal(m, work, a);

  Real *const XX = row(5), *const XY = row(6), *const YY = row(7);
  multiply(m, a, X, work);
  multiply(m, work, X, XX);
  multiply(m, work, Y, XY);
  multiply(m, a, Y, work);
  multiply(m, work, Y, YY);
  for (std::size_t k = 0; k < m; ++k) {
    XX[k] = -XX[k];
    YY[k] = -YY[k];
    XY[k] = -XY[k];
  }
  XX[0] += 1;
  YY[0] += 1;

  Real *const s = row(8), *const c = row(9);
  sine_and_cosine(n, padded(slow.longitude, work), PiecewiseHermite::degree, s, c);
  const auto at = [&](std::size_t i) { return out + i * n; };
  combine(n, m, XX, c, 1, XY, s, at(0));
  combine(n, m, XY, c, 1, YY, s, at(1));
  combine(n, m, X, c, 1, Y, s, at(2));
  combine(n, m, XY, c, -1, XX, s, at(3));
  combine(n, m, YY, c, -1, XY, s, at(4));
  combine(n, m, Y, c, -1, X, s, at(5));
  for (std::size_t k = 0; k < n; ++k) {
    at(2)[k] = -at(2)[k];
    at(5)[k] = -at(5)[k];
  }
  std::copy(X, X + n, at(6));
  std::copy(Y, Y + n, at(7));
  std::copy(Z, Z + n, at(8));
  if (!attitude.has_table()) return;

  Real *const sx = row(10), *const cx = row(11), *const sy = row(12), *const cy = row(13);
  sine_and_cosine(m, padded(slow.pole_x, work), PiecewiseHermite::degree, sx, cx);
  sine_and_cosine(m, padded(slow.pole_y, work), PiecewiseHermite::degree, sy, cy);
  Real *const first = row(14), *const second = row(15), *const third = row(16);
  for (std::size_t j = 0; j < 3; ++j) {
    combine(n, m, cx, at(j), 1, sx, at(6 + j), first);
    combine(n, m, cx, at(6 + j), -1, sx, at(j), third);
    combine(n, m, cy, at(3 + j), -1, sy, third, second);
    combine(n, m, sy, at(3 + j), 1, cy, third, at(6 + j));
    std::copy(first, first + n, at(j));
    std::copy(second, second + n, at(3 + j));
  }
}

}  // namespace

EarthRotation::EarthRotation(const Instant& epoch, const Extended& unit_s, double first,
                             double last, std::shared_ptr<const EarthOrientation> orientation)
    : attitude_(
          std::make_unique<EarthAttitude>(epoch, unit_s, first, last, std::move(orientation))) {}

EarthRotation::~EarthRotation() = default;

void EarthRotation::expand(double t, int degree, double* out) const {
  expand_rotation(*attitude_, t, degree, out);
}
void EarthRotation::expand(const Extended& t, int degree, Extended* out) const {
  expand_rotation(*attitude_, t, degree, out);
}

}  // namespace hamjet
