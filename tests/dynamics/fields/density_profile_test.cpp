#include "dynamics/fields/density_profile.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "dynamics/fields/exponential_atmosphere.hpp"
#include "dynamics/fields/harris_priester_table.hpp"
#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/error.hpp"
#include "support/magnitude.hpp"

namespace hamjet {
namespace {

template <class Real>
std::vector<Real> profile_at(const DensityProfile& profile, const Real& height, int degree) {
  std::vector<Pack<Real, 1>> c(static_cast<std::size_t>(degree) + 1);
  profile.expand(Pack<Real, 1>(height), degree, c.data());
  std::vector<Real> result;
  for (const auto& coefficient : c) result.push_back(coefficient.lane(0));
  return result;
}

std::array<DensityTable, 3> known_tables() {
  const HarrisPriesterTable table = harris_priester_table();
  return {table.minimum, table.maximum, exponential_table()};
}

TEST(DensityProfile, NodesAreExact) {
  for (const DensityTable& table : known_tables()) {
    const DensityProfile profile(table);
    for (std::size_t i = 0; i < table.heights_km.size(); ++i) {
      EXPECT_EQ(profile_at(profile, table.heights_km[i], 0)[0], table.densities[i]);
      const Extended below = Extended(table.heights_km[i]) - Extended(0x1p-90);
      EXPECT_LE(test::magnitude_of(profile_at(profile, below, 0)[0] / table.densities[i] - 1),
                1e-26);
    }
  }
}

// Six derivatives are continuous at inner nodes and four at both ends, and no more.
TEST(DensityProfile, DerivativesAgreeOnBothSidesOfNodes) {
  for (const DensityTable& table : known_tables()) {
    const DensityProfile profile(table);
    const std::size_t last = table.heights_km.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      const Extended node = table.heights_km[i];
      const auto above = profile_at(profile, node, 7);
      const auto below = profile_at(profile, Extended(node - Extended(0x1p-90)), 7);
      const int smooth = i == 0 || i == last ? 4 : 6;
      const auto jump = [&](int n) {
        const auto k = static_cast<std::size_t>(n);
        // Derivatives by a length of 10 km, to which the densities' own change is comparable.
        return test::magnitude_of((above[k] - below[k]) / above[0]) * std::pow(10.0, n);
      };
      for (int n = 0; n <= smooth; ++n) EXPECT_LE(jump(n), 1e-23) << node << ' ' << n;
      EXPECT_GE(jump(smooth + 1), 1e-13) << node;
    }
  }
}

TEST(DensityProfile, BeyondTheTableTheDensityIsExponential) {
  for (const DensityTable& table : known_tables()) {
    const DensityProfile profile(table);
    for (const double start : {table.heights_km.front() - 40, table.heights_km.back()}) {
      const auto at = [&](double h) { return profile_at(profile, start + h, 1); };
      EXPECT_NEAR(at(0)[0] * at(40)[0] / (at(20)[0] * at(20)[0]), 1, 1e-13);
      EXPECT_NEAR(at(0)[1] / at(0)[0], at(20)[1] / at(20)[0], 1e-14);
      EXPECT_LT(at(0)[1], 0);
    }
  }
}

// An exponential is its own spline but for the digits of its table.
TEST(DensityProfile, AnExponentialStaysOne) {
  DensityTable table{{100, 101, 130, 250, 800}, {}};
  for (const double h : table.heights_km) table.densities.push_back(std::exp(-h / 40));
  const DensityProfile profile(table);
  EXPECT_LE(profile.largest_departure(), 1e-12);
  const auto c = profile_at(profile, 400.0, 4);
  double expected = std::exp(-10);
  for (std::size_t n = 0; n <= 4; ++n) {
    EXPECT_NEAR(c[n] / expected, 1, 1e-8) << n;
    expected /= -40.0 * static_cast<double>(n + 1);
  }
}

// The largest of the same sample by a Python program that solves for the eight coefficients of each
// gap by Gaussian elimination.
TEST(DensityProfile, DepartureFromExponentialsIsKnown) {
  const auto tables = known_tables();
  EXPECT_NEAR(DensityProfile(tables[0]).largest_departure(), 0.06745167434438, 1e-11);
  EXPECT_NEAR(DensityProfile(tables[1]).largest_departure(), 0.08251376224062, 1e-11);
}

// Splines of tables with sudden bends overshoot; those of the known tables do not.
TEST(DensityProfile, DensitiesOfKnownTablesFallEverywhere) {
  for (const DensityTable& table : known_tables()) {
    const DensityProfile profile(table);
    for (double h = table.heights_km.front(); h < table.heights_km.back(); h += 0.5) {
      EXPECT_LT(profile_at(profile, h, 1)[1], 0) << h;
    }
  }
}

// Published rows of the source, in kg/m^3.
TEST(HarrisPriesterTable, HasThePublishedDensities) {
  const HarrisPriesterTable table = harris_priester_table();
  ASSERT_EQ(table.minimum.heights_km.size(), 50U);
  EXPECT_EQ(table.minimum.heights_km, table.maximum.heights_km);
  const auto expect_row = [&](std::size_t i, double h, double least, double greatest) {
    EXPECT_EQ(table.minimum.heights_km.at(i), h);
    EXPECT_EQ(table.minimum.densities.at(i), least);
    EXPECT_EQ(table.maximum.densities.at(i), greatest);
  };
  expect_row(0, 100, 4.974e-07, 4.974e-07);
  expect_row(24, 400, 2.249e-12, 7.492e-12);
  expect_row(34, 600, 8.070e-14, 6.390e-13);
  expect_row(49, 1000, 1.150e-15, 1.810e-14);
}

// Each layer ends at the density of the next one, within the digits of the scale heights; the
// ground's belongs to another model.
TEST(ExponentialAtmosphere, LayersJoin) {
  const ExponentialAtmosphere model = exponential_atmosphere();
  ASSERT_EQ(model.base_heights_km.size(), 28U);
  for (std::size_t i = 0; i + 1 < model.densities.size(); ++i) {
    const double gap = model.base_heights_km[i + 1] - model.base_heights_km[i];
    const double end = model.densities[i] * std::exp(-gap / model.scale_heights_km[i]);
    EXPECT_NEAR(end / model.densities[i + 1], 1, 3e-3) << model.base_heights_km[i];
  }
}

std::string refusal_of(const DensityTable& table) {
  try {
    const DensityProfile profile(table);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "";
}

TEST(DensityProfile, RefusesWhatIsNoTable) {
  const std::vector<double> heights = {100, 200, 300, 400};
  EXPECT_EQ(refusal_of({heights, {4, 3, 2, 1}}), "");
  EXPECT_EQ(refusal_of({heights, {4, 3, 2}}),
            "a table of densities must have as many densities as heights, got 3 and 4");
  EXPECT_EQ(refusal_of({{100, 200, 300}, {4, 3, 2}}),
            "a table of densities must have at least 4 heights, got 3");
  EXPECT_EQ(refusal_of({{100, 200, 200, 400}, {4, 3, 2, 1}}),
            "the heights of a table of densities must increase, but 200 km is followed by 200 km");
  EXPECT_EQ(refusal_of({{100, std::nan(""), 300, 400}, {4, 3, 2, 1}}),
            "height 2 of a table of densities is not finite");
  EXPECT_EQ(refusal_of({heights, {4, 3, 0, 1}}),
            "densities must be positive and finite, got 0 kg/m^3 at 300 km");
  EXPECT_EQ(refusal_of({heights, {4, 3, std::numeric_limits<double>::infinity(), 1}}),
            "densities must be positive and finite, got inf kg/m^3 at 300 km");
}

}  // namespace
}  // namespace hamjet
