#include "maps/discrete_hamilton_jacobi.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/double_well.hpp"
#include "maps/transformed_hamiltonian.hpp"
#include "support/errors.hpp"
#include "support/symplectic.hpp"

// Discrete generating functions against the map that they generate, and the discrete
// Hamilton-Jacobi equation. Expected values: the map itself, closed forms, identities.

namespace hamjet::test {
namespace {

using Kind = DiscreteGeneratingFunctionKind;

/// The variables of a kind at a point and its image.
Vector<double> variables(Kind kind, const Vector<double>& z, const Vector<double>& image) {
  const Eigen::Index n = z.size() / 2;
  Vector<double> w(2 * n);
  w << z.head(n), (kind == Kind::first ? image.head(n) : image.tail(n));
  return w;
}

// p = D1 S and P = -D2 S of the first kind, p = D1 S and Q = D2 S of the second, the derivatives
// being central differences of the value, which are exact for a quadratic function.
TEST(DiscreteGeneratingFunction, GeneratesTheMap) {
  RandomNumbers random(41);
  for (const Eigen::Index n : {1, 2, 3}) {
    const auto map = random_affine_map<double>(n, random);
    const Vector<double> z = random_vector<double>(2 * n, random);
    const Vector<double> image = map(z);
    for (const Kind kind : {Kind::first, Kind::second}) {
      const DiscreteGeneratingFunction<double> s(map, kind);
      const double tolerance = 1e-14 * map.condition() / existence_measure(map, kind);
      ASSERT_LE(tolerance, 1e-9);
      const Vector<double> w = variables(kind, z, image);
      Vector<double> slope(2 * n);
      for (Eigen::Index i = 0; i < 2 * n; ++i) {
        const Vector<double> step = Vector<double>::Unit(2 * n, i);
        slope(i) = (s.value(w + step) - s.value(w - step)) / 2;
      }
      EXPECT_LE(largest_entry(slope.head(n) - z.tail(n)), tolerance);
      const Vector<double> second =
          kind == Kind::first ? Vector<double>(-image.tail(n)) : Vector<double>(image.head(n));
      EXPECT_LE(largest_entry(slope.tail(n) - second), tolerance);
      EXPECT_LE(largest_entry(s.gradient(w) - slope), tolerance);
      EXPECT_LE(largest_entry(s.original_point(w) - z), tolerance);
      EXPECT_LE(largest_entry(s.transformed_point(w) - image), tolerance);
    }
  }
}

// A rotation by a: S1 = (2 q Q - (q^2 + Q^2) cos a) / (-2 sin a), which is quadratic, not linear as
// the paper says of it. From q, Q: p = (q cos a - Q) / sin a, P = (q - Q cos a) / sin a.
TEST(DiscreteGeneratingFunction, OfARotationInClosedForm) {
  const double a = 0.7;
  const auto map = phase_plane_rotation<double>(a);
  const DiscreteGeneratingFunction<double> first(map, Kind::first);
  const DiscreteGeneratingFunction<double> second(map, Kind::second);
  for (const auto& [q, x] : {std::pair(0.3, -0.8), std::pair(-1.1, 0.4)}) {
    const Vector<double> w{{q, x}};
    EXPECT_NEAR(first.value(w), ((q * q + x * x) * std::cos(a) - 2 * q * x) / (2 * std::sin(a)),
                1e-15);
    // x = P: P = q sin a + p cos a, so p = (P - q sin a) / cos a and Q = (q - P sin a) / cos a.
    EXPECT_NEAR(second.value(w), (2 * q * x - (q * q + x * x) * std::sin(a)) / (2 * std::cos(a)),
                1e-15);
  }
  EXPECT_GT(first.quadratic_part().norm(), 1);
}

// The identity has no function of the first kind; a quarter turn, Q = -p, P = q, has no function of
// the second kind.
TEST(DiscreteGeneratingFunction, SaysWhereItDoesNotExist) {
  const auto identity = AffineSymplecticMap<double>::identity(2);
  expect_error(ErrorKind::numerical, "of the first kind: it does not exist",
               [&] { DiscreteGeneratingFunction<double>(identity, Kind::first); });
  EXPECT_FALSE(exists(identity, Kind::first));
  EXPECT_TRUE(exists(identity, Kind::second));
  const auto quarter = phase_plane_rotation<double>(std::acos(-1) / 2);  // cos = 6e-17
  expect_error(ErrorKind::numerical, "of the second kind: it does not exist",
               [&] { DiscreteGeneratingFunction<double>(quarter, Kind::second); });
  EXPECT_TRUE(exists(quarter, Kind::first));
}

/// The residual with K(Q, +D2 S), as the equation is printed.
double printed_residual(DifferentiableHamiltonian<double>& h, DifferentiableHamiltonian<double>& k,
                        const DiscreteGeneratingFunction<double>& s, const Vector<double>& w) {
  const Eigen::Index n = w.size() / 2;
  Vector<double> Z(2 * n);
  Z << w.tail(n), s.gradient(w).tail(n);
  return h.value(s.original_point(w)) - k.value(Z);
}

// The equation holds at any point of (q, Q), or (q, P), for any Hamiltonian.
TEST(DiscreteHamiltonJacobi, HoldsForEveryHamiltonian) {
  RandomNumbers random(42);
  for (const Eigen::Index n : {1, 2, 3}) {
    for (int repeat = 0; repeat < 3; ++repeat) {
      const auto map = random_affine_map<double>(n, random);
      RecordedHamiltonian<double> h(random_system(static_cast<std::size_t>(n), random));
      TransformedHamiltonian<double> k(h, map);
      for (const Kind kind : {Kind::first, Kind::second}) {
        const DiscreteGeneratingFunction<double> s(map, kind);
        const Vector<double> w = random_vector<double>(2 * n, random);
        // The bound is the round-off of the point times the slope there, divided as the kind's
        // inversion does.
        const Vector<double> z = s.original_point(w);
        const double slope = h.derivatives(z).gradient.norm() * z.norm() + std::abs(h.value(z));
        const double tolerance =
            1e-15 * (1 + slope) * map.condition() / existence_measure(map, kind);
        EXPECT_LE(std::abs(hamilton_jacobi_residual<double>(h, k, s, w)), tolerance);
        if (kind == Kind::first) {
          EXPECT_GT(std::abs(printed_residual(h, k, s, w)), 1e3 * tolerance);
        }
      }
    }
  }
}

// The theorem's other direction: with a generating function of another map the equation fails.
TEST(DiscreteHamiltonJacobi, FailsForAnotherMap) {
  RecordedHamiltonian<double> h(double_well());
  TransformedHamiltonian<double> k(h, phase_plane_rotation<double>(0.5));
  const Vector<double> w{{0.9, 0.4}};
  const auto residual = [&](double angle, Kind kind) {
    const DiscreteGeneratingFunction<double> s(phase_plane_rotation<double>(angle), kind);
    return std::abs(hamilton_jacobi_residual<double>(h, k, s, w));
  };
  for (const Kind kind : {Kind::first, Kind::second}) {
    EXPECT_LE(residual(0.5, kind), 1e-14);
    EXPECT_GT(residual(0.5 + 1e-6, kind), 1e-8);
  }
}

}  // namespace
}  // namespace hamjet::test
