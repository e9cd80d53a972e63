#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hamjet {

/// How the degree-d slice of a product of two series is formed without the constant terms:
///
///   (a b)_d  =  sum over 1 <= i <= d-1 of a_i b_(d-i)     ("interior product").
///
/// The last three variables span blocks: monomials with the same exponents in the other variables
/// and degree m in these three stand together, T(m) = (m+1)(m+2)/2 of them. Within a block the
/// monomial u^(m-r) v^(r-k) w^k has the position r(r+1)/2 + k whatever m is. So the product of a
/// block of degree m_a and one of degree m_b is a fixed pattern of T(m_a) T(m_b) multiply-adds into
/// T(m_a + m_b) sums: no index is read inside, the sums stay in registers, and each number that is
/// loaded serves several times. With fewer than three variables every block has one monomial.
struct ProductSchedule {
  /// Offsets of the two factors' blocks.
  struct Pair {
    std::uint32_t a;
    std::uint32_t b;
  };
  /// One block of the result.
  struct Output {
    std::uint32_t offset;       ///< of the block in the result
    std::uint32_t block_degree;  ///< m
    std::uint32_t first_pair;   ///< into `pairs`
    std::uint32_t first_run;    ///< into `run_ends`: m + 1 entries, for m_a = 0..m
  };

  std::vector<Output> outputs;
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> run_ends;  ///< end, in `pairs`, of the pairs with this m_a

  /// The same for squares: each unordered pair of different blocks once, to be doubled; where a
  /// block meets itself its offset stands in `diagonal` (or `no_diagonal`), one entry per output.
  std::vector<Output> square_outputs;
  std::vector<Pair> square_pairs;
  std::vector<std::uint32_t> square_run_ends;
  std::vector<std::uint32_t> diagonal;

  static constexpr std::uint32_t no_diagonal = UINT32_MAX;

  std::size_t multiply_adds = 0;         ///< of the interior product
  std::size_t square_multiply_adds = 0;  ///< of the interior square
};

/// Number of monomials of degree m in three variables.
constexpr std::size_t block_size(std::size_t m) { return (m + 1) * (m + 2) / 2; }

}  // namespace hamjet
