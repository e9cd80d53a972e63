#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"

// Gauss collocation against references of 36 and more digits (data/references/README.md).

namespace hamjet {
namespace {

using test::ReferenceOrbit;

std::size_t index_of(const SeriesSpace& space, const std::string& digits) {
  std::vector<std::uint8_t> exponents;
  for (const char digit : digits) exponents.push_back(static_cast<std::uint8_t>(digit - '0'));
  return space.index(exponents);
}

TEST(GaussReference, PaperOrbitMatchesStateMatrixAndJetOfOrderThree) {
  const ReferenceOrbit& orbit = test::paper_orbit();
  const auto jet = test::run_gauss(test::flow_of(orbit, 3));
  const auto extended =
      test::run_gauss(test::flow_of<Extended>(orbit, 3), test::adaptive(16, 1e-24));
  const SeriesSpace& space = jet[0].space();
  const auto coefficients =
      test::read_reference_file("paper_orbit_jets_order3.json")["coefficients"];
  ASSERT_EQ(coefficients.size(), space.size());
  FlowJet<Extended> reference;
  for (int i = 0; i < 6; ++i) reference.emplace_back(jet[0].space_pointer());
  for (const auto& [monomial, values] : coefficients.items()) {
    for (std::size_t i = 0; i < 6; ++i) {
      reference[i][index_of(space, monomial)] = test::from_decimal(values[i]);
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LE(test::magnitude_of(Extended(jet[i][0]) - orbit.state[i]), 10 * orbit.floor[i]);
    for (std::size_t j = 0; j < 6; ++j) {
      // The matrices of the two files are the same.
      EXPECT_LE(test::magnitude_of(reference[i][1 + j] - orbit.matrix[i][j]), 1e-30);
    }
  }
  for (int d = 0; d <= 3; ++d) {
    // The promise of the default integrator.
    EXPECT_LE(test::relative_error(jet, reference, d), 2e-12) << "degree " << d;
    // The bound is 34 digits minus the loss by conditioning; 1e-24 is the tolerance of a step.
    EXPECT_LE(test::relative_error(extended, reference, d), 1e-22) << "degree " << d;
  }
}

TEST(GaussReference, PaperOrbitHasAllCoefficientsToDegreeFour) {
  const auto jet = test::run_gauss(test::flow_of(test::paper_orbit(), 4));
  for (int d = 0; d <= 4; ++d) {
    EXPECT_LE(test::relative_error(jet, test::paper_orbit_reference(), d), 2e-12) << "degree " << d;
  }
}

TEST(GaussReference, ExtendedRunsReachTheExactRealCase) {
  const auto& entry = test::reference_case("SEED-10PI-EXACTREAL");
  // A field has binary64 constants; this system takes the paper's decimals to 34 digits.
  const Extended radius = Extended("6378.137") / 7000;
  const Extended J2("1.082626675e-3");
  const Extended J3("2.532436e-6");
  const auto hamiltonian = [&](auto q, auto p) {
    const Expression s2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const Expression sine2 = q[2] * q[2] / s2;
    const Expression r = sqrt(s2);
    const Expression ratio(radius);
    const Expression second = Expression(J2) * square(ratio) / s2 * (3 * sine2 - 1) / 2;
    const Expression third =
        Expression(J3) * square(ratio) * ratio / (s2 * s2) * q[2] * (5 * sine2 - 3) / 2;
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2 - (1 - second - third) / r;
  };
  test::Flow<Extended> flow{make_system("exact decimals", 3, hamiltonian),
                            {1, 0, 0, 0, sqrt(Extended(13) / 10) / 2, sqrt(Extended(39) / 10) / 2},
                            10 * boost::math::constants::pi<Extended>(),
                            1,
                            {}};
  const auto jet = test::run_gauss(flow, test::adaptive(16, 1e-28));
  const auto state = test::decimals(entry["state"]);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LE(test::magnitude_of(jet[i][0] - state[i]), 1e-26);
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_LE(test::magnitude_of(jet[i][1 + j] - test::from_decimal(entry["stm"][i][j])), 1e-22);
    }
  }
}

/// The change of the matrix that half a unit in the last place of the start and of the duration
/// causes: 2^-53 (sum over k of |d M_ij / d x_k| |x_k| + |(Df M)_ij| |t|), from a jet of order 2.
std::vector<std::vector<double>> matrix_floor(const test::Flow<double>& flow,
                                              const FlowJet<double>& jet) {
  const SeriesSpace& space = jet[0].space();
  const auto gradient =
      test::evaluate_list(jacobian(flow.system.vector_field), test::final_state(jet));
  std::vector<std::vector<double>> floor(6, std::vector<double>(6, 0));
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 6; ++k) {
        std::vector<std::uint8_t> exponents(6, 0);
        ++exponents[j];
        ++exponents[k];
        const double second = jet[i][space.index(exponents)] * (j == k ? 2 : 1);
        sum += std::abs(second * flow.start[k]);
      }
      double rate = 0;
      for (std::size_t k = 0; k < 6; ++k) rate += gradient[6 * i + k] * jet[k][1 + j];
      floor[i][j] = 0x1p-53 * (sum + std::abs(rate * flow.duration));
    }
  }
  return floor;
}

class GaussReferenceOrbit : public testing::TestWithParam<std::string> {};

TEST_P(GaussReferenceOrbit, EndsWithinWhatItsRoundingsMayAddUpTo) {
  const ReferenceOrbit orbit = test::reference_orbit(GetParam());
  const auto flow = test::flow_of(orbit, 2);
  IntegrationStatistics statistics;
  const auto jet = test::run_gauss(flow, test::adaptive(8, 1e-18), &statistics);
  const auto floor = matrix_floor(flow, jet);
  // At this tolerance the truncation errors of the steps are below round-off, and each step adds a
  // few units.
  const double tolerance = 4 * 0x1p-52 * static_cast<double>(statistics.steps);
  // A step rounds the state some 16 times, as the inputs are rounded once, and the flow that is
  // left amplifies that no more than it does the inputs: a random walk of 4 floors a step.
  const double floors = 4 * std::sqrt(1 + static_cast<double>(statistics.steps));
  // Over ten close passes, or one at r = 0.044, the matrices before and behind a step are both
  // large: round-off at half time is amplified by the product of the two norms, each half of the
  // whole one.
  const bool is_amplified =
      (orbit.field.J[2] == 0 && orbit.duration > 60) || GetParam() == "HYP-FLYBY";
  const double amplified = is_amplified ? 0x1p-52 * orbit.matrix_norm * orbit.matrix_norm / 4 : 0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LE(
        test::magnitude_of(Extended(jet[i][0]) - orbit.state[i]),
        tolerance * std::max(1.0, test::magnitude_of(orbit.state[i])) + floors * orbit.floor[i])
        << "component " << i;
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_LE(test::magnitude_of(Extended(jet[i][1 + j]) - orbit.matrix[i][j]),
                tolerance * orbit.matrix_norm + floors * floor[i][j] + amplified)
          << "entry " << i << ", " << j;
    }
  }
  // The energy is kept: |dH| <= |grad H| |error|, so by the same bound.
  const Extended change =
      test::energy(flow.system, std::vector<Extended>(orbit.state.begin(), orbit.state.end())) -
      test::from_decimal(test::reference_case(orbit.id)["energy0"]);
  EXPECT_LE(test::magnitude_of(change), 1e-25);
}

INSTANTIATE_TEST_SUITE_P(
    Orbits, GaussReferenceOrbit,
    testing::Values("KEP-E090-HALF", "KEP-E090-1REV", "KEP-E090-10REV", "KEP-E099-HALF",
                    "KEP-E099-1REV", "KEP-E099-10REV", "KEP-E0999-HALF", "KEP-E0999-1REV",
                    "KEP-E0999-10REV", "HYP-E1.5", "HYP-FLYBY", "PAR", "RECT-1.0", "RECT-1.11",
                    "SEED-10PI", "SEED-BACK", "SEED-T1", "POLAR-10PI", "GRAZE-10PI", "EQ-J2-CIRC",
                    "EQ-J3", "J2HALF-REG", "J2HALF-CHAOS", "J2HALF-PLUNGE", "CRIT-100REV",
                    "SEED-100REV"),
    [](const auto& orbit) {
      std::string name = orbit.param;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
      return name;
    });

TEST(GaussReference, PolarAndEquatorialOrbitsKeepExactZeros) {
  // A polar start keeps y = p_y = 0, and an equatorial start without J3 keeps z = p_z = 0. Among
  // the coefficients, in the plane those vanish that are odd in the deviations out of the plane,
  // and conversely.
  const auto expect_plane = [](const std::string& id, std::size_t normal) {
    const auto jet = test::run_gauss(test::flow_of(test::reference_orbit(id), 3));
    const SeriesSpace& space = jet[0].space();
    for (std::size_t k = 0; k < space.size(); ++k) {
      const bool odd = (space.exponents(k)[normal] + space.exponents(k)[normal + 3]) % 2 == 1;
      for (std::size_t i = 0; i < 6; ++i) {
        const bool is_normal = i % 3 == normal;
        if (odd != is_normal) {
          EXPECT_EQ(jet[i][k], 0) << id << ", component " << i << ", monomial " << k;
        }
      }
    }
    EXPECT_NE(jet[normal][space.linear_index(normal)], 0);
  };
  expect_plane("POLAR-10PI", 1);
  expect_plane("EQ-J2-CIRC", 2);
  // With J3 the equatorial plane is not invariant.
  const auto jet = test::run_gauss(test::flow_of(test::reference_orbit("EQ-J3"), 1));
  EXPECT_NEAR(jet[2][0], 2.30e-8, 0.01e-8);
  EXPECT_NEAR(jet[5][0], 3.63e-7, 0.01e-7);
}

TEST(GaussReference, KeplerJetHasItsClosedForm) {
  // mu = 1, start (1, 0), velocity (0, 1 + d), t = 2 pi, through d^5: "More numbers", 4, of
  // data/references/README.md.
  test::Flow<Extended> flow{kepler(), {1, 0, 0, 0, 1, 0}, 0, 5, {4}};
  const Extended pi = boost::math::constants::pi<Extended>();
  const Extended pi2 = pi * pi;
  const Extended pi3 = pi2 * pi;
  flow.duration = 2 * pi;
  const std::vector<Extended> x{
      1, 0, -18 * pi2, -108 * pi2, pi2 * (54 * pi2 - 462), pi2 * (972 * pi2 - 1710)};
  const std::vector<Extended> y{0,
                                -6 * pi,
                                -24 * pi,
                                36 * pi3 - 68 * pi,
                                360 * pi3 - 185 * pi,
                                2196 * pi3 - 492 * pi - 324 * pi3 * pi2 / 5};
  const auto extended = test::run_gauss(flow, test::fixed_step(16, 0.1));
  test::Flow<double> rounded{
      kepler(), {1, 0, 0, 0, 1, 0}, static_cast<double>(flow.duration), 5, {4}};
  // The steps are chosen by the nominal alone, for which a circle is easy: degree 5 needs shorter
  // steps.
  const auto jet = test::run_gauss(rounded, test::adaptive(8, 1e-22));
  for (std::size_t k = 0; k <= 5; ++k) {
    const double scale = std::max({1.0, test::magnitude_of(x[k]), test::magnitude_of(y[k])});
    EXPECT_LE(test::magnitude_of(extended[0][k] - x[k]), 1e-22 * scale) << "x, degree " << k;
    EXPECT_LE(test::magnitude_of(extended[1][k] - y[k]), 1e-22 * scale) << "y, degree " << k;
    // In double precision the rounded duration alone moves a coefficient by
    // 2^-53 2 pi |rate| <= 1e-15 (k + 1) scale; fifty steps of a few roundings.
    EXPECT_LE(std::abs(jet[0][k] - static_cast<double>(x[k])), 1e-13 * scale) << "x, degree " << k;
    EXPECT_LE(std::abs(jet[1][k] - static_cast<double>(y[k])), 1e-13 * scale) << "y, degree " << k;
    EXPECT_EQ(jet[2][k], 0);
  }
}

TEST(GaussReference, KeplerMonodromyOverOneRevolution) {
  // M = I - 3 T a f (grad H)^T; planar, from perigee, a = 1.
  const auto& table = test::reference_cases()["linear"]["kepler_monodromy_1rev_planar_perigee_a1"];
  for (const auto& [eccentricity, matrix] : table.items()) {
    const Extended e(eccentricity);
    test::Flow<Extended> flow{kepler(),
                              {1 - e, 0, 0, 0, sqrt((1 + e) / (1 - e)), 0},
                              2 * boost::math::constants::pi<Extended>(),
                              1,
                              {0, 1, 3, 4}};
    const auto jet = test::reference_jet(flow, test::adaptive(16, 1e-24));
    const std::size_t rows[] = {0, 1, 3, 4};
    // The reference prints twenty digits.
    double scale = 0;
    for (const auto& row : matrix) {
      for (const auto& text : row)
        scale = std::max(scale, test::magnitude_of(test::from_decimal(text)));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_LE(test::magnitude_of(jet[rows[i]][1 + j] - test::from_decimal(matrix[i][j])),
                  1e-17 * scale)
            << "e = " << eccentricity << ", entry " << i << ", " << j;
      }
    }
  }
}

}  // namespace
}  // namespace hamjet
