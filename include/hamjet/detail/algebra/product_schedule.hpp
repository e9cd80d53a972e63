#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hamjet {

/// How the degree-d slice of a product of two series is formed, without the products with the
/// constant terms:
///
///   (a b)_d  =  sum over 1 <= i <= d-1 of a_i b_(d-i)     ("interior product").
///
/// The last three variables span blocks: monomials with the same exponents in the other variables
/// and degree m in these three stand together, T(m) = (m+1)(m+2)/2 of them. Within a block the
/// monomial u^(m-r) v^(r-k) w^k has the position r(r+1)/2 + k whatever m is. So the product of a
/// block of degree m_a and one of degree m_b is a fixed pattern of T(m_a) T(m_b) multiply-adds into
/// T(m_a + m_b) sums: no index is read inside, the sums stay in registers, and each number that is
/// loaded serves several times. With fewer than three variables every block has one monomial.
///
/// Each unordered pair of different blocks {x, y} is listed once and serves both a_x b_y and a_y
/// b_x; a block that is multiplied with itself stands in `diagonal`.
///
/// The schedule of a product whose factors have no slices below given degrees is *directed*: a pair
/// serves one product alone. For each m_x those for a_x b_y come first, then those for b_x a_y, and
/// each of the two runs has its own end.
struct ProductSchedule {
  /// Offsets of two different blocks, the one of smaller block degree first.
  struct Pair {
    std::uint32_t x;
    std::uint32_t y;
  };
  /// One block of the result.
  struct Output {
    std::uint32_t offset;        ///< offset of the block in the result
    std::uint32_t block_degree;  ///< degree m of the block in the last three variables
    std::uint32_t first_pair;    ///< index of its first pair in `pairs`
    std::uint32_t first_run;  ///< index in `run_ends`, which has one entry for each m_x = 0..m/2,
                              ///< or two in a directed schedule
    std::uint32_t diagonal;   ///< offset of the block of degree m/2 that is multiplied with itself,
                              ///< or no_diagonal
  };

  std::vector<Output> outputs;  ///< outputs of equal block degree stand together
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> run_ends;  ///< index in `pairs` of the end of the pairs with this m_x

  static constexpr std::uint32_t no_diagonal = UINT32_MAX;

  std::size_t multiply_adds = 0;         ///< the multiply-adds of the interior product
  std::size_t square_multiply_adds = 0;  ///< the multiply-adds of the interior square
};

/// Number of monomials of degree m in three variables.
constexpr std::size_t block_size(std::size_t m) { return (m + 1) * (m + 2) / 2; }

}  // namespace hamjet
