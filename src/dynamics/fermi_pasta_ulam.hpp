#pragma once

#include <cstddef>
#include <span>

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The chain of 2m points of unit mass between two walls, in which stiff linear springs alternate
/// with soft nonlinear ones; q_i is the displacement of point i, and q_0 = q_(2m+1) = 0:
///
///   H = 1/2 sum_(i=1..2m) p_i^2 + omega^2/4 sum_(i=1..m) (q_(2i) - q_(2i-1))^2
///       + sum_(i=0..m) (q_(2i+1) - q_(2i))^4 .
///
/// The stretch (q_(2i) - q_(2i-1))/sqrt(2) of a stiff spring oscillates with the frequency omega.
/// Source: Hairer, Lubich and Wanner, Geometric Numerical Integration, section I.5.1 (a problem of
/// Fermi, Pasta and Ulam modified by Galgani, Giorgilli, Martinoli and Vanzini).
struct FermiPastaUlamHamiltonian {
  double omega = 1;

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    const auto square_of = [](const T& x) { return x * x; };
    const std::size_t points = q.size();
    T kinetic(0), stiff(0);
    T soft = square_of(square_of(q[0])) + square_of(square_of(q[points - 1]));
    for (std::size_t i = 0; i < points; ++i) kinetic += p[i] * p[i];
    for (std::size_t i = 0; i < points; i += 2) stiff += square_of(q[i + 1] - q[i]);
    for (std::size_t i = 2; i < points; i += 2) soft += square_of(square_of(q[i] - q[i - 1]));
    return kinetic / T(2) + T(omega) * T(omega) / T(4) * stiff + soft;
  }
};

/// The chain as a system; `omega` in rad/s, `pairs` the number m of stiff springs, at least 1.
inline DynamicalSystem fermi_pasta_ulam(double omega, std::size_t pairs) {
  return make_system("fermi-pasta-ulam", 2 * pairs, FermiPastaUlamHamiltonian{omega});
}

}  // namespace hamjet
