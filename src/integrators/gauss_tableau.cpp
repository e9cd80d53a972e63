#include "hamjet/integrators/gauss_tableau.hpp"

#include <cmath>
#include <numbers>

#include "hamjet/error.hpp"

namespace hamjet {

namespace {

template <class Real>
std::vector<Real> legendre_values(const Real& x, std::size_t count) {
  std::vector<Real> p(count, Real(1));
  if (count > 1) p[1] = x;
  for (std::size_t k = 2; k < count; ++k) {
    const Real n(static_cast<double>(k));
    p[k] = ((2 * n - 1) * x * p[k - 1] - (n - 1) * p[k - 2]) / n;
  }
  return p;
}

/// P_s'(x), from P_s and P_(s-1).
template <class Real>
Real legendre_derivative(const std::vector<Real>& p, const Real& x) {
  const std::size_t s = p.size() - 1;
  return Real(static_cast<double>(s)) * (x * p[s] - p[s - 1]) / (x * x - 1);
}

template <class Real>
Real newton_step(const Real& x, std::size_t s) {
  const std::vector<Real> p = legendre_values(x, s + 1);
  return x - p[s] / legendre_derivative(p, x);
}

/// The i-th zero of P_s, i = 0..s-1, from the largest down.
Extended legendre_zero(std::size_t s, std::size_t i) {
  if (2 * i + 1 == s) return 0;
  double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) /
                      (static_cast<double>(s) + 0.5));
  // Newton doubles the digits: the asymptotic guess has 3, binary64 gives 16, two more steps 34.
  for (int step = 0; step < 4; ++step) x = newton_step(x, s);
  return newton_step(newton_step(Extended(x), s), s);
}

}  // namespace

std::vector<Extended> legendre(const Extended& x, std::size_t count) {
  return legendre_values(x, count);
}

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
    const Extended x = legendre_zero(s, s - 1 - i);
    const Extended derivative = legendre_derivative(legendre_values(x, s + 1), x);
    tableau.nodes[i] = (1 + x) / 2;
    tableau.weights[i] = 1 / ((1 - x * x) * derivative * derivative);
  }
  // l_j(c) = b_j sum_k (2k+1) P_k(c_j) P_k(c) with P_k shifted to [0, 1], and the integral of P_k
  // from 0 to c is (P_(k+1) - P_(k-1)) / (2 (2k+1)).
  std::vector<std::vector<Extended>> p;
  for (const Extended& node : tableau.nodes) p.push_back(legendre(2 * node - 1, s + 1));
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t j = 0; j < s; ++j) {
      Extended sum = tableau.nodes[i];
      for (std::size_t k = 1; k < s; ++k) sum += p[j][k] * (p[i][k + 1] - p[i][k - 1]) / 2;
      tableau.matrix[i * s + j] = tableau.weights[j] * sum;
    }
  }
  return tableau;
}

}  // namespace hamjet
