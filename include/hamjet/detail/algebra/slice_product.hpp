#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "hamjet/algebra/series_space.hpp"
#include "hamjet/detail/algebra/pack.hpp"

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

/// One machine vector of a coefficient: a part of a pack, or a single number repeated in all lanes.
template <class Vector, class T>
[[gnu::always_inline]] inline Vector part_of(const T& x, std::size_t part) {
  if constexpr (std::is_same_v<Vector, typename Parts<T>::Vector>) {
    return Parts<T>::get(x, part);
  } else {
    return Vector(x);
  }
}

/// sums[i * j - First] += a[i] * b[j] for all monomials i of degree MA and j of degree MB whose
/// product has a position in First..Last-1, fully unrolled.
template <std::size_t MA, std::size_t MB, std::size_t First, std::size_t Last, class A, class B,
          class Vector, std::size_t Count>
[[gnu::always_inline]] inline void multiply_blocks(std::array<Vector, Count>& sums, const A* a,
                                                   const B* b, std::size_t part) {
  const auto add = [&]<std::size_t I, std::size_t J>(
      const Vector& factor, std::index_sequence<I, J>) __attribute__((always_inline)) {
    constexpr std::size_t place = product_position(I, J);
    if constexpr (place >= First && place < Last) {
      sums[place - First] += factor * part_of<Vector>(b[J], part);
    }
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    (
        [&]<std::size_t Row, std::size_t... J>(std::integral_constant<std::size_t, Row>,
                                               std::index_sequence<J...>)
            __attribute__((always_inline)) {
              const Vector factor = part_of<Vector>(a[Row], part);
              (add(factor, std::index_sequence<Row, J>{}), ...);
            }(std::integral_constant<std::size_t, I>{}, std::make_index_sequence<block_size(MB)>{}),
        ...);
  }
  (std::make_index_sequence<block_size(MA)>{});
}

/// sums[i * j] += a[i] * b[j] for block degrees known at run time only.
template <class Vector, class A, class B>
void multiply_blocks(Vector* sums, const A* a, const B* b, std::size_t m_a, std::size_t m_b,
                     std::size_t part) {
  for (std::size_t ra = 0; ra <= m_a; ++ra) {
    for (std::size_t ka = 0; ka <= ra; ++ka) {
      const Vector factor = part_of<Vector>(a[ra * (ra + 1) / 2 + ka], part);
      for (std::size_t rb = 0; rb <= m_b; ++rb) {
        Vector* row = sums + (ra + rb) * (ra + rb + 1) / 2 + ka;
        const B* b_row = b + rb * (rb + 1) / 2;
        for (std::size_t kb = 0; kb <= rb; ++kb)
          row[kb] += factor * part_of<Vector>(b_row[kb], part);
      }
    }
  }
}

/// Whether the numbers live in machine registers. Other numbers (extended precision) gain nothing
/// from unrolled blocks, which would cost minutes of compilation.
template <class Vector>
inline constexpr bool is_machine_vector =
    std::is_arithmetic_v<Vector> || std::experimental::is_simd_v<Vector>;

/// Whether blocks of degree 7 and 8 are unrolled too, which takes long to compile. They are for
/// plain doubles, and for packs of vectors of the machine's full width, which the usual
/// integrations use.
template <class T>
inline constexpr bool unrolls_large_blocks = std::is_same_v<T, double>;
template <int Lanes>
inline constexpr bool unrolls_large_blocks<Pack<double, Lanes>> =
    Pack<double, Lanes>::width == detail::VectorFor<double, 2>::native;

/// The largest number of sums that are formed together. They stay in registers (32 with AVX-512),
/// beside the factors that compilers keep there. A block of degree 6 takes 1.15 times as long with
/// all 28 sums at once as in two halves, for a part of the sums then goes through memory.
inline constexpr std::size_t most_sums = 15;

/// The end of the group of sums that are formed together from `first` on. A block is cut into
/// nearly equal groups.
constexpr std::size_t end_of_sums(std::size_t first, std::size_t block_size) {
  const std::size_t parts = (block_size + most_sums - 1) / most_sums;
  return std::min(first + (block_size + parts - 1) / parts, block_size);
}

/// Which slice is formed: c = a b, c = a^2 (where b is a), c += a b, or c = a b by a directed
/// schedule.
enum class SliceForm { product, square, added_product, directed_product };

template <SliceForm Form, class Vector>
void put_sum(const Vector& sum, Vector& target) {
  if constexpr (Form == SliceForm::added_product) {
    target += sum;
  } else {
    target = sum;
  }
}

/// Forms the sums of one block from First on; the coefficients of b may be numbers where those of a
/// are packs.
template <std::size_t M, SliceForm Form, std::size_t First = 0, class T, class B>
void form_block(const ProductSchedule::Output& output, const ProductSchedule::Pair* pairs,
                const std::uint32_t* run_ends, const T* a, const B* b, T* c) {
  using Vector = typename Parts<T>::Vector;
  constexpr std::size_t last = end_of_sums(First, block_size(M));
  for (std::size_t part = 0; part < Parts<T>::count; ++part) {
    std::array<Vector, last - First> sums{};
    std::size_t pair = output.first_pair;
    [&]<std::size_t... MX>(std::index_sequence<MX...>) __attribute__((always_inline)) {
      (
          [&]<std::size_t Mx>(
              std::integral_constant<std::size_t, Mx>) __attribute__((always_inline)) {
            if constexpr (Form == SliceForm::directed_product) {
              const std::uint32_t* const ends = run_ends + output.first_run + 2 * Mx;
              for (; pair < ends[0]; ++pair) {
                const auto [x, y] = pairs[pair];
                multiply_blocks<Mx, M - Mx, First, last>(sums, a + x, b + y, part);
              }
              for (; pair < ends[1]; ++pair) {
                const auto [x, y] = pairs[pair];
                multiply_blocks<Mx, M - Mx, First, last>(sums, b + x, a + y, part);
              }
            } else {
              for (const std::size_t end = run_ends[output.first_run + Mx]; pair < end; ++pair) {
                const auto [x, y] = pairs[pair];
                multiply_blocks<Mx, M - Mx, First, last>(sums, a + x, b + y, part);
                if constexpr (Form != SliceForm::square) {
                  multiply_blocks<Mx, M - Mx, First, last>(sums, b + x, a + y, part);
                }
              }
            }
          }(std::integral_constant<std::size_t, MX>{}),
          ...);
    }
    (std::make_index_sequence<M / 2 + 1>{});
    if constexpr (Form == SliceForm::square) {
      for (auto& sum : sums) sum += sum;
    }
    if constexpr (M % 2 == 0) {
      if (output.diagonal != ProductSchedule::no_diagonal) {
        multiply_blocks<M / 2, M / 2, First, last>(sums, a + output.diagonal, b + output.diagonal,
                                                   part);
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      put_sum<Form>(sums[i], Parts<T>::get(c[output.offset + First + i], part));
    }
  }
  if constexpr (last < block_size(M)) {
    form_block<M, Form, last>(output, pairs, run_ends, a, b, c);
  }
}

/// Forms one block whose degree is known at run time only.
template <SliceForm Form, class T, class B>
void form_large_block(const ProductSchedule::Output& output, const ProductSchedule::Pair* pairs,
                      const std::uint32_t* run_ends, const T* a, const B* b, T* c) {
  using Vector = typename Parts<T>::Vector;
  const std::size_t m = output.block_degree;
  std::vector<Vector> sums(block_size(m));
  for (std::size_t part = 0; part < Parts<T>::count; ++part) {
    std::fill(sums.begin(), sums.end(), Vector{});
    std::size_t pair = output.first_pair;
    for (std::size_t m_x = 0; 2 * m_x <= m; ++m_x) {
      if constexpr (Form == SliceForm::directed_product) {
        const std::uint32_t* const ends = run_ends + output.first_run + 2 * m_x;
        for (; pair < ends[0]; ++pair) {
          multiply_blocks(sums.data(), a + pairs[pair].x, b + pairs[pair].y, m_x, m - m_x, part);
        }
        for (; pair < ends[1]; ++pair) {
          multiply_blocks(sums.data(), b + pairs[pair].x, a + pairs[pair].y, m_x, m - m_x, part);
        }
        continue;
      }
      for (const std::size_t end = run_ends[output.first_run + m_x]; pair < end; ++pair) {
        const auto [x, y] = pairs[pair];
        multiply_blocks(sums.data(), a + x, b + y, m_x, m - m_x, part);
        if (Form != SliceForm::square) {
          multiply_blocks(sums.data(), b + x, a + y, m_x, m - m_x, part);
        }
      }
    }
    if (Form == SliceForm::square) {
      for (auto& sum : sums) sum += sum;
    }
    if (output.diagonal != ProductSchedule::no_diagonal) {
      multiply_blocks(sums.data(), a + output.diagonal, b + output.diagonal, m / 2, m / 2, part);
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      put_sum<Form>(sums[i], Parts<T>::get(c[output.offset + i], part));
    }
  }
}

template <SliceForm Form, class T, class B>
void form_unrolled_blocks(const ProductSchedule::Output* output, const ProductSchedule::Output* end,
                          const ProductSchedule::Pair* pairs, const std::uint32_t* run_ends,
                          const T* a, const B* b, T* c) {
  // Outputs of equal block degree stand together, so that one dispatch serves all of them.
  while (output != end) {
    const auto run = [&]<std::size_t M>(std::integral_constant<std::size_t, M>) {
      for (; output != end && output->block_degree == M; ++output) {
        form_block<M, Form>(*output, pairs, run_ends, a, b, c);
      }
    };
    switch (output->block_degree) {
      case 0:
        run(std::integral_constant<std::size_t, 0>{});
        break;
      case 1:
        run(std::integral_constant<std::size_t, 1>{});
        break;
      case 2:
        run(std::integral_constant<std::size_t, 2>{});
        break;
      case 3:
        run(std::integral_constant<std::size_t, 3>{});
        break;
      case 4:
        run(std::integral_constant<std::size_t, 4>{});
        break;
      case 5:
        run(std::integral_constant<std::size_t, 5>{});
        break;
      case 6:
        run(std::integral_constant<std::size_t, 6>{});
        break;
      default:
        if constexpr (unrolls_large_blocks<T>) {
          if (output->block_degree == 7) {
            run(std::integral_constant<std::size_t, 7>{});
            break;
          }
          if (output->block_degree == 8) {
            run(std::integral_constant<std::size_t, 8>{});
            break;
          }
        }
        form_large_block<Form>(*output, pairs, run_ends, a, b, c);
        ++output;
    }
  }
}

/// The type of form_unrolled_blocks.
template <class T, class B = T>
using FormBlocks = void(const ProductSchedule::Output*, const ProductSchedule::Output*,
                        const ProductSchedule::Pair*, const std::uint32_t*, const T*, const B*, T*);
template <int Lanes>
using DoublePack = Pack<double, Lanes>;

// The blocks that the library's integrations use are compiled once, in slice_product.cpp. For one T
// this takes ten seconds; and a copy that another file compiles with less optimisation would be
// slower wherever the linker chose it.
#define HAMJET_BLOCKS_OF(Prefix, T)                                       \
  Prefix template FormBlocks<T> form_unrolled_blocks<SliceForm::product>; \
  Prefix template FormBlocks<T> form_unrolled_blocks<SliceForm::square>;  \
  Prefix template FormBlocks<T> form_unrolled_blocks<SliceForm::directed_product>;
#define HAMJET_COMPILED_BLOCKS(Prefix)                \
  HAMJET_BLOCKS_OF(Prefix, double)                    \
  HAMJET_BLOCKS_OF(Prefix, DoublePack<1>)             \
  HAMJET_BLOCKS_OF(Prefix, DoublePack<2>)             \
  HAMJET_BLOCKS_OF(Prefix, DoublePack<4>)             \
  HAMJET_BLOCKS_OF(Prefix, DoublePack<8>)             \
  HAMJET_BLOCKS_OF(Prefix, DoublePack<16>)            \
  Prefix template FormBlocks<DoublePack<2>, double>   \
      form_unrolled_blocks<SliceForm::added_product>; \
  Prefix template FormBlocks<DoublePack<4>, double>   \
      form_unrolled_blocks<SliceForm::added_product>; \
  Prefix template FormBlocks<DoublePack<8>, double> form_unrolled_blocks<SliceForm::added_product>;

HAMJET_COMPILED_BLOCKS(extern)

/// In uncoupled variables a slice of degree d >= 2 has one coefficient per variable, and reading
/// the schedule would take longer than the sum. The i-th power of a variable stands at variable + 1
/// + (i - 1) v.
template <class T>
void form_uncoupled(std::size_t variables, int d, const T* a, const T* b, T* c) {
  const std::size_t last = static_cast<std::size_t>(d - 2) * variables;  // place of the power d - 1
  for (std::size_t k = 1; k <= variables; ++k) {
    T sum = a[k] * b[k + last];
    for (std::size_t i = variables; i <= last; i += variables) sum += a[k + i] * b[k + last - i];
    c[k + last + variables] = sum;
  }
}

template <SliceForm Form, class T, class B>
void form_slice(const ProductSchedule& schedule, const T* a, const B* b, T* c) {
  const ProductSchedule::Output* output = schedule.outputs.data();
  const ProductSchedule::Output* const end = output + schedule.outputs.size();
  const ProductSchedule::Pair* const pairs = schedule.pairs.data();
  const std::uint32_t* const run_ends = schedule.run_ends.data();
  if constexpr (!is_machine_vector<typename Parts<T>::Vector>) {
    for (; output != end; ++output) {
      form_large_block<Form>(*output, pairs, run_ends, a, b, c);
    }
  } else {
    form_unrolled_blocks<Form>(output, end, pairs, run_ends, a, b, c);
  }
}

}  // namespace detail

/// c_d = sum over 1 <= i <= d-1 of a_i b_(d-i): the degree-d slice of the product of two series
/// without the terms that hold a_0 or b_0. Writes the slice of degree d of `c` alone; `c` may be
/// `a` or `b`, whose slices of degree d are not read.
template <class T>
void interior_product(const SeriesSpace& space, int d, const T* a, const T* b, T* c) {
  if (space.is_uncoupled() && d >= 2) {
    return detail::form_uncoupled(space.variables(), d, a, b, c);
  }
  detail::form_slice<detail::SliceForm::product>(space.products(d), a, b, c);
}

/// c_d = sum over 1 <= i <= d-1 of a_i a_(d-i): the interior product of a series with itself, at
/// about half the cost.
template <class T>
void interior_square(const SeriesSpace& space, int d, const T* a, T* c) {
  if (space.is_uncoupled() && d >= 2) {
    return detail::form_uncoupled(space.variables(), d, a, a, c);
  }
  detail::form_slice<detail::SliceForm::square>(space.products(d), a, a, c);
}

/// c_d = sum of a_i b_(d-i) over the slices of a schedule of SeriesSpace::products_above, whose
/// lowest degrees must be given for uncoupled variables.
template <class T>
void product_above(const SeriesSpace& space, const ProductSchedule& schedule, int d, int lowest_a,
                   int lowest_b, const T* a, const T* b, T* c) {
  if (space.is_uncoupled()) {
    const std::size_t v = space.variables();
    const auto power = [v](int i, std::size_t k) {
      return 1 + static_cast<std::size_t>(i - 1) * v + k;
    };
    for (std::size_t k = 0; k < v; ++k) {
      T sum = a[power(lowest_a, k)] * b[power(d - lowest_a, k)];
      for (int i = lowest_a + 1; i <= d - lowest_b; ++i) sum += a[power(i, k)] * b[power(d - i, k)];
      c[power(d, k)] = sum;
    }
  } else if (a == b) {
    detail::form_slice<detail::SliceForm::square>(schedule, a, a, c);
  } else {
    detail::form_slice<detail::SliceForm::directed_product>(schedule, a, b, c);
  }
}

/// c_d += sum over 1 <= i <= d-1 of a_i b_(d-i), where a holds packs and b numbers.
template <class T, class Real>
void add_interior_product(const SeriesSpace& space, int d, const T* a, const Real* b, T* c) {
  detail::form_slice<detail::SliceForm::added_product>(space.products(d), a, b, c);
}

}  // namespace hamjet
