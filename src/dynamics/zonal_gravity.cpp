#include "hamjet/dynamics/zonal_gravity.hpp"

#include <span>
#include <vector>

#include "solid_zonals.hpp"

namespace hamjet {
namespace {

/// The factors mu J_n R^n, by n.
template <class T>
std::vector<T> solid_coefficients(const ZonalGravity& field, int highest) {
  std::vector<T> result;
  T factor(field.mu);
  for (int n = 0; n <= highest; ++n) {
    const bool is_present = n >= ZonalCoefficients::lowest && field.J[n] != 0;
    result.push_back(is_present ? factor * T(field.J[n]) : T(0));
    factor *= T(field.radius);
  }
  return result;
}

template <class T>
T distance_squared(std::span<const T> q) {
  return q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
}

struct Hamiltonian {
  ZonalGravity field;

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    const int highest = field.J.highest_present();
    T potential(0);
    if (highest != 0) {
      const std::vector<T> c = solid_coefficients<T>(field, highest);
      const SolidZonals<T> solid = solid_zonals(q, 1, highest);
      T odd(0);
      for (int n = 2; n <= highest; ++n) {
        const auto k = static_cast<std::size_t>(n / 2);
        const T degree(n);
        if (n % 2 == 1) {
          odd += c[n] * solid.uD[k] / degree;
        } else {
          potential += c[n] * (solid.uD[k - 1] / (degree - T(1)) - solid.yB[k - 1] / degree);
        }
      }
      potential += q[2] * odd;
    }
    // The central term is added last, so that small terms are summed first.
    potential -= T(field.mu) * pow(distance_squared(q), T(-0.5));
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / T(2) + potential;
  }
};

/// The force -dV/dq of a zonal field. With Z_n = P_n(z/r) / r^(n+1) and H_n = P'_(n+1)(z/r) /
/// r^(n+3), where ' is the derivative with respect to the argument,
///
///   dZ_n/dx = -x H_n, dZ_n/dy = -y H_n, dZ_n/dz = -z H_n + H_(n-1) .
struct Force {
  ZonalGravity field;

  template <class T>
  std::vector<T> operator()(std::span<const T> q) const {
    const int highest = field.J.highest_present();
    T horizontal(0);  // factor of x and y
    T vertical(0);    // factor of z, of even n
    T odd(0);         // sum over odd n; its product with z belongs to both of these factors
    T axial(0);
    if (highest != 0) {
      const std::vector<T> c = solid_coefficients<T>(field, highest);
      const SolidZonals<T> solid = solid_zonals(q, 3, highest);
      for (int n = 2; n <= highest; ++n) {
        const auto k = static_cast<std::size_t>(n / 2);
        if (n % 2 == 1) {
          odd += c[n] * solid.B[k];
          axial += c[n] * solid.A[k];
        } else {
          horizontal += c[n] * solid.A[k];
          vertical += c[n] * solid.D[k];
        }
      }
    }
    const T odd_part = q[2] * odd;
    // The central terms are added last, so that small terms are summed first.
    const T attraction = T(field.mu) * pow(distance_squared(q), T(-1.5));
    const T common = horizontal + odd_part - attraction;
    return {q[0] * common, q[1] * common, q[2] * (vertical + odd_part - attraction) - axial};
  }
};

}  // namespace

DynamicalSystem zonal_gravity(const ZonalGravity& field) {
  DynamicalSystem system = make_system("zonal-gravity", 3, Hamiltonian{field}, Force{field});
  system.waves_on_a_circle = field.J.highest_present();
  system.rotated_planes = {{0, 1}, {3, 4}};  // the rotation about the axis of the zonal harmonics
  return system;
}

DynamicalSystem kepler(double mu) {
  DynamicalSystem system = zonal_gravity({.mu = mu});
  system.name = "kepler";
  return system;
}

}  // namespace hamjet
