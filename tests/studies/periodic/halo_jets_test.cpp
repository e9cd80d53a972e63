#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "independent_halo.hpp"

// Jets and generating functions on the 9:2 near-rectilinear halo orbit against flights of the
// test's own integrator.

namespace hamjet {
namespace {

constexpr long double published_moon = 1 / 82.30059L;
constexpr double halo_unit_m = 384400e3;

PropagationResult propagated_halo(const std::string& name,
                                  const std::vector<io::Override>& overrides) {
  const std::filesystem::path own =
      std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/own" / name;
  PropagationResult result = propagate(io::read_scene(own, overrides));
  EXPECT_EQ(result.runs.at(0).failure, "");
  return result;
}

using HaloNumbers = std::array<long double, 6>;

/// The end (q, p) of the start (q, p), flown in positions and velocities.
HaloNumbers flown_halo(const HaloNumbers& start, long double time) {
  test::HaloState s = test::RestrictedProblem::start(0, 0, 0);
  for (std::size_t i = 0; i < 3; ++i) s[i] = start[i];
  s[3] = start[3] + start[1];
  s[4] = start[4] - start[0];
  s[5] = start[5];
  s = test::RestrictedProblem(published_moon).flown(s, time);
  return {s[0], s[1], s[2], s[3] - s[1], s[4] + s[0], s[5]};
}

/// The Taylor coefficients of a function of s by the polynomial through its values at Chebyshev's
/// nodes, whose error is that of the function's digits and of the degrees left out.
class InterpolatedTaylor {
 public:
  static constexpr int nodes = 15;
  static long double node(int k, long double reach) {
    return reach * std::cos(std::numbers::pi_v<long double> * (k + 0.5L) / nodes);
  }
  static std::array<long double, nodes> coefficients(const std::array<long double, nodes>& values,
                                                     long double reach) {
    Eigen::Matrix<long double, nodes, nodes> powers;
    Eigen::Matrix<long double, nodes, 1> right;
    for (int k = 0; k < nodes; ++k) {
      for (int d = 0; d < nodes; ++d) powers(k, d) = std::pow(node(k, 1), d);
      right(k) = values[static_cast<std::size_t>(k)];
    }
    const Eigen::Matrix<long double, nodes, 1> scaled = powers.fullPivLu().solve(right);
    std::array<long double, nodes> result{};
    for (int d = 0; d < nodes; ++d) {
      result[static_cast<std::size_t>(d)] = scaled(d) / std::pow(reach, d);
    }
    return result;
  }
};

// Degree by degree along a line of deviations, a day and a quarter from the apolune.
TEST(HaloJets, DegreesOneToSixAreThoseOfFlownNeighbours) {
  const PropagationResult result = propagated_halo(
      "earth-moon-nrho.toml", {{"jet.order", "6"}, {"jet.duration_canonical", "0.3"}});
  const auto& jet = result.runs.at(0).jet;
  const std::vector<double>& nominal = result.scene.nominal;
  const HaloNumbers direction = {0.4L, -0.5L, 0.3L, 0.2L, 0.6L, -0.3L};
  constexpr long double reach = 2e-2L;
  std::array<HaloNumbers, InterpolatedTaylor::nodes> ends;
  for (int k = 0; k < InterpolatedTaylor::nodes; ++k) {
    HaloNumbers start{};
    for (std::size_t i = 0; i < 6; ++i) {
      start[i] = nominal[i] + InterpolatedTaylor::node(k, reach) * direction[i];
    }
    ends[static_cast<std::size_t>(k)] = flown_halo(start, 0.3L);
  }
  std::array<double, 7> largest{}, worst{};
  for (std::size_t i = 0; i < 6; ++i) {
    std::array<long double, InterpolatedTaylor::nodes> values{};
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = ends[k][i];
    const auto expected = InterpolatedTaylor::coefficients(values, reach);
    std::array<long double, 7> along{};
    const SeriesSpace& space = jet[i].space();
    for (std::size_t m = 0; m < space.size(); ++m) {
      long double term = static_cast<long double>(jet[i][m]);
      std::size_t degree = 0;
      std::size_t variable = 0;
      for (const auto exponent : space.exponents(m)) {
        term *= std::pow(direction[variable++], static_cast<int>(exponent));
        degree += exponent;
      }
      along[degree] += term;
    }
    for (std::size_t d = 1; d <= 6; ++d) {
      largest[d] = std::max(largest[d], static_cast<double>(std::abs(expected[d])));
      worst[d] = std::max(worst[d], static_cast<double>(std::abs(along[d] - expected[d])));
    }
  }
  for (std::size_t d = 1; d <= 6; ++d) {
    // What the digits of long double leave, which the division by the reach magnifies; and the
    // degrees above those of the interpolation.
    const double digits = 1e-12 * std::pow(static_cast<double>(reach), -static_cast<double>(d));
    EXPECT_GT(largest[d], 0) << d;
    EXPECT_LE(worst[d], std::pow(10.0, static_cast<double>(d) - 10) * largest[d] + digits) << d;
    EXPECT_LT(digits, 0.1 * largest[d]) << d;
  }
}

// From 51 km away to the target itself after a day: the momentum that F1 gives, flown.
TEST(HaloJets, ADaysGeneratingFunctionLeadsTheChaserToItsTarget) {
  const PropagationResult result = propagated_halo("earth-moon-nrho-chaser.toml", {});
  ASSERT_EQ(result.runs.at(0).kinds.size(), 1U);
  const auto& function = result.runs.at(0).kinds[0].generating_function;
  ASSERT_TRUE(function);
  // dF1 = p_1 dq_1 - p_0 dq_0, of deviations; the variables are the final positions, then the
  // initial ones.
  const std::vector<Extended> place = {0,
                                       0,
                                       0,
                                       Extended(30e3 / halo_unit_m),
                                       Extended(-40e3 / halo_unit_m),
                                       Extended(10e3 / halo_unit_m)};
  HaloNumbers start{};
  HaloNumbers target{};
  for (std::size_t i = 0; i < 6; ++i) start[i] = target[i] = result.scene.nominal[i];
  for (std::size_t i = 0; i < 3; ++i) {
    start[i] += static_cast<long double>(place[3 + i]);
    start[3 + i] -=
        static_cast<long double>(evaluate<Extended>(derivative(*function, 3 + i), place));
  }
  const long double day = result.scene.duration;
  const HaloNumbers met = flown_halo(start, day);
  const HaloNumbers expected = flown_halo(target, day);
  const long double miss =
      std::hypot(met[0] - expected[0], met[1] - expected[1], met[2] - expected[2]);
  EXPECT_LT(static_cast<double>(miss) * halo_unit_m, 1);
  // Without the polynomials' momentum it is as far away as it was.
  for (std::size_t i = 0; i < 3; ++i) start[3 + i] = target[3 + i];
  const HaloNumbers drifted = flown_halo(start, day);
  EXPECT_GT(static_cast<double>(std::abs(drifted[0] - expected[0])) * halo_unit_m, 1e4);
}

}  // namespace
}  // namespace hamjet
