#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <experimental/simd>
#include <limits>
#include <type_traits>
#include <utility>

#include "hamjet/detail/algebra/double_double.hpp"
#include "hamjet/instruction_set.hpp"

namespace hamjet {

namespace detail {

/// The vector type for `Lanes` numbers. For double it has the machine's native width, or less if
/// fewer lanes are wanted, never more: compilers translate a vector wider than the machine's
/// poorly.
template <class Real, int Lanes>
struct VectorFor {
  using type = Real;
  static constexpr int width = 1;
};

template <int Lanes>
requires(Lanes > 1) struct VectorFor<double, Lanes> {
  static constexpr int native = static_cast<int>(std::experimental::native_simd<double>::size());
  static_assert(native == built_for::native_lanes,
                "hamjet was built for vectors of another width: compile with the same instruction "
                "set");
  static constexpr int width = Lanes < native ? Lanes : native;
  using type =
      std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, width>>;
};

template <int Lanes>
requires(Lanes > 1) struct VectorFor<DoubleDouble, Lanes> {
  using Part = typename VectorFor<double, Lanes>::type;
  static constexpr int width = VectorFor<double, Lanes>::width;
  using type = std::conditional_t<width == 1, DoubleDouble, Doubled<Part>>;
};

// The lanes of a vector.
template <class V>
auto lane_of(const V& vector, std::size_t i) {
  return vector[i];
}
template <class V, class Real>
void set_lane_of(V& vector, std::size_t i, const Real& value) {
  vector[i] = value;
}
template <class V>
DoubleDouble lane_of(const Doubled<V>& vector, std::size_t i) {
  return {vector.high[i], vector.low[i]};
}
template <class V>
void set_lane_of(Doubled<V>& vector, std::size_t i, const DoubleDouble& value) {
  vector.high[i] = value.high;
  vector.low[i] = value.low;
}

template <class V>
auto sum_of_lanes(const V& vector) {
  return std::experimental::reduce(vector);
}
/// Halves are added to each other, so that few additions wait for another.
template <class V>
DoubleDouble sum_of_lanes(const Doubled<V>& vector) {
  if constexpr (V::size() == 1) {
    return lane_of(vector, 0);
  } else {
    namespace simd = std::experimental;
    constexpr std::size_t half = V::size() / 2;
    using Half = simd::simd<double, simd::simd_abi::deduce_t<double, half>>;
    const auto high = simd::split<Half>(vector.high);
    const auto low = simd::split<Half>(vector.low);
    return sum_of_lanes(Doubled<Half>(high[0], low[0]) + Doubled<Half>(high[1], low[1]));
  }
}

}  // namespace detail

/// A fixed number of reals that go through the same arithmetic together, such as the stages of an
/// implicit Runge-Kutta method. A pack is an array of vectors of the machine's width; in extended
/// precision it is an array of scalars, and of double-double numbers an array of pairs of vectors.
/// All operations act componentwise.
template <class Real, int Lanes>
struct Pack {
  using real_type = Real;
  using Vector = typename detail::VectorFor<Real, Lanes>::type;
  static constexpr int lanes = Lanes;
  static constexpr int width = detail::VectorFor<Real, Lanes>::width;
  static constexpr int parts = Lanes / width;

  std::array<Vector, parts> part;

  Pack() : part{} {}
  explicit Pack(const std::array<Vector, parts>& parts_of_pack) : part(parts_of_pack) {}
  /// Sets all lanes to `value`.
  Pack(const Real& value) {  // NOLINT(google-explicit-constructor): reals embed in packs
    for (auto& v : part) v = Vector(value);
  }

  /// The pack whose lane i is f(i).
  template <class Function>
  static Pack of_lanes(const Function& f) {
    Pack result;
    if constexpr (std::experimental::is_simd_v<Vector>) {
      for (std::size_t p = 0; p < parts; ++p) {
        result.part[p] = Vector([&](auto i) { return f(p * width + i); });
      }
    } else {
      for (std::size_t i = 0; i < lanes; ++i) result.set_lane(static_cast<int>(i), f(i));
    }
    return result;
  }

  Real lane(int i) const {
    // An unsigned division by a power of two is a shift.
    const auto k = static_cast<std::size_t>(i);
    constexpr std::size_t size = width;
    if constexpr (width == 1) {
      return part[k];
    } else {
      return detail::lane_of(part[k / size], k % size);
    }
  }
  void set_lane(int i, const Real& value) {
    const auto k = static_cast<std::size_t>(i);
    constexpr std::size_t size = width;
    if constexpr (width == 1) {
      part[k] = value;
    } else {
      detail::set_lane_of(part[k / size], k % size, value);
    }
  }

  Pack& operator+=(const Pack& o) {
    for (std::size_t i = 0; i < parts; ++i) part[i] += o.part[i];
    return *this;
  }
  Pack& operator-=(const Pack& o) {
    for (std::size_t i = 0; i < parts; ++i) part[i] -= o.part[i];
    return *this;
  }
  Pack& operator*=(const Pack& o) {
    for (std::size_t i = 0; i < parts; ++i) part[i] *= o.part[i];
    return *this;
  }
  Pack& operator/=(const Pack& o) {
    for (std::size_t i = 0; i < parts; ++i) part[i] /= o.part[i];
    return *this;
  }
  // The operation is done part by part: with several parts, a copy that is then changed would go
  // through memory.
  friend Pack operator+(const Pack& a, const Pack& b) {
    return by_part([&](std::size_t i) { return a.part[i] + b.part[i]; });
  }
  friend Pack operator-(const Pack& a, const Pack& b) {
    return by_part([&](std::size_t i) { return a.part[i] - b.part[i]; });
  }
  friend Pack operator*(const Pack& a, const Pack& b) {
    return by_part([&](std::size_t i) { return a.part[i] * b.part[i]; });
  }
  friend Pack operator/(const Pack& a, const Pack& b) {
    return by_part([&](std::size_t i) { return a.part[i] / b.part[i]; });
  }
  friend Pack operator-(const Pack& a) {
    return by_part([&](std::size_t i) { return -a.part[i]; });
  }

  /// The pack whose part i is f(i).
  template <class Function>
  static Pack by_part(const Function& f) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return Pack(std::array<Vector, parts>{Vector(f(I))...});
    }
    (std::make_index_sequence<parts>{});
  }
};

template <class T>
inline constexpr bool is_pack = false;
template <class Real, int Lanes>
inline constexpr bool is_pack<Pack<Real, Lanes>> = true;

/// Applies a scalar function lane by lane.
template <class Real, int Lanes, class Function>
Pack<Real, Lanes> map_lanes(const Pack<Real, Lanes>& x, Function function) {
  Pack<Real, Lanes> result;
  for (int i = 0; i < Lanes; ++i) result.set_lane(i, function(x.lane(i)));
  return result;
}

/// Sum over the lanes of the products a_i b_i.
template <class Real, int Lanes>
Real dot(const Pack<Real, Lanes>& a, const Pack<Real, Lanes>& b) {
  auto sum = a.part[0] * b.part[0];
  for (std::size_t i = 1; i < a.parts; ++i) sum += a.part[i] * b.part[i];
  if constexpr (Pack<Real, Lanes>::width > 1) {
    return detail::sum_of_lanes(sum);
  } else {
    return sum;
  }
}

/// Lane by lane the larger of a and the magnitude of b. The function is always inlined, for a call
/// would take as long as its work.
template <class Real, int Lanes>
[[gnu::always_inline]] inline Pack<Real, Lanes> larger_magnitude(const Pack<Real, Lanes>& a,
                                                                 const Pack<Real, Lanes>& b) {
  Pack<Real, Lanes> result;
  if constexpr (std::experimental::is_simd_v<typename Pack<Real, Lanes>::Vector>) {
    for (std::size_t i = 0; i < a.parts; ++i) {
      result.part[i] = std::experimental::max(a.part[i], std::experimental::abs(b.part[i]));
    }
  } else {
    for (int i = 0; i < Lanes; ++i) {
      const Real value = b.lane(i);
      const Real size = value < 0 ? Real(-value) : value;
      result.set_lane(i, a.lane(i) < size ? size : a.lane(i));
    }
  }
  return result;
}

/// The largest magnitude of the lanes; NaN if one of them is NaN.
template <class Real, int Lanes>
[[gnu::always_inline]] inline Real largest_magnitude(const Pack<Real, Lanes>& x) {
  if constexpr (std::experimental::is_simd_v<typename Pack<Real, Lanes>::Vector>) {
    namespace simd = std::experimental;
    auto largest = simd::abs(x.part[0]);
    for (std::size_t i = 1; i < x.parts; ++i) largest = simd::max(largest, simd::abs(x.part[i]));
    const Real result = simd::hmax(largest);
    // For a number and a NaN the machine's maximum is the number, which would hide the NaN.
    for (std::size_t i = 0; i < x.parts; ++i) {
      if (!simd::all_of(simd::abs(x.part[i]) <= result)) {
        return std::numeric_limits<Real>::quiet_NaN();
      }
    }
    return result;
  } else {
    Real result = 0;
    for (int i = 0; i < Lanes; ++i) {
      const Real value = x.lane(i);
      const Real size = value < 0 ? Real(-value) : value;
      if (!(size <= result)) result = size;
      if (!(result == result)) break;
    }
    return result;
  }
}

template <class Real, int Lanes>
Pack<Real, Lanes> sqrt(const Pack<Real, Lanes>& x) {
  if constexpr (Pack<Real, Lanes>::width > 1) {
    Pack<Real, Lanes> result;
    using std::experimental::sqrt;
    for (std::size_t i = 0; i < x.parts; ++i) result.part[i] = sqrt(x.part[i]);
    return result;
  } else {
    return map_lanes(x, [](const Real& v) {
      using std::sqrt;
      return Real(sqrt(v));
    });
  }
}

// The transcendental functions are evaluated at degree 0 alone, once per operation, so that their
// speed does not matter.
#define HAMJET_PACK_FUNCTION(name)                     \
  template <class Real, int Lanes>                     \
  Pack<Real, Lanes> name(const Pack<Real, Lanes>& x) { \
    return map_lanes(x, [](const Real& v) {            \
      using std::name;                                 \
      return Real(name(v));                            \
    });                                                \
  }
HAMJET_PACK_FUNCTION(exp)
HAMJET_PACK_FUNCTION(log)
HAMJET_PACK_FUNCTION(sin)
HAMJET_PACK_FUNCTION(cos)
HAMJET_PACK_FUNCTION(sinh)
HAMJET_PACK_FUNCTION(cosh)
#undef HAMJET_PACK_FUNCTION

template <class Real, int Lanes>
Pack<Real, Lanes> atan2(const Pack<Real, Lanes>& y, const Pack<Real, Lanes>& x) {
  Pack<Real, Lanes> result;
  for (int i = 0; i < Lanes; ++i) {
    using std::atan2;
    result.set_lane(i, Real(atan2(y.lane(i), x.lane(i))));
  }
  return result;
}

template <class Real, int Lanes>
Pack<Real, Lanes> pow(const Pack<Real, Lanes>& x, const Real& exponent) {
  return map_lanes(x, [&](const Real& v) {
    using std::pow;
    return Real(pow(v, exponent));
  });
}

}  // namespace hamjet
