#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hamjet {

/// The Legendre polynomials P_n(s), s = z/r, and their derivatives; odd functions are written
/// without their factor z. With u = 1/r^2, y = 1 - s^2 and a power a of 1/r, for each k,
///
///   A_k = P'_(2k+1)(s) / r^(a+2k),          B_k = P'_(2k+2)(s)/s / r^(a+2k+2),
///   D_k = (2k+1) P_(2k+1)(s)/s / r^(a+2k) = A_k - B_(k-1) .
template <class T>
struct SolidZonals {
  std::vector<T> A;  ///< from k = 1 on; the place of k = 0 is empty
  std::vector<T> B;
  std::vector<T> D;   ///< from k = 1 on
  std::vector<T> uD;  ///< u D_k
  std::vector<T> yB;  ///< y B_k
};

/// Up to this k, D_k is taken as the difference A_k - B_(k-1), at no extra cost. At the poles D_k
/// is smaller than these parts by a factor k + 1, and y = 1 - s^2 cancels as well. Up to degree
/// 2k+1 = 7 this costs less than one decimal; at degree 20 the error would be 2.5e-14 of a term.
inline constexpr int last_difference = 3;

/// Forms all that zonal coefficients up to degree `highest` need. From n P'_(n+1) = (2n+1) s P'_n -
/// (n+1) P'_(n-1) and (n+1) P_(n+1) = s P'_(n+1) - P'_n,
///
///   B_k     = u A_k + (2k+2)/(2k+1) u D_k ,
///   A_(k+1) = [(4k+5) s^2 B_k - (2k+3) u A_k] / (2k+2) ,
///   D_(k+1) = (2k+3)/(2k+1) u D_k - (4k+5)/(2k+2) y B_k .
///
/// A is accurate at the equator, where s^2 is small, and D at the poles, where y is small. Two
/// degrees cost three products (u A, u B, z^2 u B), and beyond last_difference four (u A, u D, s^2
/// B, y B).
template <class T>
SolidZonals<T> solid_zonals(std::span<const T> q, int power, int highest) {
  const T rho2 = q[0] * q[0] + q[1] * q[1];
  const T z2 = q[2] * q[2];
  const T r2 = rho2 + z2;
  const auto distance_power = [&](int exponent) { return pow(r2, T(exponent) / T(2)); };
  SolidZonals<T> solid{{T(0)}, {}, {T(0)}, {}, {}};
  T uA = distance_power(-power - 2);
  T uD = uA;
  for (int k = 0;; ++k) {
    const auto ratio = [k](int a, int b, int c, int d) { return T(a * k + b) / T(c * k + d); };
    const T B = uA + ratio(2, 2, 2, 1) * uD;
    solid.uD.push_back(uD);
    solid.B.push_back(B);
    if (2 * k + 2 > highest) return solid;
    const bool by_difference = k + 1 <= last_difference;
    const T u = distance_power(-2);
    const T uB = k == 0 ? T(3) * distance_power(-power - 4) : u * B;
    const T s2B = by_difference ? z2 * uB : z2 * u * B;
    const T yB = by_difference ? B - s2B : rho2 * u * B;
    const T A = ratio(4, 5, 2, 2) * s2B - ratio(2, 3, 2, 2) * uA;
    const T D = by_difference ? A - B : ratio(2, 3, 2, 1) * uD - ratio(4, 5, 2, 2) * yB;
    uA = u * A;
    uD = by_difference ? uA - uB : u * D;
    solid.yB.push_back(yB);
    solid.A.push_back(A);
    solid.D.push_back(D);
  }
}

}  // namespace hamjet
