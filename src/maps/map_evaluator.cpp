#include "hamjet/maps/map_evaluator.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <type_traits>
#include <utility>

#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The number of components that are evaluated together: those of a state in space, whose sums fill
/// the registers.
constexpr std::size_t group_size = 6;

constexpr int native_width = Pack<double, 16>::width;
/// The number of vectors in a block of points; each coefficient is loaded once for the whole block.
/// With AVX-512 there are 32 registers for the sums (6 x 3) and operands, otherwise 16 (6 x 2).
constexpr int vectors = native_width == 8 ? 3 : 2;
constexpr int block_points = vectors * native_width;
using Block = Pack<double, block_points>;

/// Number of monomials of exactly this degree in `variables` variables.
std::size_t monomials_of_degree(std::size_t variables, int degree) {
  std::size_t result = 1;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(degree); ++i) {
    result = result * (variables - 1 + i) / i;
  }
  return variables == 0 && degree > 0 ? 0 : result;
}

/// counts[d * variables + i]: monomials of degree d in the variables x_i, x_i+1, ... . In the order
/// of SeriesSpace those of degree d+1 that begin with x_i are x_i times these, one after the other.
std::vector<std::size_t> tail_counts(std::size_t variables, int degree) {
  std::vector<std::size_t> counts;
  for (int d = 0; d <= degree; ++d) {
    for (std::size_t i = 0; i < variables; ++i) {
      counts.push_back(monomials_of_degree(variables - i, d));
    }
  }
  return counts;
}

/// The storage on which the kernels work, for one block of points.
struct Work {
  std::size_t variables;
  int degree;
  const std::size_t* tails;  ///< see tail_counts
  const double* coefficients;
  const Block* x;    ///< the variables
  Block* monomials;  ///< monomials of degree 1..N-1, one after the other
  Block* shares;  ///< share of degree d = 0..N and component c of the group, at d * group_size + c
};

/// Calls `action` with 0, ..., Count - 1 as compile-time constants. A loop would be unrolled too
/// late for the compiler to keep the indexed arrays in registers.
template <std::size_t Count, class Action>
void unrolled(const Action& action) {
  [&]<std::size_t... Index>(std::index_sequence<Index...>) {
    (action(std::integral_constant<std::size_t, Index>()), ...);
  }
  (std::make_index_sequence<Count>());
}

/// One sum for each component and each vector of a block.
template <std::size_t Components>
using BlockSums = std::array<Block::Vector, Components * vectors>;

/// Adds up the terms x p over the parents p from `parent` to `end`; stores the monomials if
/// `Stored` is set. Returns the place of the next coefficients.
template <std::size_t Components, bool Stored>
const double* add_terms(const Block& x, const Block* parent, const Block* end, const double* a,
                        Block*& stored, BlockSums<Components>& sums) {
  for (; parent != end; ++parent, a += Components) {
    BlockSums<1> m;
    unrolled<vectors>([&](auto v) {
      m[v] = x.part[v] * parent->part[v];
      if constexpr (Stored) stored->part[v] = m[v];
    });
    if constexpr (Stored) ++stored;
    unrolled<Components>([&](auto c) {
      const Block::Vector coefficient(a[c]);
      unrolled<vectors>([&](auto v) { sums[c * vectors + v] += coefficient * m[v]; });
    });
  }
  return a;
}

/// Evaluates the share of one degree in the values, for the monomials x_i p of all parents p.
template <std::size_t Components, bool Stored>
const double* evaluate_degree(const Work& work, const std::size_t* tails, const Block* parents_end,
                              const double* a, Block*& stored, Block* share) {
  BlockSums<Components> sums;
  unrolled<Components * vectors>([&](auto i) { sums[i] = 0; });
  for (std::size_t i = 0; i < work.variables; ++i) {
    a = add_terms<Components, Stored>(work.x[i], parents_end - tails[i], parents_end, a, stored,
                                      sums);
  }
  unrolled<Components>([&](auto c) {
    unrolled<vectors>([&](auto v) { share[c].part[v] = sums[c * vectors + v]; });
  });
  return a;
}

/// Evaluates the shares of all degrees in the values of one group of components.
template <std::size_t Components>
void evaluate_block(const Work& work) {
  const double* a = work.coefficients;
  for (std::size_t c = 0; c < Components; ++c) work.shares[c] = Block(a[c]);
  a += Components;
  const Block one(1.0);
  const Block* parents_end = &one + 1;
  Block* stored = work.monomials;
  for (int d = 1; d <= work.degree; ++d) {
    const std::size_t* tails = work.tails + static_cast<std::size_t>(d - 1) * work.variables;
    Block* share = work.shares + static_cast<std::size_t>(d) * group_size;
    a = d < work.degree
            ? evaluate_degree<Components, true>(work, tails, parents_end, a, stored, share)
            : evaluate_degree<Components, false>(work, tails, parents_end, a, stored, share);
    parents_end = stored;
  }
}

using Kernel = void (*)(const Work&);

template <std::size_t... Index>
constexpr std::array<Kernel, group_size> make_kernels(std::index_sequence<Index...>) {
  return {&evaluate_block<Index + 1>...};
}

/// Kernels for 1..6 components; the kernel for c components has the index c - 1.
constexpr std::array<Kernel, group_size> kernels =
    make_kernels(std::make_index_sequence<group_size>());

Block load(const double* from, std::size_t count) {
  Block result;
  if (count == block_points) {
    for (std::size_t v = 0; v < vectors; ++v) {
      result.part[v].copy_from(from + v * native_width, std::experimental::element_aligned);
    }
  } else {
    // The other lanes are set to zero, and their results are not stored.
    for (std::size_t i = 0; i < count; ++i) result.set_lane(static_cast<int>(i), from[i]);
  }
  return result;
}

void store(const Block& block, double* to, std::size_t count) {
  if (count == block_points) {
    for (std::size_t v = 0; v < vectors; ++v) {
      block.part[v].copy_to(to + v * native_width, std::experimental::element_aligned);
    }
  } else {
    for (std::size_t i = 0; i < count; ++i) to[i] = block.lane(static_cast<int>(i));
  }
}

std::size_t group_at(std::size_t first, std::size_t components) {
  return std::min(group_size, components - first);
}

}  // namespace

MapEvaluator::MapEvaluator(const std::vector<Series<double>>& map, std::optional<int> degree) {
  if (map.empty()) throw Error(ErrorKind::usage, "map evaluator: the map has no components");
  const SeriesSpace& space = map[0].space();
  for (const Series<double>& component : map) require_same_space(space, component.space());
  variables_ = space.variables();
  components_ = map.size();
  degree_ = degree.value_or(space.order());
  if (degree_ < 0 || degree_ > space.order()) {
    throw Error(ErrorKind::usage, "map evaluator: the degree must be 0 to the order of the map");
  }
  monomials_ = space.first(degree_ + 1);
  coefficients_.reserve(components_ * monomials_);
  for (std::size_t first = 0; first < components_; first += group_size) {
    const std::size_t group = group_at(first, components_);
    for (std::size_t k = 0; k < monomials_; ++k) {
      for (std::size_t c = first; c < first + group; ++c) coefficients_.push_back(map[c][k]);
    }
  }
}

void MapEvaluator::evaluate(std::span<const double> points, const MapValues& results) const {
  const std::size_t count = points.size() / variables_;
  const auto fits = [&](std::span<double> result) {
    return result.empty() || result.size() == count * components_;
  };
  if (points.size() != count * variables_ || !fits(results.values) || !fits(results.last) ||
      !fits(results.last_but_one) || !fits(results.last_but_two)) {
    throw Error(ErrorKind::usage, "map evaluator: the sizes of points and values do not fit");
  }
  const auto degrees = static_cast<std::size_t>(degree_) + 1;
  const std::vector<std::size_t> tails = tail_counts(variables_, degree_);
  std::size_t stored = 0;  // monomials of degree 1..N-1
  for (int d = 1; d < degree_; ++d) stored += tails[static_cast<std::size_t>(d) * variables_];
  std::vector<Block> scratch(variables_ + stored + degrees * group_size);
  Block* const x = scratch.data();
  Block* const shares = x + variables_ + stored;
  const auto share = [&](std::size_t d, std::size_t c) -> const Block& {
    return shares[d * group_size + c];
  };
  for (std::size_t j = 0; j < count; j += block_points) {
    const std::size_t here = std::min<std::size_t>(block_points, count - j);
    for (std::size_t i = 0; i < variables_; ++i) x[i] = load(&points[i * count + j], here);
    for (std::size_t first = 0; first < components_; first += group_size) {
      const std::size_t group = group_at(first, components_);
      kernels[group - 1]({variables_, degree_, tails.data(),
                          coefficients_.data() + first * monomials_, x, x + variables_, shares});
      for (std::size_t c = 0; c < group; ++c) {
        const std::size_t place = (first + c) * count + j;
        if (!results.values.empty()) {
          Block sum = share(degrees - 1, c);
          for (std::size_t d = degrees - 1; d-- > 0;) sum += share(d, c);
          store(sum, &results.values[place], here);
        }
        const std::span<double> highest[] = {results.last, results.last_but_one,
                                             results.last_but_two};
        for (std::size_t k = 0; k < std::size(highest); ++k) {
          if (highest[k].empty()) continue;
          store(degrees > k ? share(degrees - 1 - k, c) : Block(), &highest[k][place], here);
        }
      }
    }
  }
}

std::size_t MapEvaluator::multiply_adds_per_point() const noexcept {
  return components_ * (monomials_ - 1);
}

std::size_t MapEvaluator::products_per_point() const noexcept {
  return degree_ < 1 ? 0 : monomials_ - 1 - variables_;
}

}  // namespace hamjet
