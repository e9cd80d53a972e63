#include "maps/transformed_midpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/double_well.hpp"
#include "hamjet/integrators/midpoint.hpp"
#include "maps/symplectic_powers.hpp"
#include "support/errors.hpp"
#include "support/magnitude.hpp"
#include "support/symplectic.hpp"

// The paper's statement: the energy error of the midpoint scheme is invariant under discrete
// canonical transformations. Expected values: the run in the original coordinates, in double and in
// extended precision.

namespace hamjet::test {
namespace {

/// The differences of the two runs, and the sizes of the compared numbers.
struct Comparison {
  double energy_error = 0;       ///< the largest one, in the original coordinates
  double energy_difference = 0;  ///< the largest difference of the two energy errors
  double state_difference = 0;   ///< the largest difference of f_k^-1(Z_k) and z_k
  double condition = 0;          ///< the largest condition of A_k
};

template <class Real>
Comparison compare(const DynamicalSystem& system, const CanonicalTransformationSequence<Real>& f,
                   Vector<Real> z, double tau, long steps) {
  RecordedHamiltonian<Real> original(system);
  RecordedHamiltonian<Real> below(system);
  TransformedMidpoint<Real> transformed(below, f, z, Real(tau));
  const Real energy = original.value(z);
  const Real transformed_energy = transformed.energy();
  Comparison result;
  for (long k = 0; k < steps; ++k) {
    z = midpoint_step<Real>(original, z, Real(tau));
    transformed.advance();
    const Real error = original.value(z) - energy;
    const Real transformed_error = transformed.energy() - transformed_energy;
    const auto magnitude = [](const Real& x) { return std::abs(static_cast<double>(x)); };
    result.energy_error = std::max(result.energy_error, magnitude(error));
    result.energy_difference =
        larger(result.energy_difference, magnitude(Real(transformed_error - error)));
    result.state_difference =
        larger(result.state_difference,
               largest_entry(transformed.map().inverse()(transformed.state()) - z));
    result.condition = std::max(result.condition, transformed.map().condition());
  }
  EXPECT_EQ(transformed.step(), steps);
  return result;
}

template <class Real>
Vector<Real> paper_start() {
  Vector<Real> z(2);
  z << Real(1), Real(0.05);
  return z;
}

const auto paper_rotation = [] { return phase_plane_rotation<Extended>(acos(Extended(0.99))); };

TEST(TransformedMidpoint, EnergyErrorOfTheDoubleWellIsInvariantUnderRotation) {
  for (const double tau : {0.1, 0.2}) {
    const Comparison result = compare<double>(double_well(), SymplecticPowers(paper_rotation()),
                                              paper_start<double>(), tau, std::lround(100 / tau));
    EXPECT_GT(result.energy_error, 4e-4) << tau;
    EXPECT_LE(result.energy_difference, 1e-13) << tau;
  }
}

/// A new map at every k, without relation to the others.
template <class Real>
CanonicalTransformationSequence<Real> random_sequence(Eigen::Index n, unsigned seed) {
  return [n, seed](long k) {
    RandomNumbers random(seed + 7919U * static_cast<unsigned>(k));
    return random_affine_map<Real>(n, random);
  };
}

// In extended precision the difference falls by 18 digits, so that it is round-off alone.
TEST(TransformedMidpoint, EnergyErrorIsInvariantUnderRandomSymplecticMaps) {
  RandomNumbers random(51);
  for (const Eigen::Index n : {1, 2, 3}) {
    const DynamicalSystem system = random_system(static_cast<std::size_t>(n), random);
    const Vector<double> z = random_vector<double>(2 * n, random, 0.6);
    const Comparison result = compare<double>(system, random_sequence<double>(n, 52), z, 0.05, 100);
    EXPECT_GT(result.energy_error, 1e-6) << n;
    // The bound counts a hundred steps, each with a rounding of 1e-16 times the condition of A_k.
    EXPECT_LE(result.energy_difference, 1e-14 * result.condition) << n;
    EXPECT_LE(result.state_difference, 1e-14 * result.condition) << n;
    const Comparison extended =
        compare<Extended>(system, random_sequence<Extended>(n, 52), z.cast<Extended>(), 0.05, 20);
    EXPECT_LE(extended.energy_difference, 1e-32 * extended.condition) << n;
  }
}

// The invariance is a fact about symplectic maps: with a matrix that is not symplectic the
// canonical equations of K = H o f^-1 are others. Here K is recorded by hand, for the scaling Z
// = 1.1 z, and its energy error comes out another.
TEST(TransformedMidpoint, EnergyErrorIsNotInvariantUnderAScaling) {
  const auto largest_error = [](const DynamicalSystem& system, double scale) {
    RecordedHamiltonian<double> h(system);
    Vector<double> z = paper_start<double>() * scale;
    const double energy = h.value(z);
    double largest = 0;
    for (int k = 0; k < 1000; ++k) {
      z = midpoint_step<double>(h, z, 0.1);
      largest = std::max(largest, std::abs(h.value(z) - energy));
    }
    return largest;
  };
  const DynamicalSystem scaled =
      make_system("scaled", 1, [](std::span<const Expression> q, std::span<const Expression> p) {
        const std::vector<Expression> z = {q[0] / 1.1, p[0] / 1.1};
        const std::span<const Expression> all(z);
        return DoubleWellHamiltonian{}(all.first(1), all.last(1));
      });
  EXPECT_GT(std::abs(largest_error(scaled, 1.1) / largest_error(double_well(), 1) - 1), 0.05);
}

// Mapping z_(k+1) by f_(k+1) within the step, which eq. dct_zdk does not do, is another scheme. The
// paper's case differs by 0.29 in the energy error.
TEST(TransformedMidpoint, MappingTheEndByTheNextTransformationIsAnotherScheme) {
  RecordedHamiltonian<double> h(double_well());
  SymplecticPowers f(paper_rotation());
  TransformedHamiltonian<double> k(h, f(0));
  Vector<double> z = paper_start<double>();
  Vector<double> Z = z;
  const double energy = h.value(z);
  double largest = 0;
  for (long step = 0; step < 1000; ++step) {
    z = midpoint_step<double>(h, z, 0.1);
    Z = midpoint_step<double>(k, Z, 0.1);  // the end of the step is taken for Z_(k+1)
    k.set_map(f(step + 1));
    largest = larger(largest, std::abs((k.value(Z) - energy) - (h.value(z) - energy)));
  }
  EXPECT_NEAR(largest, 0.29, 0.005);
}

// The chain rule against the recorded list of K, which is differentiated as every system is.
TEST(TransformedHamiltonian, IsTheRecordedOne) {
  RandomNumbers random(53);
  for (const Eigen::Index n : {1, 2, 3}) {
    const DynamicalSystem system = random_system(static_cast<std::size_t>(n), random);
    const auto map = random_affine_map<Extended>(n, random);
    RecordedHamiltonian<Extended> h(system);
    TransformedHamiltonian<Extended> by_chain_rule(h, map);
    RecordedHamiltonian<Extended> recorded(transformed_system(system, map));
    const Vector<Extended> z = random_vector<Extended>(2 * n, random);
    const Vector<Extended> Z = map(z);
    const double tolerance = 1e-30 * map.condition();
    EXPECT_LE(std::abs(static_cast<double>(Extended(by_chain_rule.value(Z) - h.value(z)))),
              tolerance);
    EXPECT_LE(std::abs(static_cast<double>(Extended(recorded.value(Z) - h.value(z)))), tolerance);
    const auto& a = by_chain_rule.derivatives(Z);
    const auto& b = recorded.derivatives(Z);
    EXPECT_LE(largest_entry(a.gradient - b.gradient), tolerance * map.condition());
    EXPECT_LE(largest_entry(a.hessian - b.hessian), tolerance * map.condition());
    // J grad K(Z) = A J grad H(z), at the image Z; the print takes it at z.
    const Vector<Extended> image =
        map.matrix() * symplectic_unit_times(Vector<Extended>(h.derivatives(z).gradient));
    const auto field_error = [&](const Vector<Extended>& at) {
      const Vector<Extended> slope = by_chain_rule.derivatives(at).gradient;
      return largest_entry(symplectic_unit_times(slope) - image);
    };
    EXPECT_LE(field_error(Z), tolerance * map.condition());
    EXPECT_GT(field_error(z), 1e-3);
  }
}

// The step is made with K_k in Z, so that it satisfies the midpoint equations of the recorded K_k.
TEST(TransformedMidpoint, StepSolvesTheEquationsOfTheTransformedHamiltonian) {
  RandomNumbers random(54);
  const DynamicalSystem system = random_system(2, random);
  const auto sequence = random_sequence<Extended>(2, 55);
  RecordedHamiltonian<Extended> h(system);
  const Vector<Extended> z = random_vector<Extended>(4, random, 0.5);
  const Extended tau = 0.05;
  TransformedMidpoint<Extended> scheme(h, sequence, z, tau);
  for (long k = 0; k < 3; ++k) {
    RecordedHamiltonian<Extended> recorded(transformed_system(system, sequence(k)));
    const Vector<Extended> start = scheme.state();
    scheme.advance();
    // Z' = f_k(f_(k+1)^-1(Z_(k+1))).
    const Vector<Extended> end = sequence(k)(sequence(k + 1).inverse()(scheme.state()));
    const Vector<Extended> slope =
        symplectic_unit_times(recorded.derivatives((start + end) / Extended(2)).gradient);
    EXPECT_LE(largest_entry(end - start - slope * tau), 1e-27);
    EXPECT_GT(largest_entry(scheme.state() - start - slope * tau), 1e-2);
  }
}

TEST(TransformedMidpoint, RefusesOtherDimensions) {
  RecordedHamiltonian<double> h(double_well());
  const auto two = [](long) { return AffineSymplecticMap<double>::identity(2); };
  const auto one = [](long) { return AffineSymplecticMap<double>::identity(1); };
  expect_error(ErrorKind::usage, "another number of variables",
               [&] { TransformedMidpoint<double>(h, two, Vector<double>::Zero(2), 0.1); });
  expect_error(ErrorKind::usage, "another number of variables",
               [&] { TransformedMidpoint<double>(h, one, Vector<double>::Zero(4), 0.1); });
}

}  // namespace
}  // namespace hamjet::test
