#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "studies/uncertainty/uncertainty.hpp"

// Moments of systems that a scene writes, of one to three coordinates.

namespace hamjet {
namespace {

constexpr double amplitude = 1;
constexpr double deviation = 0.05;
constexpr double duration = 3;

std::string pendulum(int order) {
  return "[system]\nmodel = \"own\"\ncoordinates = [\"angle\"]\nmomenta = [\"L\"]\nhamiltonian = "
         "\"L^2/2 - cos(angle)\"\n[nominal]\ncoordinates = [1]\nmomenta = [0]\n[jet]\norder = " +
         std::to_string(order) + "\nduration_canonical = 3\n[uncertainty]\nposition_m = [0.05]\n";
}

/// Angle and momentum after the duration, by the classical Runge-Kutta method, whose error is below
/// 1e-11 with these steps.
std::array<double, 2> swung(double angle) {
  constexpr int steps = 3000;
  constexpr double h = duration / steps;
  using State = std::array<double, 2>;
  const auto slope = [](const State& z) { return State{z[1], -std::sin(z[0])}; };
  const auto moved = [](const State& z, const State& k, double by) {
    return State{z[0] + by * k[0], z[1] + by * k[1]};
  };
  State z = {angle, 0};
  for (int i = 0; i < steps; ++i) {
    const State a = slope(z), b = slope(moved(z, a, h / 2)), c = slope(moved(z, b, h / 2)),
                d = slope(moved(z, c, h));
    for (std::size_t k = 0; k < 2; ++k) z[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
  }
  return z;
}

/// Mean and standard deviation over the start's Gaussian, by the trapezoidal rule, which converges
/// faster than any power for it.
struct Moments {
  std::array<double, 2> mean = {};
  std::array<double, 2> deviation = {};
};
Moments by_quadrature() {
  const std::array<double, 2> nominal = swung(amplitude);
  Moments result;
  std::array<double, 2> square = {};
  double all = 0;
  constexpr double step = 0.25;
  for (int i = -34; i <= 34; ++i) {
    const double weight = std::exp(-0.5 * step * step * i * i);
    const std::array<double, 2> end = swung(amplitude + deviation * step * i);
    all += weight;
    for (std::size_t k = 0; k < 2; ++k) {
      const double difference = end[k] - nominal[k];
      result.mean[k] += weight * difference;
      square[k] += weight * difference * difference;
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    result.mean[k] /= all;
    result.deviation[k] = std::sqrt(square[k] / all - result.mean[k] * result.mean[k]);
  }
  return result;
}

/// How far moments of an order are from those by quadrature.
double error_of(int order) {
  const UncertaintyResult result = study_uncertainty(io::parse_scene(pendulum(order), "own.toml"));
  const Cumulants& moments = result.points.back().states.at(0).cartesian.back();
  EXPECT_EQ(moments.size(), 2);
  const Moments right = by_quadrature();
  double error = 0;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const auto i = static_cast<std::size_t>(k);
    error = std::max(error, std::abs(moments.mean()[k] - right.mean[i]));
    error = std::max(error, std::abs(moments.standard_deviations()[k] - right.deviation[i]));
  }
  return error;
}

TEST(OwnMoments, AreThoseOfAPendulumByQuadrature) {
  // What an order leaves out falls by the square of the deviation from one even order to the next;
  // a factor of 100 is a quarter of that.
  const double of_two = error_of(2);
  const double of_four = error_of(4);
  const double of_six = error_of(6);
  EXPECT_LT(of_two, 1e-3);
  EXPECT_LT(of_four, of_two / 100);
  EXPECT_LT(of_six, of_four / 100);
}

// x = x0 cos t + v0 sin t and y = y0 cos 2 t + (v0 / 2) sin 2 t, of independent starts.
TEST(OwnMoments, AreThoseOfAnOscillatorInClosedForm) {
  const UncertaintyResult result = study_uncertainty(io::parse_scene(
      "[system]\nmodel = \"own\"\ncoordinates = [\"x\", \"y\"]\nmomenta = [\"px\", \"py\"]\n"
      "hamiltonian = \"(px^2 + py^2)/2 + (x^2 + 4*y^2)/2\"\n[nominal]\ncoordinates = [1, 0]\n"
      "momenta = [0, 1]\n[jet]\norder = 3\nduration_canonical = 2\n[uncertainty]\n"
      "covariance_m_m_s = [[9, 0, 2, 0], [0, 4, 0, 0], [2, 0, 1, 0], [0, 0, 0, 16]]\n",
      "oscillator.toml"));
  const Vector<double> told =
      result.points.back().states.at(0).cartesian.back().standard_deviations();
  ASSERT_EQ(told.size(), 4);
  const double c = std::cos(2.0), s = std::sin(2.0), c2 = std::cos(4.0), s2 = std::sin(4.0);
  EXPECT_NEAR(told[0], std::sqrt(9 * c * c + 4 * c * s + s * s), 1e-11);
  EXPECT_NEAR(told[1], std::sqrt(4 * c2 * c2 + 4 * s2 * s2), 1e-11);
  EXPECT_NEAR(told[2], std::sqrt(9 * s * s - 4 * c * s + c * c), 1e-11);
  EXPECT_NEAR(told[3], std::sqrt(16 * s2 * s2 + 16 * c2 * c2), 1e-11);
}

}  // namespace
}  // namespace hamjet
