#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "hamjet/algebra/pack.hpp"
#include "hamjet/algebra/series_space.hpp"

// The inner loop of the library: products of homogeneous slices, as laid out in ProductSchedule.
// Packs are processed one machine vector at a time ("part"), so that the sums of a whole block stay
// in registers; a scalar coefficient is its own single part.

namespace hamjet {

namespace detail {

template <class T>
struct Parts {
  using Vector = T;
  static constexpr std::size_t count = 1;
  static Vector& get(T& x, std::size_t) { return x; }
  static const Vector& get(const T& x, std::size_t) { return x; }
};

template <class Real, int Lanes>
struct Parts<Pack<Real, Lanes>> {
  using P = Pack<Real, Lanes>;
  using Vector = typename P::Vector;
  static constexpr std::size_t count = P::parts;
  static Vector& get(P& x, std::size_t i) { return x.part[i]; }
  static const Vector& get(const P& x, std::size_t i) { return x.part[i]; }
};

/// Row r of the position r(r+1)/2 + k inside a block.
constexpr std::size_t block_row(std::size_t position) {
  std::size_t r = 0;
  while (block_size(r) <= position) ++r;
  return r;
}

/// Position of the product of the monomials at two positions: rows and columns add.
constexpr std::size_t product_position(std::size_t i, std::size_t j) {
  const std::size_t ri = block_row(i);
  const std::size_t rj = block_row(j);
  const std::size_t k = i - ri * (ri + 1) / 2 + j - rj * (rj + 1) / 2;
  return (ri + rj) * (ri + rj + 1) / 2 + k;
}

/// sums[i * j] += a[i] * b[j] for all monomials i of degree MA and j of degree MB, fully unrolled.
template <std::size_t MA, std::size_t MB, class T, class Sums>
[[gnu::always_inline]] inline void multiply_blocks(Sums& sums, const T* a, const T* b,
                                                   std::size_t part) {
  constexpr std::size_t na = block_size(MA);
  constexpr std::size_t nb = block_size(MB);
  [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    (
        [&]<std::size_t Row, std::size_t... J>(std::integral_constant<std::size_t, Row>,
                                               std::index_sequence<J...>)
            __attribute__((always_inline)) {
          const auto factor = Parts<T>::get(a[Row], part);
          ((sums[product_position(Row, J)] += factor * Parts<T>::get(b[J], part)), ...);
        }(std::integral_constant<std::size_t, I>{}, std::make_index_sequence<nb>{}),
        ...);
  }(std::make_index_sequence<na>{});
}

/// The same for block degrees known at run time only (blocks too large for the registers).
template <class T, class Vector>
void multiply_blocks(Vector* sums, const T* a, const T* b, std::size_t m_a, std::size_t m_b,
                     std::size_t part) {
  for (std::size_t ra = 0; ra <= m_a; ++ra) {
    for (std::size_t ka = 0; ka <= ra; ++ka) {
      const Vector factor = Parts<T>::get(a[ra * (ra + 1) / 2 + ka], part);
      for (std::size_t rb = 0; rb <= m_b; ++rb) {
        Vector* row = sums + (ra + rb) * (ra + rb + 1) / 2 + ka;
        const T* b_row = b + rb * (rb + 1) / 2;
        for (std::size_t kb = 0; kb <= rb; ++kb) row[kb] += factor * Parts<T>::get(b_row[kb], part);
      }
    }
  }
}

/// Largest block degree whose sums are kept in registers: 28 of the 32 of AVX-512.
inline constexpr std::size_t largest_unrolled_block = 6;

/// One block of a product or, with `diagonal`, of a square.
template <std::size_t M, bool Square, class T>
void form_block(const ProductSchedule::Output& output, const ProductSchedule::Pair* pairs,
                const std::uint32_t* run_ends, [[maybe_unused]] std::uint32_t diagonal, const T* a,
                const T* b, T* c) {
  using Vector = typename Parts<T>::Vector;
  for (std::size_t part = 0; part < Parts<T>::count; ++part) {
    std::array<Vector, block_size(M)> sums{};
    std::size_t pair = output.first_pair;
    [&]<std::size_t... MA>(std::index_sequence<MA...>) __attribute__((always_inline)) {
      (
          [&]<std::size_t Ma>(std::integral_constant<std::size_t, Ma>)
              __attribute__((always_inline)) {
            for (const std::size_t end = run_ends[output.first_run + Ma]; pair < end; ++pair) {
              multiply_blocks<Ma, M - Ma>(sums, a + pairs[pair].a, b + pairs[pair].b, part);
            }
          }(std::integral_constant<std::size_t, MA>{}),
          ...);
    }(std::make_index_sequence<M + 1>{});
    if constexpr (Square) {
      for (auto& sum : sums) sum += sum;
      if constexpr (M % 2 == 0) {
        if (diagonal != ProductSchedule::no_diagonal) {
          multiply_blocks<M / 2, M / 2>(sums, a + diagonal, a + diagonal, part);
        }
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) Parts<T>::get(c[output.offset + i], part) = sums[i];
  }
}

template <bool Square, class T>
void form_large_block(const ProductSchedule::Output& output, const ProductSchedule::Pair* pairs,
                      const std::uint32_t* run_ends, std::uint32_t diagonal, const T* a, const T* b,
                      T* c) {
  using Vector = typename Parts<T>::Vector;
  constexpr std::size_t largest_order = 60;
  const std::size_t m = output.block_degree;
  for (std::size_t part = 0; part < Parts<T>::count; ++part) {
    static thread_local std::array<Vector, block_size(largest_order)> sums;
    std::fill_n(sums.begin(), block_size(m), Vector{});
    std::size_t pair = output.first_pair;
    for (std::size_t m_a = 0; m_a <= m; ++m_a) {
      for (const std::size_t end = run_ends[output.first_run + m_a]; pair < end; ++pair) {
        multiply_blocks(sums.data(), a + pairs[pair].a, b + pairs[pair].b, m_a, m - m_a, part);
      }
    }
    if constexpr (Square) {
      for (std::size_t i = 0; i < block_size(m); ++i) sums[i] += sums[i];
      if (diagonal != ProductSchedule::no_diagonal) {
        multiply_blocks(sums.data(), a + diagonal, a + diagonal, m / 2, m / 2, part);
      }
    }
    for (std::size_t i = 0; i < block_size(m); ++i) {
      Parts<T>::get(c[output.offset + i], part) = sums[i];
    }
  }
}

template <bool Square, class T>
void form_slice(const std::vector<ProductSchedule::Output>& outputs,
                const ProductSchedule::Pair* pairs, const std::uint32_t* run_ends,
                const std::uint32_t* diagonals, const T* a, const T* b, T* c) {
  // Outputs of equal block degree stand together: one dispatch for all of them.
  std::size_t i = 0;
  while (i < outputs.size()) {
    const auto run = [&]<std::size_t M>(std::integral_constant<std::size_t, M>) {
      for (; i < outputs.size() && outputs[i].block_degree == M; ++i) {
        form_block<M, Square>(outputs[i], pairs, run_ends, diagonals[i], a, b, c);
      }
    };
    switch (outputs[i].block_degree) {
      case 0: run(std::integral_constant<std::size_t, 0>{}); break;
      case 1: run(std::integral_constant<std::size_t, 1>{}); break;
      case 2: run(std::integral_constant<std::size_t, 2>{}); break;
      case 3: run(std::integral_constant<std::size_t, 3>{}); break;
      case 4: run(std::integral_constant<std::size_t, 4>{}); break;
      case 5: run(std::integral_constant<std::size_t, 5>{}); break;
      case largest_unrolled_block:
        run(std::integral_constant<std::size_t, largest_unrolled_block>{});
        break;
      default:
        form_large_block<Square>(outputs[i], pairs, run_ends, diagonals[i], a, b, c);
        ++i;
    }
  }
}

}  // namespace detail

/// c_d = sum over 1 <= i <= d-1 of a_i b_(d-i): the degree-d slice of the product of two series
/// without the terms that hold a_0 or b_0. Writes the slice of degree d of `c` alone; `c` may be `a`
/// or `b`, whose slices of degree d are not read.
template <class T>
void interior_product(const SeriesSpace& space, int d, const T* a, const T* b, T* c) {
  const ProductSchedule& s = space.products(d);
  detail::form_slice<false>(s.outputs, s.pairs.data(), s.run_ends.data(), s.diagonal.data(), a, b, c);
}

/// The same for a square, at about half the cost.
template <class T>
void interior_square(const SeriesSpace& space, int d, const T* a, T* c) {
  const ProductSchedule& s = space.products(d);
  detail::form_slice<true>(s.square_outputs, s.square_pairs.data(), s.square_run_ends.data(),
                           s.diagonal.data(), a, a, c);
}

/// c_d = sum over lowest <= i <= d-1 of a_i b_(d-i): the interior product where `a` is known to have
/// no terms below degree `lowest`, at the cost of the terms that are left.
template <class T>
void interior_product_from(const SeriesSpace& space, int d, int lowest, const T* a, const T* b,
                           T* c) {
  const ProductSchedule& s = space.products(d);
  const std::size_t first = space.first(lowest);
  for (const ProductSchedule::Output& output : s.outputs) {
    T* sums = c + output.offset;
    std::fill_n(sums, block_size(output.block_degree), T(0));
    std::size_t pair = output.first_pair;
    for (std::size_t m_a = 0; m_a <= output.block_degree; ++m_a) {
      for (const std::size_t end = s.run_ends[output.first_run + m_a]; pair < end; ++pair) {
        if (s.pairs[pair].a < first) continue;
        detail::multiply_blocks(sums, a + s.pairs[pair].a, b + s.pairs[pair].b, m_a,
                                output.block_degree - m_a, 0);
      }
    }
  }
}

}  // namespace hamjet
