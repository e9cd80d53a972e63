#include "hamjet/maps/position_boundary_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "support/errors.hpp"
#include "support/magnitude.hpp"

// The momenta that join two positions, by generating functions of every kind. Expected: the momenta
// that the positions were made with, by maps in closed form.

namespace hamjet {
namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();

struct State {
  std::vector<double> position;
  std::vector<double> momentum;
};

/// The largest error of the momenta found between the positions of two states.
double error_of(const PartialInversion<double>& inversion, const State& initial, const State& final,
                int degree) {
  PositionBoundaryValues boundary(inversion);
  const BoundaryMomenta found = boundary.solve(initial.position, final.position, degree);
  double error = 0;
  for (std::size_t i = 0; i < initial.momentum.size(); ++i) {
    error = test::larger(error, std::abs(found.initial[i] - initial.momentum[i]));
    error = test::larger(error, std::abs(found.final[i] - final.momentum[i]));
  }
  return error;
}

/// Relative motion about a circular orbit of mean motion 1, x radial, y along the motion: W. H.
/// Clohessy, R. S. Wiltshire, J. Aerospace Sci. 27 (1960) 653. Momenta as of the Hamiltonian in the
/// turning frame: (x' - y, y' + x, z').
struct ClohessyWiltshire {
  double time;

  template <class Number>
  std::vector<Number> operator()(const std::vector<Number>& z) const {
    const double c = std::cos(time);
    const double s = std::sin(time);
    const Number vx = z[3] + z[1];
    const Number vy = z[4] - z[0];
    const Number x = (4 - 3 * c) * z[0] + s * vx + 2 * (1 - c) * vy;
    const Number y = 6 * (s - time) * z[0] + z[1] - 2 * (1 - c) * vx + (4 * s - 3 * time) * vy;
    const Number vx_final = 3 * s * z[0] + c * vx + 2 * s * vy;
    const Number vy_final = -6 * (1 - c) * z[0] - 2 * s * vx + (4 * c - 3) * vy;
    return {x, y, c * z[2] + s * z[5], vx_final - y, vy_final + x, c * z[5] - s * z[2]};
  }
};

/// A drift, then the kick of a potential: q1 = q0 + p0, p1 = p0 + grad V(q1) with
/// V = (x^2 + y^2) / 4 + a x^3 / 3 + b x^2 y.
struct DriftAndKick {
  double a;
  double b;

  template <class Number>
  std::vector<Number> operator()(const std::vector<Number>& z) const {
    const Number x = z[0] + z[2];
    const Number y = z[1] + z[3];
    return {x, y, z[2] + 0.5 * x + a * (x * x) + 2 * b * (x * y), z[3] + 0.5 * y + b * (x * x)};
  }
};

template <class Map>
std::vector<Series<double>> jet_of(const Map& map, std::size_t variables, int order) {
  const SpacePointer space = SeriesSpace::create(variables, order);
  std::vector<Series<double>> identity;
  for (std::size_t i = 0; i < variables; ++i) {
    identity.push_back(Series<double>::variable(space, i));
  }
  return map(identity);
}

PartialInversion<double> inverted(const std::vector<Series<double>>& jet,
                                  const GeneratingFunctionKind& kind) {
  return invert_partially(jet, kind);
}

State state_of(const std::vector<double>& z) {
  const auto half = z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2);
  return {{z.begin(), half}, {half, z.end()}};
}

TEST(PositionBoundaryValues, JoinPositionsAboutACircularOrbitByEveryKind) {
  const ClohessyWiltshire map{1.3};
  const std::vector<double> z = {0.3, -1, 0.2, 0.15, 0.4, -0.7};
  const State initial = state_of(z);
  const State final = state_of(map(z));
  const auto jet = jet_of(map, 6, 1);
  std::size_t count = 0;
  for (const auto& kind : all_kinds(3)) {
    const auto block = inverted_block(jet, kind);
    if (condition_number(block) > 1e3) continue;
    const auto inversion = inverted(jet, kind);
    // The bound is the rounding of the inversion and, if momenta are solved for, of the solution;
    // all numbers are near 1.
    const double bound = 50 * rounding * inversion.condition * inversion.condition;
    EXPECT_LE(error_of(inversion, initial, final, 1), bound) << kind.name();
    ++count;
  }
  EXPECT_GE(count, 48U);
}

TEST(PositionBoundaryValues, AnswerToTheDegreeByEveryKindOfANonlinearMap) {
  const DriftAndKick map{0.7, -0.4};
  constexpr int order = 8;
  constexpr double size = 0.01;
  const std::vector<double> z = {size, -size / 2, size / 3, 0.8 * size};
  const State initial = state_of(z);
  const State final = state_of(map(z));
  const auto jet = jet_of(map, 4, order);
  for (const auto& kind : all_kinds(2)) {
    const auto inversion = inverted(jet, kind);
    double worst = 0;
    for (int degree = 1; degree <= order; ++degree) {
      const double error = error_of(inversion, initial, final, degree);
      // The error is that of the neglected terms: the map's coefficients are below 1, and the
      // inverted linear part amplifies a power by less than 10.
      EXPECT_LE(error, std::pow(10 * size, degree + 1) + 50 * rounding * size)
          << kind.name() << " " << degree;
      if (degree == 1) worst = error;
    }
    // The linear answer misses by the quadratic term of the kick, a x^2 and more.
    EXPECT_GT(worst, 1e-5) << kind.name();
  }
}

TEST(PositionBoundaryValues, F1AnswersByEvaluationWithTheMapsOwnPolynomial) {
  // p0 = q1 - q0 and p1 = p0 + grad V(q1), which ends at the degree 2: no deviation is too large.
  const DriftAndKick map{0.7, -0.4};
  const std::vector<double> z = {30, -50, 20, 70};
  const auto jet = jet_of(map, 4, 3);
  const auto inversion = inverted(jet, parse_kind("F1", 2));
  constexpr double size = 1e4;  // the terms a x^2 and 2 b x y
  EXPECT_LE(error_of(inversion, state_of(z), state_of(map(z)), 2), 50 * rounding * size);
}

TEST(PositionBoundaryValues, WhatPolynomialsDoNotReachIsRefused) {
  // q1(p1, q0) of the map q1 = q0 + p0, p1 = p0 + q1^2 is u - u^2 at the degree 2, u = q0 + p1,
  // which is nowhere above 1/4.
  const auto map = [](const std::vector<Series<double>>& z) {
    const Series<double> q = z[0] + z[1];
    return std::vector<Series<double>>{q, z[1] + q * q};
  };
  const auto jet = jet_of(map, 2, 2);
  const auto inversion = inverted(jet, parse_kind("F3", 1));
  PositionBoundaryValues boundary(inversion);
  const std::vector<double> start = {0};
  const std::vector<double> near = {0.2};
  const std::vector<double> far = {0.3};
  // u - u^2 = 0.2 at u = (1 - sqrt(0.2)) / 2, where p1 = u.
  EXPECT_NEAR(boundary.solve(start, near, 2).final[0], (1 - std::sqrt(0.2)) / 2, 20 * rounding);
  test::expect_error(ErrorKind::numerical, "no momenta were found that join these positions",
                     [&] { boundary.solve(start, far, 2); });
  for (const int degree : {0, 3}) {
    test::expect_error(ErrorKind::usage, "boundary values",
                       [&] { boundary.solve(start, near, degree); });
  }
  const std::vector<double> two = {0, 0};
  test::expect_error(ErrorKind::usage, "boundary values", [&] { boundary.solve(two, near, 2); });
}

}  // namespace
}  // namespace hamjet
