#pragma once

#include <cstddef>
#include <vector>

namespace hamjet {

/// The fully normalised coefficients C_nm and S_nm of spherical harmonics, 0 <= m <= n <= degree and
/// m <= order, C_00 = 1 and all others 0 at first.
class SphericalHarmonicCoefficients {
 public:
  /// Needs 0 <= order <= degree.
  SphericalHarmonicCoefficients(int degree, int order)
      : degree_(degree),
        order_(order),
        C_(place(degree, degree) + 1),
        S_(place(degree, degree) + 1) {
    C_[0] = 1;
  }

  int degree() const { return degree_; }
  int order() const { return order_; }
  double C(int n, int m) const { return C_.at(place(n, m)); }
  double S(int n, int m) const { return S_.at(place(n, m)); }
  double& C(int n, int m) { return C_.at(place(n, m)); }
  double& S(int n, int m) { return S_.at(place(n, m)); }

 private:
  static std::size_t place(int n, int m) { return static_cast<std::size_t>(n * (n + 1) / 2 + m); }

  int degree_;
  int order_;
  std::vector<double> C_;
  std::vector<double> S_;
};

}  // namespace hamjet
