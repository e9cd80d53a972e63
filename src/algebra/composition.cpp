
#include "hamjet/algebra/composition.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/detail/algebra/slice_product.hpp"
#include "instantiated_real.hpp"

namespace hamjet {
namespace {

/// The highest degree at which a coefficient is not zero.
template <class T>
int highest_degree(const std::vector<Series<T>>& map) {
  const SeriesSpace& space = map[0].space();
  for (int d = space.order(); d > 0; --d) {
    for (const Series<T>& component : map) {
      const auto slice = component.slice(d);
      if (std::any_of(slice.begin(), slice.end(), [](const T& x) { return x != T(0); })) return d;
    }
  }
  return 0;
}

/// Composes up to Lanes components of the outer map with the inner one.
template <class T, int Lanes>
class HornerScheme {
 public:
  using P = Pack<T, Lanes>;

  HornerScheme(std::span<const Series<T>> outer, std::span<const Series<T>> inner, int degree,
               int highest)
      : space_(inner[0].space()), degree_(degree), highest_(highest) {
    for (std::size_t i = 0; i < space_.variables(); ++i) {
      raised_.push_back(space_.raised(i).data());
    }
    const SeriesSpace& of_outer = outer[0].space();
    factors_.reserve(inner.size());
    // Linear factors come last, because most nodes multiply by the last factors.
    for (const bool takes_linear : {false, true}) {
      for (std::size_t v = 0; v < inner.size(); ++v) {
        if (is_linear(inner[v]) != takes_linear) continue;
        factors_.push_back({inner[v].coefficients().data(),
                            degree > 0 ? of_outer.raised(v).data() : nullptr, takes_linear});
      }
    }
    std::array<const T*, Lanes> components;
    for (std::size_t i = 0; i < Lanes; ++i) {
      components[i] = outer[std::min(i, outer.size() - 1)].coefficients().data();
    }
    coefficients_.reserve(of_outer.first(degree + 1));
    for (std::size_t k = 0; k < of_outer.first(degree + 1); ++k) {
      coefficients_.push_back(P::of_lanes([&](std::size_t i) { return components[i][k]; }));
    }
    std::size_t size = 0;
    for (int k = 0; k <= degree; ++k) {
      places_.push_back(size);
      size += space_.first(highest - k + 1);
    }
    nodes_.resize(size);
  }

  void run(std::span<Series<T>> result) {
    form_node(0, 0, 0);
    for (std::size_t i = 0; i < result.size(); ++i) {
      for (std::size_t k = 0; k < space_.first(highest_ + 1); ++k) {
        result[i][k] = nodes_[k].lane(static_cast<int>(i));
      }
    }
  }

 private:
  /// One of the inner series.
  struct Factor {
    const T* series;
    const std::uint32_t* raised;  ///< see SeriesSpace, of the outer map's variable
    bool is_linear;
  };

  /// Forms the node of a monomial of degree `depth`, and returns it. A node's children are the
  /// monomials times a variable, in the order of the factors not before its last one.
  const P* form_node(int depth, std::size_t monomial, std::size_t last_factor) {
    P* const node = nodes_.data() + places_[static_cast<std::size_t>(depth)];
    node[0] = coefficients_[monomial];
    if (depth == degree_) return node;
    const int highest = highest_ - depth;  // highest degree that the node needs
    const std::size_t size = space_.first(highest + 1);
    std::fill(node + 1, node + size, P(T(0)));
    for (std::size_t f = last_factor; f < factors_.size(); ++f) {
      const Factor& y = factors_[f];
      const P* const child = form_node(depth + 1, y.raised[monomial], f);
      const bool is_constant = depth + 1 == degree_;
      if (y.is_linear) {
        add_linear_product(is_constant ? 1 : space_.first(highest), child, y.series, node);
        continue;
      }
      const P constant = child[0];
      for (std::size_t k = 1; k < size; ++k) node[k] += constant * P(y.series[k]);
      if (is_constant) continue;
      for (int d = 2; d <= highest; ++d) add_interior_product(space_, d, child, y.series, node);
    }
    return node;
  }

  /// node += child times y, where only the first coefficients of the child are needed and y has a
  /// linear part of few terms, as a single variable has.
  void add_linear_product(std::size_t count, const P* child, const T* y, P* node) const {
    for (std::size_t i = 0; i < raised_.size(); ++i) {
      const T& coefficient = y[space_.linear_index(i)];
      if (coefficient == T(0)) continue;
      const P factor(coefficient);
      for (std::size_t k = 0; k < count; ++k) node[raised_[i][k]] += factor * child[k];
    }
  }

  static bool is_linear(const Series<T>& y) {
    const auto nonlinear = y.coefficients().subspan(y.space().first(std::min(2, y.order() + 1)));
    return std::all_of(nonlinear.begin(), nonlinear.end(), [](const T& x) { return x == T(0); });
  }

  const SeriesSpace& space_;
  int degree_;   ///< degree of the outer map
  int highest_;  ///< highest degree of the result that is formed
  std::vector<Factor> factors_;
  std::vector<const std::uint32_t*> raised_;  ///< by inner variable, see SeriesSpace::raised
  std::vector<P> coefficients_;               ///< coefficients of the outer map, by monomial
  std::vector<std::size_t> places_;           ///< places in nodes_, by depth
  std::vector<P> nodes_;
};

}  // namespace

namespace detail {

template <class T>
std::vector<Series<T>> compose_up_to(const std::vector<Series<T>>& outer,
                                     const std::vector<Series<T>>& inner, int highest) {
  const int degree = std::min(highest_degree(outer), highest);
  std::vector<Series<T>> result(outer.size(), Series<T>(inner[0].space_pointer()));
  const std::span<Series<T>> all(result);
  std::size_t done = 0;
  while (done < outer.size()) {
    const std::size_t left = outer.size() - done;
    const auto take = [&]<int Lanes>(std::integral_constant<int, Lanes>) {
      const std::size_t count = std::min<std::size_t>(left, Lanes);
      HornerScheme<T, Lanes>(std::span(outer).subspan(done, count), inner, degree, highest)
          .run(all.subspan(done, count));
      done += count;
    };
    if constexpr (!std::is_same_v<T, double>) {
      // Where scalars take the place of vectors, more lanes gain nothing.
      take(std::integral_constant<int, 2>{});
    } else if (left <= 2) {
      take(std::integral_constant<int, 2>{});
    } else if (left <= 4) {
      take(std::integral_constant<int, 4>{});
    } else {
      take(std::integral_constant<int, 8>{});
    }
  }
  return result;
}

}  // namespace detail

template <class T>
std::vector<Series<T>> compose(const std::vector<Series<T>>& outer,
                               const std::vector<Series<T>>& inner) {
  detail::require_composable(outer, inner);
  return detail::compose_up_to(outer, inner, inner[0].order());
}

template std::vector<Series<InstantiatedReal>> detail::compose_up_to(
    const std::vector<Series<InstantiatedReal>>&, const std::vector<Series<InstantiatedReal>>&,
    int);
template std::vector<Series<InstantiatedReal>> compose(
    const std::vector<Series<InstantiatedReal>>&, const std::vector<Series<InstantiatedReal>>&);

}  // namespace hamjet
