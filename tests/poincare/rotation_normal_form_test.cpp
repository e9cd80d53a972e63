#include "poincare/rotation_normal_form.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "hamjet/error.hpp"

// Normal forms of returns that are made by hand, so that their rotation number is known.

namespace hamjet {
namespace {

/// A return that turns (q, p) by a part of a whole turn and shears it: q' = c q + s (p + k q^2),
/// p' = -s q + c (p + k q^2), which preserves the area.
NodalFlight<double> turned(double part, int order, double shear = 0.3) {
  const SpacePointer space = SeriesSpace::create(nodal_variables, order);
  const double angle = 2 * std::numbers::pi * part, c = std::cos(angle), s = std::sin(angle);
  const Series<double> q = Series<double>::variable(space, q_variable);
  const Series<double> kicked = Series<double>::variable(space, p_variable) + q * q * shear;
  return {Series<double>(space, 2 * std::numbers::pi), q * c + kicked * s, kicked * c - q * s,
          Series<double>(space)};
}

std::string refusal_of(const NodalFlight<double>& flight) {
  try {
    const RotationNormalForm form(flight);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    return error.what();
  }
  return "none";
}

// Terms w*^2 and w^4 have the divisor lambda - lambda^-2 and lambda - lambda^4, 0 for a third of a
// turn; lambda - lambda^-3, of w*^3, is 0 for a quarter.
TEST(RotationNormalForm, RefusesAResonanceOfItsOrder) {
  EXPECT_NE(refusal_of(turned(1.0 / 3, 3)).find("resonance, a divisor of order 3"),
            std::string::npos);
  EXPECT_NE(refusal_of(turned(-1.0 / 3, 2)).find("resonance"), std::string::npos);
  EXPECT_NE(refusal_of(turned(0.25, 3)).find("resonance"), std::string::npos);
  // Just beside it, and where the order does not reach it, there is a form.
  EXPECT_EQ(refusal_of(turned(1.0 / 3 + 1e-6, 3)), "none");
  EXPECT_EQ(refusal_of(turned(0.25, 2)), "none");
  EXPECT_EQ(refusal_of(turned(0.2, 3)), "none");
}

// The least divisor is |1 - exp(2 pi i k rho)|, k the excess less 1: 3 for w*^2, 1/100 of a turn
// off resonance 2 sin(pi 3/100).
TEST(RotationNormalForm, TellsItsSmallestDivisor) {
  const RotationNormalForm form(turned(1.0 / 3 + 0.01, 2));
  EXPECT_NEAR(form.smallest_divisor(), 2 * std::sin(std::numbers::pi * 0.03), 1e-14);
}

// Without a kick every circle turns alike.
TEST(RotationNormalForm, HasTheRotationNumberOfALinearReturn) {
  const RotationNormalForm form(turned(0.2, 3, 0));
  for (const double radius : {0.0, 0.1, 1.0}) {
    EXPECT_NEAR(std::abs(form.rotation_number({radius, 0, 0})), 0.2, 1e-15);
  }
}

// A place at which the polynomials overflow is on none of the circles; one near the fixed point is
// on one of them.
TEST(RotationNormalForm, HasNoPlaceFarAway) {
  const RotationNormalForm form(turned(0.2, 3));
  EXPECT_TRUE(form.place_of({0.01, 0.02}));
  for (const double far : {1e120, 1e200}) EXPECT_FALSE(form.place_of({far, -far})) << far;
}

TEST(RotationNormalForm, RefusesAnUnstableReturn) {
  NodalFlight<double> flight = turned(0.2, 2);
  flight.q = flight.q * 0 + Series<double>::variable(flight.q.space_pointer(), q_variable) * 2;
  flight.p = flight.p * 0 + Series<double>::variable(flight.q.space_pointer(), p_variable) / 2;
  EXPECT_NE(refusal_of(flight).find("unstable"), std::string::npos);
}

}  // namespace
}  // namespace hamjet
