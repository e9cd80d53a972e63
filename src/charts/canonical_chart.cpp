#include "hamjet/charts/canonical_chart.hpp"

#include <fmt/format.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/error.hpp"
#include "plane_elements.hpp"

namespace hamjet {
namespace {

/// A chart does not exist where a certain angle or ratio vanishes. Below this fraction of its full
/// range the chart is too near to such a place for its series to be of use.
constexpr double least_part = 0.01;
/// This limit as an angle in degrees.
constexpr double least_angle_deg = least_part * 180 / boost::math::constants::pi<double>();

template <class Real>
Real abs_of(const Real& x) {
  return x < 0 ? Real(-x) : x;
}

template <class T>
using Vector = std::array<T, 3>;

template <class T, class U>
auto dot(const Vector<T>& a, const Vector<U>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T>
Vector<T> position_of(const SixNumbers<T>& z) {
  return {z[0], z[1], z[2]};
}
template <class T>
Vector<T> momentum_of(const SixNumbers<T>& z) {
  return {z[3], z[4], z[5]};
}

template <class T>
SixNumbers<T> spherical_of(const Vector<T>& x, const Vector<T>& v) {
  using std::atan2;
  using std::sqrt;
  const T rho_squared = x[0] * x[0] + x[1] * x[1];
  const T rho = sqrt(rho_squared);
  const T r = sqrt(T(rho_squared + x[2] * x[2]));
  const T radial = x[0] * v[0] + x[1] * v[1];
  return {atan2(x[1], x[0]),          r,
          atan2(x[2], rho),           x[0] * v[1] - x[1] * v[0],
          (radial + x[2] * v[2]) / r, (rho_squared * v[2] - radial * x[2]) / rho};
}

template <class T>
std::pair<Vector<T>, Vector<T>> state_of_spherical(const SixNumbers<T>& z) {
  const auto& [alpha, r, beta, p_alpha, p_r, p_beta] = z;
  const auto [sa, ca] = sine_and_cosine(alpha);
  const auto [sb, cb] = sine_and_cosine(beta);
  const T along = p_alpha / (r * cb);
  const T up = p_beta / r;
  const T out = p_r * cb - up * sb;
  return {{r * cb * ca, r * cb * sa, r * sb},
          {out * ca - along * sa, out * sa + along * ca, p_r * sb + up * cb}};
}

template <class T>
SixNumbers<T> cylindrical_of(const Vector<T>& x, const Vector<T>& v) {
  using std::atan2;
  using std::sqrt;
  const T rho = sqrt(T(x[0] * x[0] + x[1] * x[1]));
  return {atan2(x[1], x[0]),
          rho,
          x[2],
          x[0] * v[1] - x[1] * v[0],
          (x[0] * v[0] + x[1] * v[1]) / rho,
          v[2]};
}

template <class T>
std::pair<Vector<T>, Vector<T>> state_of_cylindrical(const SixNumbers<T>& z) {
  const auto& [phi, rho, height, momentum, p_rho, p_z] = z;
  const auto [s, c] = sine_and_cosine(phi);
  const T along = momentum / rho;
  return {{rho * c, rho * s, height}, {p_rho * c - along * s, p_rho * s + along * c, p_z}};
}

/// The state in the plane spanned by the unit vectors f and g.
template <class T>
std::pair<Vector<T>, Vector<T>> in_space(const PlaneState<T>& plane, const Vector<T>& f,
                                         const Vector<T>& g) {
  const auto combined = [&](const T& a, const T& b) {
    return Vector<T>{a * f[0] + b * g[0], a * f[1] + b * g[1], a * f[2] + b * g[2]};
  };
  return {combined(plane.x, plane.y), combined(plane.x_velocity, plane.y_velocity)};
}

template <class T>
PlaneState<T> in_plane(const Vector<T>& x, const Vector<T>& v, const Vector<T>& f,
                       const Vector<T>& g) {
  return {dot(x, f), dot(x, g), dot(v, f), dot(v, g)};
}

/// Axes f and g in the plane whose normal is the angular momentum; the x axis of the reference
/// plane is carried to f by the shortest turn. With P = tan(i/2) sin h and Q = tan(i/2) cos h,
///
///   f = (1 - P^2 + Q^2, 2 P Q, -2 P) / (1 + P^2 + Q^2) ,
///   g = (2 P Q, 1 + P^2 - Q^2, 2 Q) / (1 + P^2 + Q^2) .
template <class Real, class T>
std::pair<Vector<T>, Vector<T>> equinoctial_axes(const T& P, const T& Q, const Real& one) {
  const T unit = one / (one + P * P + Q * Q);
  const T twice = Real(2) * unit;
  const T mixed = twice * P * Q;
  const T difference = Q * Q - P * P;
  return {{unit * (one + difference), mixed, -(twice * P)},
          {mixed, unit * (one - difference), twice * Q}};
}

template <class Real, class T>
SixNumbers<T> poincare_of(const Vector<T>& x, const Vector<T>& v, const Real& mu) {
  using std::sqrt;
  const Vector<T> momentum = cross(x, v);
  const T G = sqrt(T(dot(momentum, momentum)));
  const T unit = Real(1) / (G + momentum[2]);
  const auto [f, g] = equinoctial_axes<Real, T>(momentum[0] * unit, -(momentum[1] * unit), Real(1));
  const auto [lambda, L, k, h] = plane_elements(in_plane(x, v, f, g), mu);
  const T eccentric = L * sqrt(T(Real(2) / (L + G)));  // sqrt(2 (L - G)) / e
  const T tilted = sqrt(T(Real(2) * unit));            // sqrt(2 (G - H)) / (G sin i)
  return {lambda, -(h * eccentric), -(momentum[0] * tilted),
          L,      k * eccentric,    -(momentum[1] * tilted)};
}

template <class Real, class T>
std::pair<Vector<T>, Vector<T>> state_of_poincare(const SixNumbers<T>& z, const Real& mu) {
  using std::sqrt;
  const auto& [lambda, q_2, q_3, L, p_2, p_3] = z;
  const T G = L - (q_2 * q_2 + p_2 * p_2) / Real(2);
  const T sum = G + G - (q_3 * q_3 + p_3 * p_3) / Real(2);  // G + H
  const T eccentric = sqrt(T((L + G) / Real(2))) / L;
  const T tilted = Real(1) / sqrt(T(Real(2) * sum));
  const auto [f, g] = equinoctial_axes<Real, T>(-(q_3 * tilted), p_3 * tilted, Real(1));
  return in_space(plane_state(PlaneElements<T>{lambda, L, p_2 * eccentric, -(q_2 * eccentric)}, mu),
                  f, g);
}

template <class Real, class T>
SixNumbers<T> nodal_of(const Vector<T>& x, const Vector<T>& v, const Real& mu) {
  using std::atan2;
  using std::sqrt;
  const Vector<T> momentum = cross(x, v);
  const T flat_squared = momentum[0] * momentum[0] + momentum[1] * momentum[1];
  const T flat = sqrt(flat_squared);  // G sin i
  const T G = sqrt(T(flat_squared + momentum[2] * momentum[2]));
  const Vector<T> f = {-(momentum[1] / flat), momentum[0] / flat, momentum[2] * Real(0)};
  const T cosine = momentum[2] / G;
  const Vector<T> g = {-(f[1] * cosine), f[0] * cosine, flat / G};
  const auto [lambda, L, k, h] = plane_elements(in_plane(x, v, f, g), mu);
  const T eccentric = L * sqrt(T(Real(2) / (L + G)));
  return {lambda,       atan2(momentum[0], T(-momentum[1])), -(h * eccentric), L, momentum[2],
          k * eccentric};
}

template <class Real, class T>
std::pair<Vector<T>, Vector<T>> state_of_nodal(const SixNumbers<T>& z, const Real& mu) {
  using std::sqrt;
  const auto& [lambda, node, q_3, L, H, p_3] = z;
  const T G = L - (q_3 * q_3 + p_3 * p_3) / Real(2);
  const T eccentric = sqrt(T((L + G) / Real(2))) / L;
  const auto [s, c] = sine_and_cosine(node);
  const T cosine = H / G;
  const T sine = sqrt(T((G - H) * (G + H))) / G;
  const Vector<T> f = {c, s, s * Real(0)};
  const Vector<T> g = {-(s * cosine), c * cosine, sine};
  return in_space(plane_state(PlaneElements<T>{lambda, L, p_3 * eccentric, -(q_3 * eccentric)}, mu),
                  f, g);
}

}  // namespace

template <class Real>
template <class T>
SixNumbers<T> CanonicalChart<Real>::to_chart(const SixNumbers<T>& state) const {
  const auto turned = [&](const Vector<T>& u) {
    return Vector<T>{dot(u, axes_[0]), dot(u, axes_[1]), dot(u, axes_[2])};
  };
  const Vector<T> x = turned(position_of(state));
  const Vector<T> v = turned(momentum_of(state));
  switch (name_) {
    case ChartName::cartesian:
      break;
    case ChartName::spherical:
      return spherical_of(x, v);
    case ChartName::cylindrical:
      return cylindrical_of(x, v);
    case ChartName::poincare:
      return poincare_of(x, v, mu_);
    case ChartName::nodal:
      return nodal_of(x, v, mu_);
  }
  return {x[0], x[1], x[2], v[0], v[1], v[2]};
}

template <class Real>
template <class T>
SixNumbers<T> CanonicalChart<Real>::from_chart(const SixNumbers<T>& z) const {
  const auto in_axes = [&]() -> std::pair<Vector<T>, Vector<T>> {
    switch (name_) {
      case ChartName::cartesian:
        break;
      case ChartName::spherical:
        return state_of_spherical(z);
      case ChartName::cylindrical:
        return state_of_cylindrical(z);
      case ChartName::poincare:
        return state_of_poincare(z, mu_);
      case ChartName::nodal:
        return state_of_nodal(z, mu_);
    }
    return {position_of(z), momentum_of(z)};
  };
  const auto [x, v] = in_axes();
  const auto turned_back = [&](const Vector<T>& u, std::size_t i) {
    return u[0] * axes_[0][i] + u[1] * axes_[1][i] + u[2] * axes_[2][i];
  };
  return {turned_back(x, 0), turned_back(x, 1), turned_back(x, 2),
          turned_back(v, 0), turned_back(v, 1), turned_back(v, 2)};
}

template <class Real>
CanonicalChart<Real>::CanonicalChart(ChartName name, const SixNumbers<Real>& chief, const Real& mu)
    : name_(name), mu_(mu) {
  using std::sqrt;
  const Vector<Real> x = position_of(chief);
  const Vector<Real> v = momentum_of(chief);
  const Vector<Real> normal = cross(x, v);
  const Real r = sqrt(dot(x, x));
  const Real G = sqrt(dot(normal, normal));
  const auto refuse = [&](std::string_view reason) {
    throw Error(ErrorKind::numerical, fmt::format("{} coordinates: {}", name_of(name), reason));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) axes_[i][j] = Real(i == j ? 1 : 0);
  }
  if (is_of_elements() && !(dot(v, v) / Real(2) * r < mu * (Real(1) - Real(least_binding)))) {
    refuse("the orbit is no ellipse, or one of nearly zero energy");
  }
  if ((is_of_elements() || name == ChartName::spherical) &&
      !(G > Real(least_part) * r * sqrt(dot(v, v)))) {
    refuse("the chief moves nearly on a line through the centre, where no plane is defined");
  }
  if (name == ChartName::nodal &&
      !(G - abs_of(normal[2]) > Real(least_part * least_part) / 2 * G)) {
    refuse(fmt::format(
        "the orbit lies within {:.2g} deg of the equatorial plane, in which no node is defined",
        least_angle_deg));
  }
  if (name == ChartName::cylindrical &&
      !(x[0] * x[0] + x[1] * x[1] > Real(least_part * least_part) * r * r)) {
    refuse(fmt::format("the chief is within {:.2g} deg of the axis of the field", least_angle_deg));
  }
  if (name == ChartName::spherical) {
    for (std::size_t j = 0; j < 3; ++j) {
      axes_[0][j] = x[j] / r;
      axes_[2][j] = normal[j] / G;
    }
    axes_[1] = cross(axes_[2], axes_[0]);
  }
  if (name == ChartName::poincare && normal[2] < 0) axes_[1][1] = axes_[2][2] = Real(-1);
}

template <class Real>
SixNumbers<Real> CanonicalChart<Real>::coordinates(const SixNumbers<Real>& state) const {
  return to_chart(state);
}
template <class Real>
SixNumbers<Series<Real>> CanonicalChart<Real>::coordinates(
    const SixNumbers<Series<Real>>& state) const {
  return to_chart(state);
}
template <class Real>
SixNumbers<Real> CanonicalChart<Real>::state(const SixNumbers<Real>& coordinates) const {
  return from_chart(coordinates);
}
template <class Real>
SixNumbers<Series<Real>> CanonicalChart<Real>::state(
    const SixNumbers<Series<Real>>& coordinates) const {
  return from_chart(coordinates);
}

template <class Real>
bool CanonicalChart<Real>::is_angle(std::size_t place) const {
  switch (name_) {
    case ChartName::cartesian:
      return false;
    case ChartName::spherical:
      return place == 0 || place == 2;
    case ChartName::cylindrical:
    case ChartName::poincare:
      return place == 0;
    case ChartName::nodal:
      return place == 0 || place == 1;
  }
  return false;
}

template <class Real>
Real within_half_a_turn(const Real& angle) {
  using std::floor;
  const Real turn = Real(2) * boost::math::constants::pi<Real>();
  return angle - turn * floor(Real(angle / turn + Real(0.5)));
}

template class CanonicalChart<InstantiatedReal>;
template InstantiatedReal within_half_a_turn(const InstantiatedReal&);

}  // namespace hamjet
