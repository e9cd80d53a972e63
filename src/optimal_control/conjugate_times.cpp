#include "conjugate_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lagrangian_plane.hpp"

namespace hamjet {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

/// An eigenvalue counts as having returned to 1 only when it has passed 1 by more than round-off.
constexpr double phase_tolerance = 1e-9;

/// If eigenvalues turn by more than this in a step, one could be mistaken for another.
constexpr double largest_turn = 0.75 * std::numbers::pi;

/// Follows the phases, ascending, to those of the next step. Their order on the circle stays, so
/// that the next phases are a cyclic shift of the present ones; the shift whose largest turn is
/// least is chosen. Returns that turn.
double follow(std::vector<double>& phases, const std::vector<double>& next) {
  const std::size_t n = phases.size();
  const auto principal = [](double phase) { return std::remainder(phase, whole_turn); };
  std::sort(phases.begin(), phases.end(),
            [&](double a, double b) { return principal(a) < principal(b); });
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> best(n);
  for (std::size_t shift = 0; shift < n; ++shift) {
    std::vector<double> turns(n);
    double largest = 0;
    for (std::size_t j = 0; j < n; ++j) {
      turns[j] = std::remainder(next[(j + shift) % n] - phases[j], whole_turn);
      largest = std::max(largest, std::abs(turns[j]));
    }
    if (!(largest < least)) continue;
    least = largest;
    best = std::move(turns);
  }
  for (std::size_t j = 0; j < n; ++j) phases[j] += best[j];
  return least;
}

}  // namespace

ConjugateTimes conjugate_times(const std::vector<Eigen::MatrixXd>& jacobians,
                               const Eigen::VectorXd& typical_sizes) {
  ConjugateTimes result;
  LagrangianPlane plane(typical_sizes.size() / 2);
  std::vector<double> phases(static_cast<std::size_t>(typical_sizes.size() / 2), 0.0);
  for (std::size_t k = 0; k < jacobians.size(); ++k) {
    plane.advance(typical_sizes.cwiseInverse().asDiagonal() * jacobians[k] *
                  typical_sizes.asDiagonal());
    if (!(follow(phases, plane.phases()) <= largest_turn)) result.is_resolved = false;
    double returns = 0;
    for (const double phase : phases) {
      returns += std::max(0.0, std::floor((-phase - phase_tolerance) / whole_turn));
    }
    while (static_cast<double>(result.passed_after.size()) < returns) {
      result.passed_after.push_back(k + 1);
    }
  }
  return result;
}

}  // namespace hamjet
