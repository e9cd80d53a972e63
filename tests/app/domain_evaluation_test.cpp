#include "app/domain_evaluation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "app/deputy_states.hpp"
#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"

// Deputies beyond the reach of one jet, split into domains. Expected: Kepler's problem in closed
// form and flights by an extrapolation of the tests' own, both in 31 digits (deputy_states.hpp).

namespace hamjet::test {
namespace {

using cli::DomainEvaluation;
using cli::EvalDomains;
using cli::EvaluatedScene;
using cli::MissEstimate;

struct Told {
  std::vector<double> deviation;
  MissEstimate estimate;
};

template <class Evaluation>
std::vector<Told> told(Evaluation& evaluation, const std::vector<std::vector<double>>& deviations) {
  for (const std::vector<double>& deviation : deviations) evaluation.add(deviation);
  std::vector<Told> all;
  evaluation.run([&](const std::vector<double>& deviation, const MissEstimate& estimate) {
    all.push_back({deviation, estimate});
  });
  return all;
}

/// The distance in metres of a told final position from the true one.
double true_miss_m(const Scene& scene, const std::vector<double>& initial, const Told& one) {
  Numbers chief;
  Numbers deputy;
  for (std::size_t i = 0; i < 6; ++i) {
    chief[i] = scene.nominal[i];
    deputy[i] = chief[i] + Extended(initial[i]);
  }
  const Numbers chief_end = true_end(scene, chief);
  const Numbers deputy_end = true_end(scene, deputy);
  Place miss;
  for (std::size_t i = 0; i < 3; ++i) {
    miss[i] = chief_end[i] + Extended(one.deviation[i]) - deputy_end[i];
  }
  return convert<double>(sqrt(dot(miss, miss))) * scene.units.length_km * 1000;
}

/// Two revolutions of a sun-synchronous orbit with J2.
Scene two_revolutions(double tolerance_m, int most_domains) {
  return io::parse_scene(
      fmt::format("schema = 1\ntitle = \"far\"\n"
                  "system = {{ model = \"zonal-gravity\", mu_km3_s2 = 398600.4415, radius_km = "
                  "6378.1363, J2 = 1.08262668355315e-3 }}\n"
                  "nominal = {{ a_km = 6892.9, e = 0.00120, i_deg = 97.44, raan_deg = 30, argp_deg "
                  "= 90, ta_deg = 0 }}\njet = {{ order = 4, duration_orbits = 2 }}\n"
                  "eval = {{ tolerance_m = {}, most_domains = {} }}\n",
                  tolerance_m, most_domains),
      "far.toml");
}

/// Deputies up to 60 km above and below, within 100 m and 0.05 m/s beside that.
std::vector<std::vector<double>> far_deputies(const Scene& scene) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Numbers chief;
  for (std::size_t i = 0; i < 6; ++i) chief[i] = scene.nominal[i];
  std::vector<std::vector<double>> deviations;
  for (int k = 0; k < 60; ++k) {
    const double sizes[] = {6e4, 100, 100, 0.05, 0.05, 0.05};
    std::array<double, 6> row{};
    for (std::size_t i = 0; i < 6; ++i) row[i] = sizes[i] * uniform(generator);
    if (k < 2) row[0] = k == 0 ? 6e4 : -6e4;
    const Numbers state = deputy_state({"RTN", true}, scene.units, chief, row);
    std::vector<double> deviation;
    for (std::size_t i = 0; i < 6; ++i) {
      deviation.push_back(convert<double>(Extended(state[i] - chief[i])));
    }
    deviations.push_back(deviation);
  }
  return deviations;
}

TEST(DomainEvaluation, DeputiesThatOneJetMissesByKilometresAreRight) {
  const Scene scene = two_revolutions(1, 100);
  const EvaluatedScene evaluated = cli::evaluated_scene(scene);
  const std::vector<std::vector<double>> deputies = far_deputies(scene);
  cli::DeputyEvaluation by_one(evaluated, 4, 1);
  const std::vector<Told> one = told(by_one, deputies);
  DomainEvaluation by_domains(evaluated, 4, 1);
  const std::vector<Told> split = told(by_domains, deputies);
  ASSERT_EQ(split.size(), deputies.size());
  double worst_of_one = 0;
  for (std::size_t k = 0; k < deputies.size(); ++k) {
    worst_of_one = std::max(worst_of_one, true_miss_m(scene, deputies[k], one[k]));
    EXPECT_TRUE(split[k].estimate.is_inside());
    EXPECT_LE(split[k].estimate.miss_m(), 1);
    EXPECT_LE(true_miss_m(scene, deputies[k], split[k]), 1) << k;
  }
  EXPECT_GT(worst_of_one, 1000);
  const EvalDomains& domains = by_domains.domains();
  EXPECT_GE(domains.count, 4U);
  EXPECT_FALSE(domains.is_limited);
  EXPECT_EQ(domains.not_right, 0U);
  EXPECT_EQ(domains.maps, 2 * domains.count - 1);
  // They lie along R, and are split across it alone.
  EXPECT_EQ(domains.splits[0], domains.count - 1);
  std::size_t deputies_told = 0;
  for (const cli::EvalDomain& domain : domains.domains) {
    deputies_told += domain.deputies;
    EXPECT_LE(domain.miss_m, 1);
    EXPECT_LE(std::abs(domain.centre[0]) + domain.half_widths[0], 6e4 * (1 + 1e-9));
  }
  EXPECT_EQ(deputies_told, deputies.size());
}

TEST(DomainEvaluation, WhatTheLimitLeavesWrongIsMarked) {
  const Scene scene = two_revolutions(1, 3);
  const EvaluatedScene evaluated = cli::evaluated_scene(scene);
  const std::vector<std::vector<double>> deputies = far_deputies(scene);
  DomainEvaluation by_domains(evaluated, 4, 1);
  const std::vector<Told> split = told(by_domains, deputies);
  EXPECT_EQ(by_domains.domains().count, 3U);
  EXPECT_TRUE(by_domains.domains().is_limited);
  std::size_t marked = 0;
  for (std::size_t k = 0; k < deputies.size(); ++k) {
    const double miss = true_miss_m(scene, deputies[k], split[k]);
    if (split[k].estimate.is_inside()) {
      EXPECT_LE(miss, 1);
    } else {
      ++marked;
    }
  }
  EXPECT_GT(marked, 0U);
  EXPECT_LT(marked, deputies.size());
  EXPECT_EQ(by_domains.domains().not_right, marked);
}

TEST(DomainEvaluation, DeputiesWithinReachKeepTheJetOfTheChief) {
  const Scene scene = two_revolutions(1, 100);
  const EvaluatedScene evaluated = cli::evaluated_scene(scene);
  std::vector<std::vector<double>> near = far_deputies(scene);
  for (std::vector<double>& deviation : near) {
    for (double& x : deviation) x /= 100;
  }
  cli::DeputyEvaluation by_one(evaluated, 4, 1);
  DomainEvaluation by_domains(evaluated, 4, 1);
  const std::vector<Told> one = told(by_one, near);
  const std::vector<Told> split = told(by_domains, near);
  EXPECT_EQ(by_domains.domains().count, 1U);
  EXPECT_EQ(by_domains.domains().maps, 1U);
  for (std::size_t k = 0; k < near.size(); ++k) EXPECT_EQ(one[k].deviation, split[k].deviation);
  EXPECT_THROW(DomainEvaluation(evaluated, 1, 1), Error);
}

// One deputy beyond all reach, whose degrees do not decay, is right about itself, to what rounding
// and integration leave.
TEST(DomainEvaluation, ADeputyFarAsideHasAJetOfItsOwn) {
  const Scene scene = two_revolutions(1, 100);
  const EvaluatedScene evaluated = cli::evaluated_scene(scene);
  const std::vector<std::vector<double>> far = {{0.3, 0, 0.05, 0, 0.01, 0}};
  cli::DeputyEvaluation by_one(evaluated, 4, 1);
  EXPECT_FALSE(told(by_one, far).front().estimate.is_inside());
  DomainEvaluation by_domains(evaluated, 4, 1);
  const Told one = told(by_domains, far).front();
  EXPECT_TRUE(one.estimate.is_inside());
  EXPECT_LT(true_miss_m(scene, far.front(), one), 1e-3);
  EXPECT_EQ(by_domains.domains().count, 1U);
  EXPECT_EQ(by_domains.domains().maps, 2U);
}

/// The example of Wittig et al. (2015), in a plane with a node: mu = 1, from (1, 0) with (0,
/// sqrt 1.5), in a box of positions +-0.008 by +-0.08, here as 15 x 15 deputies of a body with the
/// unit of length 10 000 km; to 1e-5 (100 m).
struct Published {
  Scene scene;
  std::vector<std::vector<double>> deputies;
};

Published published(int order, const std::string& coordinates, double time) {
  Published result;
  result.scene = io::parse_scene(
      fmt::format("schema = 1\ntitle = \"published\"\n"
                  "system = {{ model = \"kepler\", mu_km3_s2 = 1e6 }}\n"
                  "nominal = {{ position_km = [10000, 0, 0], velocity_km_s = [0, {:.17g}, {:.17g}] "
                  "}}\njet = {{ order = {}, duration_canonical = {}, coordinates = \"{}\" }}\n"
                  "eval = {{ tolerance_m = 100, most_domains = 400 }}\n",
                  10 * std::sqrt(1.5) * 0.6, 10 * std::sqrt(1.5) * 0.8, order, time, coordinates),
      "published.toml");
  constexpr int half = 7;
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      const double y = 0.08 * j / half;
      result.deputies.push_back({0.008 * i / half, 0.6 * y, 0.8 * y, 0, 0, 0});
    }
  }
  return result;
}

std::size_t domains_of(const Published& example) {
  const EvaluatedScene evaluated = cli::evaluated_scene(example.scene);
  DomainEvaluation evaluation(evaluated, example.scene.order, 1);
  const std::vector<Told> all = told(evaluation, example.deputies);
  EXPECT_EQ(evaluation.domains().not_right, 0U);
  for (std::size_t k = 0; k < all.size(); k += 3) {
    EXPECT_LE(true_miss_m(example.scene, example.deputies[k], all[k]), 3 * 100.0) << k;
  }
  return evaluation.domains().count;
}

TEST(DomainEvaluation, PublishedExampleNeedsManyDomainsAndOneFlowBox) {
  EXPECT_GE(domains_of(published(4, "cartesian", 50)), 24U);
  EXPECT_EQ(domains_of(published(4, "flow-box", 50)), 1U);
}

}  // namespace
}  // namespace hamjet::test
