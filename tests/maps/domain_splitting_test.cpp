#include "hamjet/maps/domain_splitting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

// Boxes that are split. Expected: Kepler's problem in closed form (elements, in which the mean
// longitude alone advances), a polynomial that its own jet has exactly, and a function of one
// variable whose Taylor series is known.

namespace hamjet {
namespace {

struct PlaneKepler {
  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / T(2) - T(1) / sqrt(q[0] * q[0] + q[1] * q[1]);
  }
};

const std::vector<double> velocity = {0, std::sqrt(1.5)};

FlowMap<double> kepler_map(std::span<const double> position, int order, double duration) {
  static const DynamicalSystem system = make_system("kepler", 2, PlaneKepler{});
  const FlowProblem<double> problem{system,
                                    SeriesSpace::create(2, order),
                                    {0, 1},
                                    {position[0], position[1], velocity[0], velocity[1]},
                                    ClockTime::epoch(),
                                    duration};
  GaussSettings settings;
  settings.stages = 12;
  settings.tolerance = 1e-12;
  IntegrationStatistics statistics;
  return FlowMap<double>(integrate_gauss<double>(problem, settings, statistics));
}

/// In closed form.
std::vector<double> kepler_flight(std::span<const double> position, double duration) {
  const SixNumbers<double> start = {position[0], position[1], 0, velocity[0], velocity[1], 0};
  const CanonicalChart<double> chart(ChartName::poincare, start, 1);
  SixNumbers<double> elements = chart.coordinates(start);
  elements[0] += duration / (elements[3] * elements[3] * elements[3]);
  const SixNumbers<double> end = chart.state(elements);
  return {end[0], end[1], end[3], end[4]};
}

/// The example of Wittig et al. (2015).
SplitMap published(int order, double duration, double tolerance, std::size_t most = 1000) {
  return split_domains(
      [&](std::span<const double> centre) { return kepler_map(centre, order, duration); },
      std::vector<double>{1, 0}, std::vector<double>{0.008, 0.08},
      {.tolerance = tolerance, .components = 4, .most_domains = most});
}

TEST(DomainSplitting, EveryPointOfTheBoxIsRight) {
  const double duration = 20;
  const double tolerance = 1e-4;
  const SplitMap split = published(6, duration, tolerance);
  EXPECT_TRUE(split.is_right);
  EXPECT_GT(split.domains.size(), 4U);
  EXPECT_EQ(split.maps_made, 2 * split.domains.size() - 1);
  EXPECT_LE(split.error(), tolerance);
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double worst = 0;
  double worst_of_one = 0;
  const FlowMap<double> one = kepler_map(std::vector<double>{1, 0}, 6, duration);
  const auto apart = [](const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
  };
  for (int k = 0; k < 400; ++k) {
    std::vector<double> deviation = {0.008 * uniform(generator), 0.08 * uniform(generator)};
    if (k < 4) deviation = {k % 2 == 0 ? 0.008 : -0.008, k < 2 ? 0.08 : -0.08};
    const std::vector<double> point = {1 + deviation[0], deviation[1]};
    const std::vector<double> right = kepler_flight(point, duration);
    worst = std::max(worst, apart(split.evaluate(point), right));
    std::vector<double> by_one = one.evaluate(deviation);
    for (std::size_t i = 0; i < 4; ++i) by_one[i] += one.jet()[i][0];
    worst_of_one = std::max(worst_of_one, apart(by_one, right));
  }
  EXPECT_LT(worst, 3 * tolerance);
  EXPECT_GT(worst_of_one, 100 * tolerance);
}

TEST(DomainSplitting, MoreDomainsAtALaterTimeAndFewerAtAHigherOrder) {
  const auto count = [](int order, double duration) {
    return published(order, duration, 1e-4).domains.size();
  };
  const std::size_t late = count(6, 20);
  EXPECT_LT(count(6, 10), late);
  EXPECT_GT(late, count(10, 20));
}

TEST(DomainSplitting, ALimitIsKeptAndTold) {
  const SplitMap split = published(4, 20, 1e-9, 5);
  EXPECT_FALSE(split.is_right);
  EXPECT_EQ(split.domains.size(), 5U);
  EXPECT_GT(split.error(), 1e-9);
}

/// 1 / (1 - x) about c has the coefficients (1 - c)^-(k+1), whose sizes in the box fall exactly
/// geometrically: the estimate is the first term that is left out.
TEST(DomainSplitting, AGeometricSeries) {
  const int order = 5;
  const auto map_about = [&](std::span<const double> c) {
    const SpacePointer space = SeriesSpace::create(1, order);
    Series<double> series(space);
    for (int k = 0; k <= order; ++k) {
      series[static_cast<std::size_t>(k)] = std::pow(1 - c[0], -(k + 1));
    }
    return FlowMap<double>({series});
  };
  const SplitMap whole =
      split_domains(map_about, std::vector<double>{0}, std::vector<double>{0.5}, {.tolerance = 1});
  ASSERT_EQ(whole.domains.size(), 1U);
  EXPECT_NEAR(whole.error(), std::pow(0.5, 6), 1e-12);
  const SplitMap split = split_domains(map_about, std::vector<double>{0}, std::vector<double>{0.5},
                                       {.tolerance = 1e-5});
  EXPECT_GT(split.domains.size(), 3U);
  for (double x = -0.5; x <= 0.5; x += 1.0 / 128) {
    EXPECT_NEAR(split.evaluate(std::vector<double>{x})[0], 1 / (1 - x), 2e-5);
  }
  // They are narrower where the pole is near.
  EXPECT_LT(split.domain_of(std::vector<double>{0.49}).half_widths[0],
            split.domain_of(std::vector<double>{-0.49}).half_widths[0]);
}

/// Only across the variable that matters.
TEST(DomainSplitting, SplitsAcrossTheVariableThatLimits) {
  const auto map_about = [](std::span<const double> c) {
    const SpacePointer space = SeriesSpace::create(2, 3);
    Series<double> series = Series<double>::variable(space, 0, c[0]);
    series += sin_cos(Series<double>::variable(space, 1, c[1])).first;
    return FlowMap<double>({series});
  };
  const SplitMap split = split_domains(map_about, std::vector<double>{0, 0.5},
                                       std::vector<double>{1, 1}, {.tolerance = 1e-3});
  EXPECT_GT(split.domains.size(), 1U);
  for (const SplitDomain& domain : split.domains) EXPECT_EQ(domain.half_widths[0], 1);
}

/// At points the error of the series of 1 / (1 - x) about c is known in closed form: x = c + d, and
/// (d / (1 - c))^(N+1) / (1 - x) is missing. The first coordinate does not matter.
TEST(DomainSplitting, PointsAreSplitUntilEachIsRight) {
  constexpr int order = 5;
  const double tolerance = 1e-6;
  std::vector<std::vector<double>> points;
  for (int k = 0; k <= 64; ++k) points.push_back({k % 2 == 0 ? 3.0 : -3.0, k / 100.0 - 0.32});
  std::vector<double> errors(points.size());
  std::vector<std::vector<double>> centres;
  const auto assess = [&](const PointDomain& domain) {
    centres.push_back(domain.centre);
    const double c = domain.centre[1];
    PointAssessment found{0, {0, 1}};
    for (const std::size_t k : domain.points) {
      const double x = points[k][1];
      EXPECT_LE(std::abs(x - c), domain.half_widths[1] * (1 + 1e-12));
      errors[k] = std::abs(std::pow((x - c) / (1 - c), order + 1) / (1 - x));
      found.error = std::max(found.error, errors[k]);
    }
    return found;
  };
  const std::vector<double> centre = {0, 0};
  const PointSplit split = split_points(assess, points, centre, {.tolerance = tolerance});
  EXPECT_TRUE(split.is_right);
  EXPECT_GT(split.domains.size(), 2U);
  EXPECT_EQ(centres.front(), centre);
  EXPECT_EQ(split.maps_made, 2 * split.domains.size() - 1);
  EXPECT_EQ(split.splits, (std::vector<std::size_t>{0, split.domains.size() - 1}));
  std::vector<int> held(points.size());
  for (const PointDomain& domain : split.domains) {
    for (const std::size_t k : domain.points) ++held[k];
  }
  EXPECT_TRUE(std::all_of(held.begin(), held.end(), [](int count) { return count == 1; }));
  EXPECT_LE(*std::max_element(errors.begin(), errors.end()), tolerance);
  // A limit is kept and told.
  const PointSplit limited =
      split_points(assess, points, centre, {.tolerance = tolerance, .most_domains = 2});
  EXPECT_FALSE(limited.is_right);
  EXPECT_EQ(limited.domains.size(), 2U);
  // What no split makes better is left, and splitting ends: here all is said to be of the first
  // coordinate, which ends at its two values.
  const auto first_alone = [&](const PointDomain&) { return PointAssessment{1, {1, 0}}; };
  const PointSplit hopeless = split_points(first_alone, points, centre, {.tolerance = tolerance});
  EXPECT_FALSE(hopeless.is_right);
  EXPECT_EQ(hopeless.domains.size(), 2U);
  EXPECT_THROW(split_points(first_alone, {}, centre, {}), Error);
  EXPECT_THROW(split_points(first_alone, points, std::vector<double>{0}, {}), Error);
}

/// Of the published example counts grow with the time and fall with the order, and all points are
/// right. No count is taken from a run: at t = 50 the published method needs dozens at a low order.
TEST(DomainSplitting, PublishedExampleAtItsOwnTime) {
  const double tolerance = 1e-5;
  const SplitMap six = published(6, 50, tolerance);
  const SplitMap fourteen = published(14, 50, tolerance);
  EXPECT_GE(six.domains.size(), 24U);
  EXPECT_LT(fourteen.domains.size(), six.domains.size() / 2);
  EXPECT_LT(published(6, 10, tolerance).domains.size(), six.domains.size() / 4);
  for (double x = -1; x <= 1; x += 0.25) {
    for (double y = -1; y <= 1; y += 0.125) {
      const std::vector<double> point = {1 + 0.008 * x, 0.08 * y};
      const std::vector<double> right = kepler_flight(point, 50);
      for (const SplitMap* split : {&six, &fourteen}) {
        const std::vector<double> found = split->evaluate(point);
        for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], right[i], 3 * tolerance);
      }
    }
  }
}

TEST(DomainSplitting, WhatMakesNoSenseIsRefused) {
  const auto map_about = [](std::span<const double>) {
    return FlowMap<double>({Series<double>(SeriesSpace::create(1, 3), 1.0)});
  };
  const std::vector<double> one = {1};
  EXPECT_THROW(split_domains(map_about, one, std::vector<double>{0}, {}), Error);
  EXPECT_THROW(split_domains(map_about, one, std::vector<double>{1, 1}, {}), Error);
  EXPECT_THROW(split_domains(map_about, one, one, {.tolerance = 0}), Error);
  EXPECT_THROW(split_domains(map_about, one, one, {.components = 2}), Error);
  const SplitMap split = split_domains(map_about, one, one, {});
  EXPECT_THROW(split.evaluate(std::vector<double>{1, 2}), Error);
}

}  // namespace
}  // namespace hamjet
