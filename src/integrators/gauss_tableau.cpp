#include "hamjet/integrators/gauss_tableau.hpp"

#include <cmath>
#include <numbers>

#include "hamjet/error.hpp"

namespace hamjet {

std::vector<Extended> legendre(const Extended& x, std::size_t count) {
  std::vector<Extended> p(count, 1);
  if (count > 1) p[1] = x;
  for (std::size_t k = 2; k < count; ++k) {
    const Extended n(k);
    p[k] = ((2 * n - 1) * x * p[k - 1] - (n - 1) * p[k - 2]) / n;
  }
  return p;
}

namespace {

/// The i-th zero of P_s, by Newton from the asymptotic formula, in falling order for i = 0..s-1.
Extended legendre_zero(std::size_t s, std::size_t i, Extended& derivative) {
  const double guess = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) /
                                (static_cast<double>(s) + 0.5));
  Extended x(guess);
  // Quadratic convergence from a guess good to 1e-3: five steps reach 34 digits, the sixth polishes.
  for (int step = 0; step < 6; ++step) {
    const std::vector<Extended> p = legendre(x, s + 1);
    derivative = Extended(s) * (x * p[s] - p[s - 1]) / (x * x - 1);
    x -= p[s] / derivative;
  }
  const std::vector<Extended> p = legendre(x, s + 1);
  derivative = Extended(s) * (x * p[s] - p[s - 1]) / (x * x - 1);
  return x;
}

}  // namespace

GaussTableau gauss_tableau(std::size_t stages) {
  if (stages < 1 || stages > 16) {
    throw Error(ErrorKind::usage, "Gauss method: the number of stages must be 1..16");
  }
  const std::size_t s = stages;
  GaussTableau tableau;
  tableau.stages = s;
  tableau.nodes.resize(s);
  tableau.weights.resize(s);
  tableau.matrix.resize(s * s);
  for (std::size_t i = 0; i < s; ++i) {
    Extended derivative = 1;
    const bool is_centre = 2 * i + 1 == s;
    Extended x = legendre_zero(s, s - 1 - i, derivative);
    if (is_centre) x = 0;
    tableau.nodes[i] = (1 + x) / 2;
    tableau.weights[i] = 1 / ((1 - x * x) * derivative * derivative);
  }
  // l_j(c) = b_j sum_k (2k+1) P_k(c_j) P_k(c) with P_k shifted to [0, 1], and the integral of P_k
  // from 0 to c is (P_(k+1) - P_(k-1)) / (2 (2k+1)).
  for (std::size_t i = 0; i < s; ++i) {
    const std::vector<Extended> at_i = legendre(2 * tableau.nodes[i] - 1, s + 1);
    for (std::size_t j = 0; j < s; ++j) {
      const std::vector<Extended> at_j = legendre(2 * tableau.nodes[j] - 1, s + 1);
      Extended sum = tableau.nodes[i];
      for (std::size_t k = 1; k < s; ++k) sum += at_j[k] * (at_i[k + 1] - at_i[k - 1]) / 2;
      tableau.matrix[i * s + j] = tableau.weights[j] * sum;
    }
  }
  return tableau;
}

}  // namespace hamjet
