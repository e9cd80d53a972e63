#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>

namespace hamjet {

/// The zonal coefficients J_n of a gravity field, n = 2 to 20, dimensionless and not normalised:
/// J_n = -C_n0 = -sqrt(2n + 1) times the normalised C_n0. A coefficient of 0 counts as absent.
class ZonalCoefficients {
 public:
  static constexpr int lowest = 2;
  static constexpr int highest = 20;
  static constexpr std::size_t count = highest - lowest + 1;

  /// No coefficient is present.
  ZonalCoefficients() = default;
  /// Takes pairs of n and J_n; throws std::out_of_range unless lowest <= n <= highest.
  ZonalCoefficients(std::initializer_list<std::pair<int, double>> given) {
    for (const auto& [n, value] : given) (*this)[n] = value;
  }

  /// Takes all coefficients, J_2 first.
  explicit ZonalCoefficients(std::span<const double, count> values) {
    std::copy(values.begin(), values.end(), values_.begin());
  }

  /// J_n; throws std::out_of_range unless lowest <= n <= highest.
  double operator[](int n) const { return values_.at(static_cast<std::size_t>(n - lowest)); }
  double& operator[](int n) { return values_.at(static_cast<std::size_t>(n - lowest)); }

  /// All coefficients, J_2 first.
  std::span<const double, count> values() const { return values_; }
  /// The largest n for which J_n is not 0; 0 if no coefficient is present.
  int highest_present() const {
    for (int n = highest; n >= lowest; --n) {
      if ((*this)[n] != 0) return n;
    }
    return 0;
  }
  bool any() const { return highest_present() != 0; }
  /// Whether no odd J_n is present: then the field is symmetric about the equator.
  bool is_even() const {
    for (int n = lowest + 1; n <= highest; n += 2) {
      if ((*this)[n] != 0) return false;
    }
    return true;
  }

 private:
  std::array<double, count> values_{};
};

}  // namespace hamjet
