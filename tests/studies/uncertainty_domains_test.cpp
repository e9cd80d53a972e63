#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "studies/uncertainty/quadrature.hpp"
#include "studies/uncertainty/uncertainty.hpp"

// Uncertain states that one jet is too small for. Expected: flights of this file's own, by the
// classical method of Runge and Kutta in kilometres and seconds, of samples that it draws itself;
// and closed forms of normal variables within intervals.

namespace hamjet {
namespace {

using State = Eigen::Matrix<double, 6, 1>;
using Eigen::Vector3d;

constexpr double mu = 398600.4415;
constexpr double radius = 6378.1363;
constexpr double j2 = 1.08262668355315e-3;
constexpr double semi_axis = 6978;
const double period = 2 * std::numbers::pi * std::sqrt(semi_axis * semi_axis * semi_axis / mu);

State rate(const State& y) {
  const Vector3d r = y.head<3>();
  const double square = r.squaredNorm();
  const double k = mu / (square * std::sqrt(square));
  const double oblate = 1.5 * j2 * radius * radius / square;
  const double z = 5 * r[2] * r[2] / square;
  State result;
  result.head<3>() = y.tail<3>();
  result.tail<3>() = -k * Vector3d(r[0] * (1 + oblate * (1 - z)), r[1] * (1 + oblate * (1 - z)),
                                   r[2] * (1 + oblate * (3 - z)));
  return result;
}

void step(State& y, double h) {
  const State a = rate(y), b = rate(y + h / 2 * a), c = rate(y + h / 2 * b), d = rate(y + h * c);
  y += h / 6 * (a + 2 * b + 2 * c + d);
}

/// Columns R, T, N.
Eigen::Matrix3d axes_of(const State& y) {
  const Vector3d r = y.head<3>().normalized();
  const Vector3d n = Vector3d(y.head<3>()).cross(Vector3d(y.tail<3>())).normalized();
  Eigen::Matrix3d axes;
  axes << r, n.cross(r), n;
  return axes;
}

State chief_state() {
  const double v = std::sqrt(mu / semi_axis), i = 97.8 * std::numbers::pi / 180;
  State y;
  y << semi_axis, 0, 0, 0, v * std::cos(i), v * std::sin(i);
  return y;
}

/// Standard deviations along R, T and N, m and m/s, the same of all axes.
State drawn(const State& mean, double position_m, double velocity_m_s, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Matrix3d axes = axes_of(mean);
  Vector3d position, velocity;
  for (double& x : position) x = position_m / 1000 * normal(random);
  for (double& x : velocity) x = velocity_m_s / 1000 * normal(random);
  State y = mean;
  y.head<3>() += axes * position;
  y.tail<3>() += axes * velocity;
  return y;
}

Scene scene_of(int order, int revolutions, const std::string& tables) {
  const State y = chief_state();
  return io::parse_scene(
      fmt::format("[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = {}\nradius_km = {}\nJ2 = {}\n"
                  "[nominal]\nposition_km = [{:.17g}, 0, 0]\nvelocity_km_s = [0, {:.17g}, "
                  "{:.17g}]\n[jet]\norder = {}\nduration_s = {:.17g}\n{}",
                  mu, radius, j2, y[0], y[4], y[5], order, revolutions * period, tables),
      "file.toml");
}

/// Mean, standard deviation, skewness and excess kurtosis.
using Moments = std::array<double, 4>;

Moments moments_of(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0;
  for (const double x : values) mean += x / n;
  std::array<double, 5> central{};
  for (const double x : values) {
    for (int k = 2; k <= 4; ++k) central[static_cast<std::size_t>(k)] += std::pow(x - mean, k) / n;
  }
  const double s = std::sqrt(central[2]);
  return {mean, s, central[3] / (s * s * s), central[4] / (s * s * s * s) - 3};
}

Moments moments_of(const Cumulants& moments, Eigen::Index i) {
  return {moments.mean()[i], moments.standard_deviations()[i], moments.skewness()[i],
          moments.excess_kurtosis()[i]};
}

/// The largest difference from the moments of samples, in their standard errors, which batches of
/// the samples show.
double difference(const Cumulants& said, const std::array<std::vector<double>, 3>& flown) {
  constexpr std::size_t batches = 20;
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Moments whole = moments_of(std::span(flown[i]));
    const Moments told = moments_of(said, static_cast<Eigen::Index>(i));
    const std::size_t size = flown[i].size() / batches;
    std::array<double, 4> squares{};
    for (std::size_t b = 0; b < batches; ++b) {
      const Moments part = moments_of(std::span(flown[i]).subspan(b * size, size));
      for (std::size_t k = 0; k < 4; ++k) squares[k] += std::pow(part[k] - whole[k], 2);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const double scatter = std::sqrt(squares[k] / (batches * (batches - 1)));
      largest = std::max(largest, std::abs(told[k] - whole[k]) / scatter);
    }
  }
  return largest;
}

// Five revolutions after a start that is uncertain by 100 m and 10 m/s, positions are uncertain by
// a twelfth of a revolution.
TEST(UncertaintyDomains, MomentsAreThoseOfFlightsWhereOneJetIsWrong) {
  constexpr int revolutions = 5;
  const std::string known =
      "[uncertainty]\nposition_m = [100, 100, 100]\nvelocity_m_s = [40, 40, 40]\nsamples = 0\n"
      "gaussian_in = \"positions\"\n";
  const UncertaintyResult split =
      study_uncertainty(scene_of(3, revolutions, known + "tolerance_m = 2000\n"));
  constexpr std::size_t samples = 10000;
  constexpr int steps = 200 * revolutions;
  State chief = chief_state();
  for (int k = 0; k < steps; ++k) step(chief, revolutions * period / steps);
  const Eigen::Matrix3d axes = axes_of(chief);
  std::mt19937_64 random(20261128);
  std::array<std::vector<double>, 3> flown;
  for (std::size_t sample = 0; sample < samples; ++sample) {
    State y = drawn(chief_state(), 100, 40, random);
    for (int k = 0; k < steps; ++k) step(y, revolutions * period / steps);
    const Vector3d told = 1000 * axes.transpose() * (y - chief).head<3>();
    for (std::size_t i = 0; i < 3; ++i) flown[i].push_back(told[static_cast<Eigen::Index>(i)]);
  }
  const UncertainState& state = split.points.back().states.front();
  // Twelve moments: five standard errors are left by chance once in 100 000 tries of Gaussian
  // samples; batches tell standard errors to a sixth.
  EXPECT_LT(difference(state.split.back(), flown), 5);
  EXPECT_GT(difference(state.cartesian.back(), flown), 12);
  ASSERT_EQ(split.domains.size(), 1U);
  const UncertaintyDomains& domains = split.domains.front();
  EXPECT_TRUE(domains.is_right);
  EXPECT_LE(domains.error_m, 2000);
  EXPECT_GT(domains.domains.size(), 20U);
  EXPECT_GE(domains.maps, domains.domains.size());
  EXPECT_LT(domains.doubt, 0.01);
  double shares = 0;
  for (const UncertaintyDomain& domain : domains.domains) shares += domain.share;
  EXPECT_NEAR(shares, 1, 1e-12);
}

// A start that is Gaussian in elements has domains in the same standard normal variables. Expected:
// the flights of the study's own samples, in their scatter.
TEST(UncertaintyDomains, DomainsOfElementsHaveTheMomentsOfFlights) {
  const UncertaintyResult result = study_uncertainty(
      scene_of(3, 3,
               "[uncertainty]\nposition_m = [100, 40000, 100]\nvelocity_m_s = [1, 40, 1]\n"
               "samples = 4000\ngaussian_in = \"elements\"\ntolerance_m = 1000\n"));
  ASSERT_EQ(result.domains.size(), 1U);
  EXPECT_GT(result.domains[0].domains.size(), 3U);
  const UncertainState& state = result.points.back().states.front();
  std::array<std::vector<double>, 3> flown;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Vector<double> row = state.flown_states.row(i).transpose();
    flown[static_cast<std::size_t>(i)].assign(row.begin(), row.end());
  }
  EXPECT_LT(difference(state.split.back(), flown), 5);
}

/// On the chief's circle, behind it by an angle.
State behind(double angle) {
  const double i = 97.8 * std::numbers::pi / 180, v = std::sqrt(mu / semi_axis);
  const double c = std::cos(angle), s = -std::sin(angle);
  State y;
  y << semi_axis * c, semi_axis * s * std::cos(i), semi_axis * s * std::sin(i), -v * s,
      v * c * std::cos(i), v * c * std::sin(i);
  return y;
}

/// The least distance during a step in which relative motion is nearly straight, km.
double least_distance(const State& begin, const State& end) {
  const Vector3d from = begin.head<3>(), way = end.head<3>() - begin.head<3>();
  const double part = std::clamp(-from.dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (from + part * way).norm();
}

// A deputy 700 km behind that is uncertain by 10 m/s drifts past its chief within five revolutions
// in some cases, of which polynomials of order 2 about its mean say too little.
TEST(UncertaintyDomains, CollisionsAreThoseOfFlightsWhereOneJetIsWrong) {
  constexpr int revolutions = 2;
  constexpr double nearer_km = 5;
  const State mean = behind(0.06);
  const std::string tables = fmt::format(
      "[deputy]\nposition_km = [{:.17g}, {:.17g}, {:.17g}]\nvelocity_km_s = [{:.17g}, {:.17g}, "
      "{:.17g}]\n[uncertainty.deputy]\nposition_m = [100, 100, 100]\nvelocity_m_s = [20, 20, "
      "20]\n[uncertainty.collision]\nradius_m = {}\nsampling = \"plain\"\nsamples = "
      "2000\n[uncertainty]\nsamples = "
      "0\ngaussian_in = \"positions\"\n",
      mean[0], mean[1], mean[2], mean[3], mean[4], mean[5], 1000 * nearer_km);
  const auto study = [&](const std::string& further) {
    return study_collision(scene_of(2, revolutions, tables + further), 2);
  };
  const CollisionProbability split = study("tolerance_m = 1000\n").probability;
  const CollisionProbability whole = study("").probability;

  constexpr std::size_t samples = 10000;
  constexpr int steps = 200 * revolutions;
  const double h = revolutions * period / steps;
  std::vector<State> chief = {chief_state()};
  for (int k = 0; k < steps; ++k) {
    chief.push_back(chief.back());
    step(chief.back(), h);
  }
  std::mt19937_64 random(20261129);
  std::size_t hits = 0;
  for (std::size_t sample = 0; sample < samples; ++sample) {
    State y = drawn(mean, 100, 20, random);
    bool is_hit = false;
    for (std::size_t k = 0; k < steps && !is_hit; ++k) {
      const State before = y - chief[k];
      step(y, h);
      is_hit = least_distance(before, y - chief[k + 1]) < nearer_km;
    }
    if (is_hit) ++hits;
  }
  const double flown = static_cast<double>(hits) / samples;
  const double scatter = std::sqrt(flown * (1 - flown) / samples);
  EXPECT_GT(split.parts, 1U);
  EXPECT_EQ(whole.parts, 1U);
  // 1 in 2000 tries is left by chance.
  EXPECT_NEAR(split.probability, flown, 3.5 * std::hypot(scatter, split.standard_error));
  EXPECT_GT(whole.path_error, 250);
  EXPECT_LT(split.path_error, 100);
}

// Where one jet is right, the domain is one, and moments by quadrature are those of its
// polynomials.
TEST(UncertaintyDomains, OneDomainHasTheMomentsOfItsPolynomials) {
  const UncertaintyResult result = study_uncertainty(
      scene_of(3, 1,
               "[uncertainty]\nposition_m = [10, 10, 10]\nvelocity_m_s = [0.01, 0.01, 0.01]\n"
               "samples = 0\ntolerance_m = 1\n"));
  ASSERT_EQ(result.domains.size(), 1U);
  EXPECT_EQ(result.domains[0].domains.size(), 1U);
  const UncertainState& state = result.points.back().states.front();
  ASSERT_EQ(state.split.size(), state.cartesian.size());
  for (std::size_t n = 0; n < state.split.size(); ++n) {
    for (Eigen::Index i = 0; i < 6; ++i) {
      const Moments by_quadrature = moments_of(state.split[n], i);
      const Moments exact = moments_of(state.cartesian[n], i);
      EXPECT_NEAR(by_quadrature[0], exact[0], 1e-9 * exact[1]) << n << ' ' << i;
      EXPECT_NEAR(by_quadrature[1] / exact[1], 1, 1e-9) << n << ' ' << i;
      EXPECT_NEAR(by_quadrature[2], exact[2], 1e-6) << n << ' ' << i;
      EXPECT_NEAR(by_quadrature[3], exact[3], 1e-6) << n << ' ' << i;
    }
  }
}

TEST(UncertaintyDomains, KeysThatSplitNothingAreRefused) {
  const std::string known = "[uncertainty]\nposition_m = [10, 10, 10]\n";
  const auto message_of = [&](int order, const std::string& keys) -> std::string {
    try {
      scene_of(order, 1, known + keys);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of(2, "tolerance_m = 1\nmost_domains = 7\n"), "");
  EXPECT_NE(message_of(2, "most_domains = 7\n").find("uncertainty.most_domains: nothing is split"),
            std::string::npos);
  EXPECT_NE(
      message_of(1, "tolerance_m = 1\n").find("no estimate of the miss to split deviations by"),
      std::string::npos);
  EXPECT_NE(message_of(2, "tolerance_m = 0\n").find("uncertainty.tolerance_m"), std::string::npos);
}

// With phi the density and P the probability of an interval, the means of x and x^2 within it are
// (phi(a) - phi(b)) / P and 1 + (a phi(a) - b phi(b)) / P.
TEST(UncertaintyDomains, QuadratureWithinIntervalsHasTheMomentsOfTruncatedNormals) {
  const auto density = [](double x) {
    return std::isinf(x) ? 0 : std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
  };
  const auto times_density = [&](double x) { return std::isinf(x) ? 0 : x * density(x); };
  const double never = std::numeric_limits<double>::infinity();
  for (const NormalInterval& interval :
       {NormalInterval{-never, -1.5}, NormalInterval{-1.5, 0}, NormalInterval{0.25, 2.25},
        NormalInterval{2.25, never}, NormalInterval{}}) {
    const double a = interval.from, b = interval.to;
    const double probability = interval.probability();
    const double mean = (density(a) - density(b)) / probability;
    const double square = 1 + (times_density(a) - times_density(b)) / probability;
    const NormalQuadrature rule = product_quadrature({7, 5}, {{}, interval});
    ASSERT_EQ(rule.weights.size(), 35);
    EXPECT_NEAR(rule.weights.sum(), 1, 1e-13);
    EXPECT_NEAR(rule.weights.dot(rule.points.row(1).transpose()), mean, 1e-13) << a;
    EXPECT_NEAR(rule.weights.dot(rule.points.row(1).transpose().cwiseAbs2()), square, 1e-12) << a;
    EXPECT_NEAR(rule.weights.dot(rule.points.row(0).transpose().array().pow(8).matrix()), 105,
                1e-10)
        << a;
  }
  EXPECT_NEAR((NormalInterval{-1, 1}.probability()), 0.682689492137086, 1e-15);
}

}  // namespace
}  // namespace hamjet
