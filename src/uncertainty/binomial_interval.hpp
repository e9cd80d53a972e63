#pragma once

#include <boost/math/distributions/binomial.hpp>
#include <utility>

namespace hamjet {

/// The interval of Clopper and Pearson for a probability, from the number of hits among the
/// samples. Source: C. J. Clopper and E. S. Pearson, Biometrika 26 (1934) 404.
inline std::pair<double, double> binomial_interval(long samples, long hits, double confidence) {
  using Binomial = boost::math::binomial_distribution<double>;
  const double tail = (1 - confidence) / 2;
  const auto n = static_cast<double>(samples), k = static_cast<double>(hits);
  return {Binomial::find_lower_bound_on_p(n, k, tail), Binomial::find_upper_bound_on_p(n, k, tail)};
}

}  // namespace hamjet
