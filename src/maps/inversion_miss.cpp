#include "inversion_miss.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "../algebra/instantiated_real.hpp"

namespace hamjet {
namespace {

/// A polynomial in s: its coefficients of s^0..s^N.
template <class T>
using Polynomial = std::vector<T>;

/// A polynomial, and for each coefficient the sum of the absolute values of its terms.
template <class T>
struct Sums {
  Polynomial<T> value;
  std::vector<double> terms;

  explicit Sums(int order)
      : value(static_cast<std::size_t>(order) + 1, T(0)),
        terms(static_cast<std::size_t>(order) + 1, 0) {}

  void add(std::size_t degree, const T& term) {
    value[degree] += term;
    terms[degree] += std::abs(static_cast<double>(term));
  }
};

/// For every monomial, the monomial of one degree less from which it is made, and the variable of
/// the factor.
struct Parents {
  std::vector<std::size_t> parent;
  std::vector<std::size_t> variable;

  explicit Parents(const SeriesSpace& space) : parent(space.size()), variable(space.size()) {
    for (std::size_t k = 1; k < space.size(); ++k) {
      const auto given = space.exponents(k);
      std::vector<std::uint8_t> exponents(given.begin(), given.end());
      std::size_t v = 0;
      while (exponents[v] == 0) ++v;
      --exponents[v];
      variable[k] = v;
      parent[k] = space.index(exponents);
    }
  }
};

/// Evaluates series along a line: each variable is replaced by a polynomial without constant term.
/// The constant terms of the series are left out.
template <class T>
std::vector<Sums<T>> along_line(const std::vector<const Series<T>*>& series, const Parents& parents,
                                const std::vector<Polynomial<T>>& line) {
  const SeriesSpace& space = series[0]->space();
  const auto order = static_cast<std::size_t>(space.order());
  std::vector<Sums<T>> result(series.size(), Sums<T>(space.order()));
  // Along the line a monomial of degree d begins at s^d, so that only the coefficients from there
  // on are kept.
  std::vector<T> kept;
  std::vector<std::size_t> first(space.size());
  for (std::size_t k = 1; k < space.size(); ++k) {
    const auto degree = static_cast<std::size_t>(space.degree(k));
    const Polynomial<T>& factor = line[parents.variable[k]];
    first[k] = kept.size();
    kept.resize(kept.size() + order - degree + 1, T(0));
    T* monomial = kept.data() + first[k];
    if (degree == 1) {
      std::copy_n(factor.data() + 1, order, monomial);
    } else {
      const T* parent = kept.data() + first[parents.parent[k]];
      for (std::size_t i = 0; i + degree <= order; ++i) {
        for (std::size_t j = 1; i + j + degree <= order + 1; ++j) {
          monomial[i + j - 1] += parent[i] * factor[j];
        }
      }
    }
    for (std::size_t c = 0; c < series.size(); ++c) {
      const T& coefficient = (*series[c])[k];
      if (coefficient == T(0)) continue;
      for (std::size_t d = degree; d <= order; ++d) {
        result[c].add(d, T(coefficient * monomial[d - degree]));
      }
    }
  }
  return result;
}

/// A direction whose components have sizes between 1/2 and 1, so that none is lost beside the
/// others.
std::vector<double> direction(std::size_t size) {
  std::mt19937_64 generator(1);
  std::vector<double> result;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint64_t bits = generator();
    const double magnitude = 0.5 + static_cast<double>(bits >> 12) * 0x1p-53;
    result.push_back((bits & 1) == 0 ? magnitude : -magnitude);
  }
  return result;
}

/// The largest |found - expected|, scaled as described at inversion_miss.
template <class T>
double largest_difference(const Sums<T>& found, const Sums<T>& expected) {
  double result = 0;
  double scale = 0;
  for (std::size_t d = 1; d < found.value.size(); ++d) {
    const double difference = std::abs(static_cast<double>(T(found.value[d] - expected.value[d])));
    scale = std::max({scale, found.terms[d], expected.terms[d]});
    // A NaN must not be lost in a maximum.
    if (!std::isfinite(difference) || !std::isfinite(scale)) {
      return std::numeric_limits<double>::infinity();
    }
    if (difference > 0) result = std::max(result, difference / scale);
  }
  return result;
}

}  // namespace

template <class T>
double inversion_miss(const std::vector<Series<T>>& jet, const PartialInversion<T>& inversion) {
  const GeneratingFunctionKind& kind = inversion.kind;
  const std::size_t n = kind.degrees_of_freedom();
  const int order = jet[0].order();
  const Parents parents(jet[0].space());
  const std::vector<double> u = direction(2 * n);
  std::vector<Polynomial<T>> w(2 * n, Polynomial<T>(static_cast<std::size_t>(order) + 1, T(0)));
  for (std::size_t i = 0; i < 2 * n; ++i) w[i][1] = T(u[i]);

  std::vector<const Series<T>*> inverted;
  for (const auto& series : inversion.remaining_initial) inverted.push_back(&series);
  for (const auto& series : inversion.remaining_final) inverted.push_back(&series);
  const std::vector<Sums<T>> remaining = along_line(inverted, parents, w);

  std::vector<Polynomial<T>> initial(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    initial[kind.initial_variable(i)] = w[n + i];
    initial[kind.initial_variable(i, false)] = remaining[i].value;
  }
  std::vector<const Series<T>*> final_variables;
  for (std::size_t i = 0; i < n; ++i) final_variables.push_back(&jet[kind.final_variable(i)]);
  for (std::size_t i = 0; i < n; ++i) {
    final_variables.push_back(&jet[kind.final_variable(i, false)]);
  }
  const std::vector<Sums<T>> mapped = along_line(final_variables, parents, initial);

  double result = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Sums<T> chosen(order);
    chosen.add(1, w[i][1]);
    result = std::max(result, largest_difference(mapped[i], chosen));
    result = std::max(result, largest_difference(mapped[n + i], remaining[n + i]));
  }
  return result;
}

template double inversion_miss(const std::vector<Series<InstantiatedReal>>&,
                               const PartialInversion<InstantiatedReal>&);

}  // namespace hamjet
