#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/detail/algebra/pack.hpp"
#include "support/magnitude.hpp"

namespace hamjet::test {

/// The lanes of a coefficient: one for a number, several for a pack.
template <class T>
struct Coefficient {
  using Real = T;
  static constexpr int lanes = 1;
  static Real get(const T& x, int) { return x; }
  static void set(T& x, int, const Real& value) { x = value; }
};

template <class R, int Lanes>
struct Coefficient<Pack<R, Lanes>> {
  using Real = R;
  static constexpr int lanes = Lanes;
  static Real get(const Pack<R, Lanes>& x, int lane) { return x.lane(lane); }
  static void set(Pack<R, Lanes>& x, int lane, const Real& value) { x.set_lane(lane, value); }
};

/// Unit round-off times two numbers of the kind that coefficients consist of.
template <class T>
double epsilon_of() {
  return static_cast<double>(std::numeric_limits<typename Coefficient<T>::Real>::epsilon());
}

/// Random numbers that are the same on every machine and in every run.
class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : engine_(seed) {}

  double uniform(double lowest, double highest) {
    return lowest + (highest - lowest) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int integer(int lowest, int highest) {
    const auto choices = static_cast<unsigned>(highest - lowest + 1);
    return lowest + static_cast<int>(engine_() % choices);
  }

 private:
  std::mt19937_64 engine_;
};

/// A series whose coefficients are small whole numbers: its products are free of rounding.
template <class T>
Series<T> random_integer_series(const SpacePointer& space, RandomNumbers& random, int largest = 9) {
  using C = Coefficient<T>;
  Series<T> result(space);
  for (std::size_t k = 0; k < result.size(); ++k) {
    for (int lane = 0; lane < C::lanes; ++lane) {
      C::set(result[k], lane, typename C::Real(random.integer(-largest, largest)));
    }
  }
  return result;
}

/// A series with a constant term in the given range and other coefficients in [-size, size].
template <class T>
Series<T> random_series(const SpacePointer& space, RandomNumbers& random,
                        std::pair<double, double> constant = {0.5, 2}, double size = 1) {
  using C = Coefficient<T>;
  Series<T> result(space);
  for (std::size_t k = 0; k < result.size(); ++k) {
    for (int lane = 0; lane < C::lanes; ++lane) {
      const double value =
          k == 0 ? random.uniform(constant.first, constant.second) : random.uniform(-size, size);
      C::set(result[k], lane, typename C::Real(value));
    }
  }
  return result;
}

/// The largest coefficient (of any lane) of one degree, in magnitude.
template <class T>
double largest_of_degree(const Series<T>& u, int degree) {
  using C = Coefficient<T>;
  double result = 0;
  for (const T& c : u.slice(degree)) {
    for (int lane = 0; lane < C::lanes; ++lane) {
      result = larger(result, std::abs(static_cast<double>(C::get(c, lane))));
    }
  }
  return result;
}

/// The largest coefficient of one degree over all components of a map.
template <class T>
double largest_of_degree(const std::vector<Series<T>>& map, int degree) {
  double result = 0;
  for (const auto& u : map) result = larger(result, largest_of_degree(u, degree));
  return result;
}

/// The largest coefficient of degree 0 to `highest`, in magnitude.
template <class T>
double largest_coefficient(const Series<T>& u, int highest) {
  double result = 0;
  for (int d = 0; d <= highest; ++d) result = larger(result, largest_of_degree(u, d));
  return result;
}
template <class T>
double largest_coefficient(const Series<T>& u) {
  return largest_coefficient(u, u.order());
}

/// The identity map of a space: x_1, ..., x_v.
template <class T>
std::vector<Series<T>> identity_map(const SpacePointer& space) {
  std::vector<Series<T>> result;
  for (std::size_t i = 0; i < space->variables(); ++i) {
    result.push_back(Series<T>::variable(space, i));
  }
  return result;
}

/// The largest coefficient of a - b over all components, in magnitude.
template <class T>
double largest_difference(const std::vector<Series<T>>& a, const std::vector<Series<T>>& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    result = larger(result, largest_coefficient(a[i] - b[i]));
  }
  return result;
}

}  // namespace hamjet::test
