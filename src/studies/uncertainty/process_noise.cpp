#include "process_noise.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr int intervals_of_a_revolution = 64;
constexpr int most_refinements = 6;
constexpr double agreement = 1e-4;

}  // namespace

ProcessNoise::ProcessNoise(const ComputedProblem& problem, const IntegratorSettings& settings,
                           double density, double period)
    : problem_(&problem), settings_(&settings), density_(density), period_(period) {}

Covariance ProcessNoise::by_intervals(double time, int count) const {
  std::vector<double> times;
  for (int k = 1; k <= count; ++k) times.push_back(k == count ? time : time * k / count);
  std::vector<Matrix<double>> flows = {Matrix<double>::Identity(6, 6)};
  visit_jets(*problem_, *settings_, times,
             [&](std::size_t, const FlowJet<double>& jet) { flows.push_back(linear_part(jet)); });
  const Eigen::Index columns = 3 * (static_cast<Eigen::Index>(count) + 1);
  Matrix<double> factor(6, columns);
  for (int k = 0; k <= count; ++k) {
    const double weight = k == 0 || k == count ? 1 : k % 2 == 1 ? 4 : 2;
    const double share = density_ * weight * std::abs(time) / (3.0 * count);
    // Phi(t, s) = Phi(t) Phi(s)^-1, where the inverse of a symplectic matrix is -J Phi^T J. Its
    // last columns, which belong to changes of the momenta, are [-B^T; A^T] for Phi = [[A, B], [C,
    // D]].
    const Matrix<double>& at_node = flows[static_cast<std::size_t>(k)];
    Matrix<double> kicks(6, 3);
    if (problem_->system->is_hamiltonian) {
      kicks << -at_node.topRightCorner(3, 3).transpose(), at_node.topLeftCorner(3, 3).transpose();
    } else {
      kicks = Eigen::PartialPivLU<Matrix<double>>(at_node).inverse().rightCols(3);
    }
    factor.middleCols(3 * static_cast<Eigen::Index>(k), 3) =
        std::sqrt(share) * (flows.back() * kicks);
  }
  return Covariance::of_factor(std::move(factor));
}

Covariance ProcessNoise::at(double time) const {
  const double revolutions = std::abs(time) / period_;
  int count =
      2 * std::max(8, static_cast<int>(std::ceil(revolutions * intervals_of_a_revolution)) / 2);
  Covariance last = by_intervals(time, count);
  for (int k = 0; k < most_refinements; ++k) {
    count *= 2;
    Covariance next = by_intervals(time, count);
    const Vector<double> s = next.standard_deviations();
    const Matrix<double> change = next.matrix() - last.matrix();
    const Matrix<double> relative =
        s.cwiseInverse().asDiagonal() * change * s.cwiseInverse().asDiagonal();
    // The largest entry alone would not show a NaN.
    if (relative.allFinite() && relative.cwiseAbs().maxCoeff() < agreement) return next;
    last = std::move(next);
  }
  throw Error(ErrorKind::numerical,
              "uncertainty: the covariance of the noise of the acceleration does not settle");
}

}  // namespace hamjet
