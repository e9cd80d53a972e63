#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// The polynomial `u` in a space of another order with the same number of variables: terms above
/// that order are dropped, and terms that `u` lacks are zero. Throws Error(usage) for another
/// number of variables.
template <class T>
Series<T> in_space(const Series<T>& u, const SpacePointer& space) {
  if (u.space().variables() != space->variables()) {
    throw Error(ErrorKind::usage, "series: the other space has another number of variables");
  }
  Series<T> result(space);
  std::copy_n(u.coefficients().data(), std::min(u.size(), space->size()),
              result.coefficients().data());
  return result;
}

/// Partial derivative with respect to x_i. It is exact up to degree N-1; a truncated series does
/// not know the slice of degree N, which is left zero.
template <class T>
Series<T> derivative(const Series<T>& u, std::size_t i) {
  const SeriesSpace& space = u.space();
  Series<T> result(u.space_pointer());
  const auto raised = space.raised(i);
  for (std::size_t k = 0; k < raised.size(); ++k) {
    result[k] = u[raised[k]] * T(static_cast<double>(space.exponents(k)[i] + 1));
  }
  return result;
}

/// Antiderivative with respect to x_i, without terms that are free of x_i. The slice of degree N of
/// `u` would give degree N+1 and is dropped.
template <class T>
Series<T> integral(const Series<T>& u, std::size_t i) {
  const SeriesSpace& space = u.space();
  Series<T> result(u.space_pointer());
  const auto raised = space.raised(i);
  for (std::size_t k = 0; k < raised.size(); ++k) {
    result[raised[k]] = u[k] / T(static_cast<double>(space.exponents(k)[i] + 1));
  }
  return result;
}

/// Poisson bracket {f, g} = sum over i of df/dq_i dg/dp_i - df/dp_i dg/dq_i, the space's variables
/// being (q_1..q_n, p_1..p_n). Exact up to degree N-1; degree N is left zero. Throws Error(usage)
/// for two spaces or an odd number of variables.
template <class T>
Series<T> poisson_bracket(const Series<T>& f, const Series<T>& g) {
  require_same_space(f.space(), g.space());
  const std::size_t variables = f.space().variables();
  if (variables % 2 != 0) {
    throw Error(ErrorKind::usage, "Poisson bracket: the number of variables is odd");
  }
  const std::size_t n = variables / 2;
  Series<T> result(f.space_pointer());
  for (std::size_t i = 0; i < n; ++i) {
    result += derivative(f, i) * derivative(g, n + i);
    result -= derivative(f, n + i) * derivative(g, i);
  }
  for (auto& c : result.slice(f.order())) c = T(0);
  return result;
}

/// The value of a series at a point: sum over monomials of coefficient times powers, from the
/// highest degree down, so that small terms are not lost. Throws Error(usage) unless the point has
/// one number per variable.
template <class T>
T evaluate(const Series<T>& u, std::span<const T> point) {
  const SeriesSpace& space = u.space();
  if (point.size() != space.variables()) {
    throw Error(ErrorKind::usage, "evaluate: the point has not one number per variable");
  }
  std::vector<std::vector<T>> powers(point.size());
  for (std::size_t i = 0; i < point.size(); ++i) {
    powers[i].assign(static_cast<std::size_t>(space.order()) + 1, T(1));
    for (std::size_t e = 1; e < powers[i].size(); ++e) powers[i][e] = powers[i][e - 1] * point[i];
  }
  T sum(0);
  for (std::size_t k = space.size(); k-- > 0;) {
    const auto exponents = space.exponents(k);
    T term = u[k];
    for (std::size_t i = 0; i < point.size(); ++i) {
      if (exponents[i] > 0) term *= powers[i][exponents[i]];
    }
    sum += term;
  }
  return sum;
}

}  // namespace hamjet
