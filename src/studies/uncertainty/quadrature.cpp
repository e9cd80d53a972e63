#include "quadrature.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "../../algebra/symmetric_eigenvalues.hpp"

namespace hamjet {
namespace {

/// The rule that belongs to the recurrence of orthonormal polynomials.
NormalQuadrature rule_of_recurrence(const Matrix<double>& recurrence) {
  const auto solver = symmetric_eigenvalues("quadrature", recurrence);
  return {solver.eigenvalues().transpose(), solver.eigenvectors().row(0).transpose().cwiseAbs2()};
}

NormalQuadrature hermite_rule(int n) {
  Matrix<double> recurrence = Matrix<double>::Zero(n, n);
  for (int k = 1; k < n; ++k) {
    recurrence(k, k - 1) = recurrence(k - 1, k) = std::sqrt(static_cast<double>(k));
  }
  return rule_of_recurrence(recurrence);
}

/// A fine rule for the density within an interval, with weights that sum up to 1.
NormalQuadrature fine_rule(const NormalInterval& interval) {
  using Legendre = boost::math::quadrature::gauss<double, 30>;
  constexpr int panels = 4;
  constexpr double far_out = 9;  // the density beyond it is below rounding
  const double from = std::max(interval.from, -far_out);
  const double half = (std::min(interval.to, far_out) - from) / (2 * panels);
  const auto& places = Legendre::abscissa();
  const auto& weights = Legendre::weights();
  const auto each = static_cast<Eigen::Index>(2 * places.size());
  NormalQuadrature result{Matrix<double>(1, panels * each), Vector<double>(panels * each)};
  Eigen::Index next = 0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = from + (2 * panel + 1) * half;
    for (std::size_t k = 0; k < places.size(); ++k) {
      for (const double side : {-1.0, 1.0}) {
        const double x = middle + side * half * places[k];
        result.points(0, next) = x;
        result.weights[next++] = weights[k] * std::exp(-x * x / 2);
      }
    }
  }
  result.weights /= result.weights.sum();
  return result;
}

NormalQuadrature interval_rule(int n, const NormalInterval& interval) {
  const NormalQuadrature fine = fine_rule(interval);
  const Vector<double> x = fine.points.row(0).transpose();
  Matrix<double> recurrence = Matrix<double>::Zero(n, n);
  Vector<double> before = Vector<double>::Zero(x.size());
  Vector<double> current = Vector<double>::Ones(x.size());
  double norm = 0;
  for (int k = 0; k < n; ++k) {
    const Vector<double> weighted = fine.weights.cwiseProduct(current);
    recurrence(k, k) = weighted.cwiseProduct(current).dot(x);
    if (k + 1 == n) break;
    Vector<double> next = x.cwiseProduct(current) - recurrence(k, k) * current - norm * before;
    norm = std::sqrt(fine.weights.dot(next.cwiseAbs2()));
    recurrence(k + 1, k) = recurrence(k, k + 1) = norm;
    before = std::move(current);
    current = next / norm;
  }
  return rule_of_recurrence(recurrence);
}

NormalQuadrature product_of(const std::vector<NormalQuadrature>& rules) {
  NormalQuadrature result{Matrix<double>(0, 1), Vector<double>::Ones(1)};
  for (const NormalQuadrature& rule : rules) {
    const Eigen::Index n = rule.weights.size();
    const Eigen::Index count = result.weights.size();
    NormalQuadrature next{Matrix<double>(result.points.rows() + 1, count * n),
                          Vector<double>(count * n)};
    for (Eigen::Index k = 0; k < n; ++k) {
      next.points.block(0, k * count, result.points.rows(), count) = result.points;
      next.points.block(result.points.rows(), k * count, 1, count).setConstant(rule.points(0, k));
      next.weights.segment(k * count, count) = rule.weights[k] * result.weights;
    }
    result = std::move(next);
  }
  return result;
}

}  // namespace

double NormalInterval::probability() const {
  // From the nearer tail, so that no digits are lost.
  const double low = from > 0 ? -to : from;
  const double high = from > 0 ? -from : to;
  return (std::erfc(-high / std::numbers::sqrt2) - std::erfc(-low / std::numbers::sqrt2)) / 2;
}

NormalQuadrature product_quadrature(const std::vector<int>& nodes) {
  std::vector<NormalQuadrature> rules;
  for (const int n : nodes) rules.push_back(hermite_rule(n));
  return product_of(rules);
}

NormalQuadrature product_quadrature(const std::vector<int>& nodes,
                                    const std::vector<NormalInterval>& intervals) {
  std::vector<NormalQuadrature> rules;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool is_whole = std::isinf(intervals[i].from) && std::isinf(intervals[i].to);
    rules.push_back(is_whole ? hermite_rule(nodes[i]) : interval_rule(nodes[i], intervals[i]));
  }
  return product_of(rules);
}

}  // namespace hamjet
