
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
      : inner_(inner), space_(inner[0].space()), degree_(degree), highest_(highest) {
    for (const Series<T>& y : inner) is_linear_.push_back(is_linear(y));
    for (std::size_t i = 0; i < space_.variables(); ++i) {
      raised_.push_back(space_.raised(i).data());
    }
    std::array<const T*, Lanes> components;
    for (std::size_t i = 0; i < Lanes; ++i) {
      components[i] = outer[std::min(i, outer.size() - 1)].coefficients().data();
    }
    coefficients_.reserve(outer[0].space().first(degree + 1));
    for (std::size_t k = 0; k < outer[0].space().first(degree + 1); ++k) {
      coefficients_.push_back(P::of_lanes([&](std::size_t i) { return components[i][k]; }));
    }
    std::size_t size = 0;
    for (int k = 0; k <= degree; ++k) {
      places_.push_back({size, outer[0].space().first(k)});
      size += space_.first(highest - k + 1);
    }
    nodes_.resize(size);
  }

  void run(std::span<Series<T>> result) {
    form_node(0, 0);
    for (std::size_t i = 0; i < result.size(); ++i) {
      for (std::size_t k = 0; k < space_.first(highest_ + 1); ++k) {
        result[i][k] = nodes_[k].lane(static_cast<int>(i));
      }
    }
  }

 private:
  /// Forms the node of the next monomial of degree `depth`, and returns it. A node's children are
  /// the monomials times a variable not before its last one. So the words of variables grow at
  /// their ends, and a walk depth first meets each degree's monomials in the order of the space.
  const P* form_node(int depth, std::size_t last_variable) {
    Place& place = places_[static_cast<std::size_t>(depth)];
    P* const node = nodes_.data() + place.node;
    node[0] = coefficients_[place.next_monomial++];
    if (depth == degree_) return node;
    const int highest = highest_ - depth;  // degree that the node needs
    const std::size_t size = space_.first(highest + 1);
    std::fill(node + 1, node + size, P(T(0)));
    for (std::size_t v = last_variable; v < inner_.size(); ++v) {
      const P* const child = form_node(depth + 1, v);
      const bool is_constant = depth + 1 == degree_;
      const T* const y = inner_[v].coefficients().data();
      if (is_linear_[v] != 0) {
        add_linear_product(is_constant ? 1 : space_.first(highest), child, y, node);
        continue;
      }
      const P constant = child[0];
      for (std::size_t k = 1; k < size; ++k) node[k] += constant * P(y[k]);
      if (is_constant) continue;
      for (int d = 2; d <= highest; ++d) add_interior_product(space_, d, child, y, node);
    }
    return node;
  }

  /// node += child times y for the first coefficients of the child and the linear part of y, of
  /// which little may be there, as of a single variable.
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

  struct Place {
    std::size_t node;           ///< in nodes_, of the node that is being formed
    std::size_t next_monomial;  ///< in coefficients_
  };

  std::span<const Series<T>> inner_;
  const SeriesSpace& space_;
  int degree_;                                ///< of the outer map
  int highest_;                               ///< degree of the result that is formed
  std::vector<char> is_linear_;               ///< by inner series
  std::vector<const std::uint32_t*> raised_;  ///< by variable, see SeriesSpace
  std::vector<P> coefficients_;
  std::vector<Place> places_;  ///< by depth
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
      // Scalars in the place of vectors gain nothing from more lanes.
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
