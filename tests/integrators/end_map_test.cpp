#include "integrators/gauss/end_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "hamjet/dynamics/dynamical_system.hpp"

// The step of a degree by the end map is compared with the step by the stages' slopes. Both compute
// the same sums in different ways, and the slopes do not use that the method is symplectic.

namespace hamjet {
namespace {

DynamicalSystem oblate_centre() {
  return make_system("oblate", 3, [](auto q, auto p) {
    const auto r2 = square(q[0]) + square(q[1]) + square(q[2]);
    return (square(p[0]) + square(p[1]) + square(p[2])) / 2 - pow(r2, -0.5) +
           square(q[2]) * pow(r2, -2.5) / 100;
  });
}

DynamicalSystem coupled_pendulums() {
  return make_system("coupled pendulums", 2, [](auto q, auto p) {
    return (square(p[0]) + square(p[1])) / 2 - cos(q[0]) - cos(q[1]) + square(q[0]) * q[1] / 3;
  });
}

/// One step from a state with random coefficients of degree 1 and 2.
template <int Lanes>
class OneStep {
 public:
  using P = Pack<double, Lanes>;

  OneStep(const DynamicalSystem& system, int stages, double h)
      : space_(SeriesSpace::create(3, 2)),
        stages_(system, gauss_tableau(static_cast<std::size_t>(stages)), space_, 2),
        h_(h) {
    std::mt19937_64 generator(7);
    std::uniform_real_distribution<double> number(-1, 1);
    const std::size_t n = system.degrees_of_freedom;
    for (std::size_t i = 0; i < 2 * n; ++i) {
      std::vector<double>& of = state_.emplace_back();
      for (std::size_t k = 0; k < space_->size(); ++k) of.push_back(number(generator));
      of[0] = i == 0 || i == n + 1 ? 1 : 0.1 * of[0];
    }
  }

  /// Solves the stages, with the requested response. Returns the largest difference of both steps
  /// of degree 2, relative to the largest coefficient of the step.
  double difference(Response response) {
    const std::size_t n = state_.size() / 2;
    const auto state = [this](std::size_t i, std::size_t k) { return state_[i][k]; };
    IntegrationStatistics statistics;
    stages_.begin_step(0.0, h_);
    EXPECT_TRUE(
        stages_.solve_constant_terms([&](std::size_t i) { return state(i, 0); }, statistics));
    EXPECT_TRUE(stages_.factorise(Response::formed));
    stages_.solve_degree(1, state);
    stages_.evaluator().complete(1);
    stages_.evaluator().evaluate_remainder(2);
    stages_.solve_degree(2, state);
    stages_.evaluator().complete(2);
    EXPECT_TRUE(stages_.factorise(response));
    EndMap<double, Lanes> map;
    map.form(stages_, true);
    double largest = 0;
    double difference = 0;
    map.apply(stages_.evaluator(), *space_, 2, state, [&](std::size_t k, const P& step) {
      for (std::size_t c = 0; c < n; ++c) {
        const P slope = stages_.slope(c, k);
        const auto& system = stages_.system();
        const double by_slopes[] = {
            h_ * (state(n + c, k) + h_ * dot(system.position_weights(), slope)),
            h_ * dot(system.weights(), slope)};
        for (const std::size_t half : {0, 1}) {
          const double by_map = step.lane(static_cast<int>(half * n + c));
          largest = std::max(largest, std::abs(by_slopes[half]));
          difference = std::max(difference, std::abs(by_map - by_slopes[half]));
        }
      }
    });
    return difference / largest;
  }
  bool follows_from_base() const { return stages_.system().end_follows_from_base(); }

 private:
  SpacePointer space_;
  StageSlopes<double, Lanes> stages_;
  double h_;
  std::vector<std::vector<double>> state_;
};

/// The values are sums of a few dozen products of factors of about 1, and the roundings are at most
/// as many.
constexpr double allowed_slopes = 64 * std::numeric_limits<double>::epsilon();

TEST(EndMap, IsTheStepByTheSlopes) {
  for (const DynamicalSystem& system : {oblate_centre(), coupled_pendulums()}) {
    for (const int stages : {1, 2, 3, 5, 8}) {
      OneStep<8> step(system, stages, 0.3);
      EXPECT_LT(step.difference(Response::for_end_map), allowed_slopes)
          << system.name << ", " << stages << " stages";
      EXPECT_TRUE(step.follows_from_base());
    }
    // Some lanes have no stage of their own.
    for (const int stages : {9, 14, 16}) {
      OneStep<16> step(system, stages, -0.3);
      EXPECT_LT(step.difference(Response::for_end_map), allowed_slopes)
          << system.name << ", " << stages << " stages";
      EXPECT_TRUE(step.follows_from_base());
    }
  }
}

TEST(EndMap, IsTheStepByTheSlopesWhereTheDiagonalDoesNotDominate) {
  for (const int stages : {2, 5, 8}) {
    OneStep<8> step(coupled_pendulums(), stages, 1.5);
    EXPECT_LT(step.difference(Response::for_end_map), allowed_slopes) << stages << " stages";
    EXPECT_FALSE(step.follows_from_base());
  }
}

/// A pendulum in a time that runs faster by a number that stays as it is: the force is no gradient.
DynamicalSystem scaled_pendulum() {
  OperationList energy = record(4, [](std::span<const Expression> z) {
    return std::vector<Expression>{(square(z[2]) + square(z[3])) / 2 - cos(z[0])};
  });
  return make_system(
      "scaled pendulum", std::move(energy), record(4, [](std::span<const Expression> z) {
        return std::vector<Expression>{z[2], z[3], -(1 + z[1] / 1024) * sin(z[0]), 0 * z[1]};
      }));
}

TEST(EndMap, IsTheStepByTheSlopesWhereForcesAreNoGradient) {
  for (const int stages : {2, 5, 8}) {
    OneStep<8> step(scaled_pendulum(), stages, 0.3);
    EXPECT_LT(step.difference(Response::for_end_map), allowed_slopes) << stages << " stages";
    EXPECT_FALSE(step.follows_from_base());
  }
}

}  // namespace
}  // namespace hamjet
