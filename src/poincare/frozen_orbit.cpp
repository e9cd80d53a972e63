#include "frozen_orbit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The pair of the orbit that J2 and J3 freeze to first order; see find_frozen_orbit.
template <class Real>
void take_first_order(const ZonalGravity& field, const Real& energy, SixNumbers<Real>& z) {
  using std::sqrt;
  const Real a = Real(field.mu) / (Real(-2) * energy);
  const Real L = sqrt(Real(Real(field.mu) * a));
  const Real cosine = z[momentum_place] / L;
  const Real sine = sqrt(std::max(Real(0), Real(Real(1) - cosine * cosine)));
  const Real J2 = field.J[2];
  const Real e =
      J2 == Real(0) ? Real(0) : Real(-Real(field.J[3]) / J2 * Real(field.radius) / a * sine / 2);
  // g = 90 degrees: (q, p) = sqrt(2 (L - G)) (-1, 0), and L - G = L e^2/2 to first order.
  z[q_place] = -e * sqrt(L);
  z[p_place] = Real(0);
}

}  // namespace

template <class Real>
FrozenOrbit<Real> find_frozen_orbit(const ZonalGravity& field, const SixNumbers<Real>& chief,
                                    bool from_circle, const GaussSettings& gauss) {
  using std::abs;
  using std::hypot;
  using std::sqrt;
  const FlowSection<Real> section(field, ChartName::nodal, chief);
  FrozenOrbit<Real> orbit;
  orbit.energy = section.energy();
  orbit.coordinates = section.chief();
  if (from_circle) take_first_order<Real>(field, orbit.energy, orbit.coordinates);
  const Real unit = sqrt(section.chief()[3]);  // the pair's unit: sqrt(L) times the eccentricity
  constexpr int most_iterations = 40;
  constexpr double longest_step = 0.05;  // in eccentricity
  Real least = std::numeric_limits<Real>::max();
  int worse = 0;
  SixNumbers<Real> z = orbit.coordinates;
  for (int i = 0; i < most_iterations; ++i) {
    const SixNumbers<Real> state = section.state(orbit.energy, z);
    const ReturnMap<Real> back = first_return<Real>(field, state, 1, gauss);
    const auto slope = [](const Series<Real>& series, NodalVariable variable) {
      return series[series.space().linear_index(variable)];
    };
    const NodalFlight<Real>& flight = back.flight;
    const std::array<Real, 4> d = {slope(flight.q, q_variable), slope(flight.q, p_variable),
                                   slope(flight.p, q_variable), slope(flight.p, p_variable)};
    const Real miss_q = flight.q[0] - z[q_place];
    const Real miss_p = flight.p[0] - z[p_place];
    // What is no number is no smallest residual.
    if (!(abs(miss_q) + abs(miss_p) < std::numeric_limits<Real>::max())) break;
    const Real residual = std::max(Real(abs(miss_q)), Real(abs(miss_p)));
    // The root is approached until rounding moves it to and fro.
    if (residual < least) {
      worse = 0;
      least = residual;
      orbit.state = state;
      orbit.coordinates = back.map.start->chief();
      orbit.period = flight.time[0];
      orbit.node = flight.node[0];
      orbit.derivative = d;
      orbit.residual = residual;
      orbit.iterations = i;
    } else if (++worse == 2 && least < Real(1e-9) * unit) {
      return orbit;
    }
    // (D - 1) step = -miss .
    const Real a = d[0] - Real(1), b = d[1], c = d[2], e = d[3] - Real(1);
    const Real determinant = a * e - b * c;
    Real step_q = (b * miss_p - e * miss_q) / determinant;
    Real step_p = (c * miss_q - a * miss_p) / determinant;
    const Real length = sqrt(Real(step_q * step_q + step_p * step_p));
    if (!(length < std::numeric_limits<Real>::max())) break;
    if (length > Real(longest_step) * unit) {
      step_q *= Real(longest_step) * unit / length;
      step_p *= Real(longest_step) * unit / length;
    }
    z[q_place] += step_q;
    z[p_place] += step_p;
    if (length <= Real(4) * std::numeric_limits<Real>::epsilon() * unit) return orbit;
  }
  if (least < Real(1e-9) * unit) return orbit;
  throw Error(ErrorKind::numerical,
              fmt::format("frozen orbit: Newton's method finds none of this energy and angular "
                          "momentum about the axis; nearest, the pair of the pericentre moved by "
                          "{:.2g} a revolution",
                          static_cast<double>(least)));
}

template FrozenOrbit<InstantiatedReal> find_frozen_orbit(const ZonalGravity&,
                                                         const SixNumbers<InstantiatedReal>&, bool,
                                                         const GaussSettings&);

}  // namespace hamjet
