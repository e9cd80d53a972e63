#include <cmath>
#include <utility>

#include "hamjet/error.hpp"
#include "hamjet/uncertainty/polynomial_moments.hpp"
#include "turned_tensor.hpp"

namespace hamjet {

Cumulants Cumulants::of_mixture(std::span<const Cumulants> parts, const Vector<double>& weights) {
  if (parts.empty() || std::ssize(parts) != weights.size()) {
    throw Error(ErrorKind::usage, "moments: a weight for each part of a mixture is needed");
  }
  const Eigen::Index m = parts[0].size();
  Vector<double> mean = Vector<double>::Zero(m);
  Eigen::Index columns = weights.size();
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    mean += weights[i] * parts[static_cast<std::size_t>(i)].mean_;
    columns += parts[static_cast<std::size_t>(i)].rank();
  }
  // Uncorrelated: the variables of each part, and one for each part's own mean.
  Matrix<double> factor(m, columns);
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const Cumulants& part = parts[static_cast<std::size_t>(i)];
    factor.middleCols(column, part.rank()) = std::sqrt(weights[i]) * part.axes_;
    factor.col(column + part.rank()) = std::sqrt(weights[i]) * (part.mean_ - mean);
    column += part.rank() + 1;
  }
  Matrix<double> turn;
  Cumulants result = turned(mean, factor, turn);
  const Eigen::Index r = result.rank();
  const Matrix<double> one = Matrix<double>::Identity(r, r);
  column = 0;
  for (Eigen::Index part = 0; part < weights.size(); ++part) {
    const Cumulants& own = parts[static_cast<std::size_t>(part)];
    const double p = weights[part];
    const Matrix<double> own_turn = turn.middleCols(column, own.rank()) / std::sqrt(p);
    const Vector<double> t = turn.col(column + own.rank()) / std::sqrt(p);
    column += own.rank() + 1;
    const Matrix<double> c = own_turn * own_turn.transpose();
    const Matrix<double> square = t * t.transpose();
    const std::vector<double> third = turned_tensor(own.third_, own_turn, 3);
    const std::vector<double> fourth = turned_tensor(own.fourth_, own_turn, 4);
    const auto k3 = [&](Eigen::Index i, Eigen::Index j, Eigen::Index k) {
      return third[static_cast<std::size_t>((i * r + j) * r + k)];
    };
    for (Eigen::Index place = 0; place < r * r * r; ++place) {
      const Eigen::Index i = place / (r * r), j = place / r % r, k = place % r;
      result.third_[static_cast<std::size_t>(place)] +=
          p * (k3(i, j, k) + t[i] * c(j, k) + t[j] * c(i, k) + t[k] * c(i, j) + t[i] * t[j] * t[k]);
    }
    for (Eigen::Index place = 0; place < r * r * r * r; ++place) {
      const Eigen::Index i = place / (r * r * r), j = place / (r * r) % r, k = place / r % r,
                         l = place % r;
      const auto pairs = [&](const Matrix<double>& a, const Matrix<double>& b) {
        return a(i, j) * b(k, l) + a(i, k) * b(j, l) + a(i, l) * b(j, k);
      };
      result.fourth_[static_cast<std::size_t>(place)] +=
          p * (fourth[static_cast<std::size_t>(place)] + pairs(c, c) - pairs(one, one) +
               pairs(square, c) + pairs(c, square) + t[i] * k3(j, k, l) + t[j] * k3(i, k, l) +
               t[k] * k3(i, j, l) + t[l] * k3(i, j, k) + t[i] * t[j] * t[k] * t[l]);
    }
  }
  return result;
}

}  // namespace hamjet
