#include "gauss_tableau.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// P_0..P_s at x, by k P_k = (2k-1) x P_(k-1) - (k-1) P_(k-2). `inverse[k]` is 1/k, because
/// divisions are slow in extended precision.
template <class Real>
std::vector<Real> legendre(const Real& x, const std::vector<Real>& inverse) {
  std::vector<Real> p(inverse.size(), Real(1));
  if (p.size() > 1) p[1] = x;
  for (std::size_t k = 2; k < p.size(); ++k) {
    const Real product = x * p[k - 1];
    p[k] = product + (1 - inverse[k]) * (product - p[k - 2]);
  }
  return p;
}

template <class Real>
std::vector<Real> inverses(std::size_t largest) {
  std::vector<Real> result(largest + 1, Real(0));
  for (std::size_t k = 1; k <= largest; ++k) result[k] = 1 / Real(static_cast<double>(k));
  return result;
}

/// P_s'(x) from P_s and P_(s-1).
template <class Real>
Real legendre_derivative(const std::vector<Real>& p, const Real& x) {
  const std::size_t s = p.size() - 1;
  return Real(static_cast<double>(s)) * (x * p[s] - p[s - 1]) / (x * x - 1);
}

template <class Real>
Real newton_step(const Real& x, const std::vector<Real>& inverse) {
  const std::vector<Real> p = legendre(x, inverse);
  return x - p.back() / legendre_derivative(p, x);
}

/// The i-th zero of P_s, counted from the largest one; for positive zeros.
Extended legendre_zero(std::size_t s, std::size_t i, const std::vector<Extended>& inverse) {
  const std::vector<double> inverse_double = inverses<double>(s);
  double x =
      std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (static_cast<double>(s) + 0.5));
  // Newton's method doubles the number of digits: the asymptotic guess has 3, binary64 gives 16,
  // and two more steps give 34.
  for (int step = 0; step < 4; ++step) x = newton_step(x, inverse_double);
  return newton_step(newton_step(Extended(x), inverse), inverse);
}

constexpr std::size_t most_stages = 16;

GaussTableau compute_tableau(std::size_t s) {
  GaussTableau tableau;
  tableau.stages = s;
  tableau.nodes.resize(s);
  tableau.weights.resize(s);
  tableau.modes.resize(s * s);
  tableau.matrix.resize(s * s);
  tableau.squared.resize(s * s, 0);
  const std::vector<Extended> inverse = inverses<Extended>(s);
  std::vector<std::vector<Extended>> p(s);  // P_0..P_s at the nodes on [-1, 1]
  for (std::size_t i = 0; i < s; ++i) {
    // The zeros lie symmetrically, and the middle one of an odd number of zeros is 0.
    const std::size_t rank = std::min(i, s - 1 - i);
    Extended x = 2 * i + 1 == s ? Extended(0) : legendre_zero(s, rank, inverse);
    if (2 * i + 1 < s) x = -x;
    p[i] = legendre(x, inverse);
    const Extended derivative = legendre_derivative(p[i], x);
    tableau.nodes[i] = (1 + x) / 2;
    tableau.weights[i] = 1 / ((1 - x * x) * derivative * derivative);
    for (std::size_t k = 0; k < s; ++k) {
      tableau.modes[k * s + i] = Extended(2 * k + 1) * tableau.weights[i] * p[i][k];
    }
  }
  // l_j(c) = b_j sum_k (2k+1) P_k(c_j) P_k(c), where P_k is shifted to [0, 1]; the integral of P_k
  // from 0 to c is (P_(k+1) - P_(k-1)) / (2 (2k+1)).
  for (std::size_t i = 0; i < s; ++i) {
    std::vector<Extended> integral(s, tableau.nodes[i]);
    for (std::size_t k = 1; k < s; ++k) integral[k] = (p[i][k + 1] - p[i][k - 1]) / 2;
    for (std::size_t j = 0; j < s; ++j) {
      Extended sum = integral[0];
      for (std::size_t k = 1; k < s; ++k) sum += p[j][k] * integral[k];
      tableau.matrix[i * s + j] = tableau.weights[j] * sum;
    }
  }
  tableau.lagrange.resize(s);
  tableau.start.resize(s);
  for (std::size_t j = 0; j < s; ++j) {
    Extended product = 1;
    Extended at_start = 1;
    for (std::size_t k = 0; k < s; ++k) {
      if (k == j) continue;
      product *= tableau.nodes[j] - tableau.nodes[k];
      at_start *= -tableau.nodes[k];
    }
    tableau.lagrange[j] = 1 / product;
    tableau.start[j] = at_start * tableau.lagrange[j];
  }
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t j = 0; j < s; ++j) {
      for (std::size_t k = 0; k < s; ++k) {
        tableau.squared[i * s + j] += tableau.a(i, k) * tableau.a(k, j);
      }
    }
  }
  return tableau;
}

}  // namespace

const GaussTableau& gauss_tableau(std::size_t stages) {
  if (stages < 1 || stages > most_stages) {
    throw Error(ErrorKind::usage, "Gauss method: the number of stages must be 1..16");
  }
  // These mathematical constants are computed at the first request, which takes longer than a step.
  static std::array<std::once_flag, most_stages + 1> is_computed;
  static std::array<GaussTableau, most_stages + 1> tableaux;
  std::call_once(is_computed[stages], [&] { tableaux[stages] = compute_tableau(stages); });
  return tableaux[stages];
}

}  // namespace hamjet
