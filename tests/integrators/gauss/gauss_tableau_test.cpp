#include "integrators/gauss/gauss_tableau.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/errors.hpp"
#include "support/magnitude.hpp"

namespace hamjet {
namespace {

/// The tolerance is thirty-four digits minus a few that sums of 16 terms cost.
constexpr double roundoff = 1e-31;

TEST(GaussTableau, HasTheClosedFormsOfOneTwoAndThreeStages) {
  // Hairer, Lubich and Wanner, Geometric Numerical Integration, table II.1.1.
  const GaussTableau midpoint = gauss_tableau(1);
  EXPECT_EQ(midpoint.nodes[0], Extended(0.5));
  EXPECT_EQ(midpoint.weights[0], Extended(1));
  EXPECT_EQ(midpoint.a(0, 0), Extended(0.5));

  const Extended root3 = sqrt(Extended(3));
  const Extended one = 1;
  const GaussTableau two = gauss_tableau(2);
  const Extended a2[2][2] = {{one / 4, one / 4 - root3 / 6}, {one / 4 + root3 / 6, one / 4}};
  const Extended c2[2] = {one / 2 - root3 / 6, one / 2 + root3 / 6};
  const Extended root15 = sqrt(Extended(15));
  const GaussTableau three = gauss_tableau(3);
  const Extended a3[3][3] = {{5 * one / 36, 2 * one / 9 - root15 / 15, 5 * one / 36 - root15 / 30},
                             {5 * one / 36 + root15 / 24, 2 * one / 9, 5 * one / 36 - root15 / 24},
                             {5 * one / 36 + root15 / 30, 2 * one / 9 + root15 / 15, 5 * one / 36}};
  const Extended c3[3] = {one / 2 - root15 / 10, one / 2, one / 2 + root15 / 10};
  const Extended b3[3] = {5 * one / 18, 4 * one / 9, 5 * one / 18};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LE(test::magnitude_of(three.nodes[i] - c3[i]), roundoff);
    EXPECT_LE(test::magnitude_of(three.weights[i] - b3[i]), roundoff);
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_LE(test::magnitude_of(three.a(i, j) - a3[i][j]), roundoff);
    if (i == 2) break;
    EXPECT_LE(test::magnitude_of(two.nodes[i] - c2[i]), roundoff);
    EXPECT_LE(test::magnitude_of(two.weights[i] - Extended(0.5)), roundoff);
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_LE(test::magnitude_of(two.a(i, j) - a2[i][j]), roundoff);
  }
}

TEST(GaussTableau, MeetsTheOrderConditions) {
  for (std::size_t s = 1; s <= 16; ++s) {
    const GaussTableau t = gauss_tableau(s);
    // B(2s): sum of b_i c_i^(k-1) = 1/k for k = 1..2s, and no further.
    for (std::size_t k = 1; k <= 2 * s + 1; ++k) {
      Extended sum = 0;
      for (std::size_t i = 0; i < s; ++i) {
        sum += t.weights[i] * pow(t.nodes[i], Extended(static_cast<double>(k - 1)));
      }
      const double error = test::magnitude_of(sum - 1 / Extended(static_cast<double>(k)));
      if (k <= 2 * s) {
        EXPECT_LE(error, roundoff) << s << " stages, moment " << k;
      } else {
        EXPECT_GT(error, 100 * roundoff) << s << " stages";
      }
    }
    // C(s): sum of a_ij c_j^(k-1) = c_i^k / k for k = 1..s.
    for (std::size_t i = 0; i < s; ++i) {
      for (std::size_t k = 1; k <= s; ++k) {
        const Extended power(static_cast<double>(k - 1));
        Extended sum = 0;
        for (std::size_t j = 0; j < s; ++j) sum += t.a(i, j) * pow(t.nodes[j], power);
        const Extended expected = pow(t.nodes[i], power) * t.nodes[i] / (power + 1);
        EXPECT_LE(test::magnitude_of(sum - expected), roundoff);
      }
    }
  }
}

TEST(GaussTableau, IsSymplecticAndSymmetric) {
  for (std::size_t s = 1; s <= 16; ++s) {
    const GaussTableau t = gauss_tableau(s);
    for (std::size_t i = 0; i < s; ++i) {
      EXPECT_LE(test::magnitude_of(t.nodes[i] + t.nodes[s - 1 - i] - 1), roundoff);
      EXPECT_GT(t.weights[i], 0);
      if (i > 0) {
        EXPECT_GT(t.nodes[i], t.nodes[i - 1]);
      }
      for (std::size_t j = 0; j < s; ++j) {
        const Extended defect =
            t.weights[i] * t.a(i, j) + t.weights[j] * t.a(j, i) - t.weights[i] * t.weights[j];
        EXPECT_LE(test::magnitude_of(defect), roundoff);
        // a_(s-1-i, s-1-j) + a_ij = b_j: the method is its own adjoint.
        EXPECT_LE(test::magnitude_of(t.a(s - 1 - i, s - 1 - j) + t.a(i, j) - t.weights[j]),
                  roundoff);
      }
    }
  }
}

TEST(GaussTableau, RefusesOtherNumbersOfStages) {
  for (const std::size_t stages : {0u, 17u}) {
    test::expect_error(ErrorKind::usage, "1..16", [&] { gauss_tableau(stages); });
  }
}

TEST(GaussTableau, ModesAreThoseOfLegendre) {
  // f(c) = P_2(2 c - 1) = (3 x^2 - 1) / 2 has the mode 1 of degree 2 and no other.
  const GaussTableau t = gauss_tableau(4);
  for (std::size_t k = 0; k < 4; ++k) {
    Extended mode = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Extended x = 2 * t.nodes[i] - 1;
      mode += t.mode(k, i) * (3 * x * x - 1) / 2;
    }
    EXPECT_LE(test::magnitude_of(mode - (k == 2 ? 1 : 0)), roundoff) << "degree " << k;
  }
}

}  // namespace
}  // namespace hamjet
