#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/double_well.hpp"
#include "hamjet/integrators/midpoint.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"

// Jets of the double well are compared with an independent computation: finite differences of a
// flow in extended precision that does not use the library's jets.

namespace hamjet::test {
namespace {

using Point = std::vector<Extended>;

/// The flow of q'' = q - 2 q^3 by the power series of the solution, whose coefficients follow from
///
///   (k + 1)(k + 2) q_(k+2) = q_k - 2 (q^3)_k .
///
/// Steps of 1/20 with 40 terms leave an error below 1e-32: the nearest complex singularity of the
/// solution is further away than 1/2.
Point flow(Point z, const Extended& duration, int steps) {
  const Extended h = duration / steps;
  constexpr int terms = 40;
  for (int step = 0; step < steps; ++step) {
    std::vector<Extended> q = {z[0], z[1]};
    std::vector<Extended> square;
    for (int k = 0; k + 2 < terms; ++k) {
      Extended sum = 0;
      for (int i = 0; i <= k; ++i) sum += q[i] * q[k - i];
      square.push_back(sum);
      Extended cube = 0;
      for (int i = 0; i <= k; ++i) cube += square[i] * q[k - i];
      q.push_back((q[k] - 2 * cube) / ((k + 1) * (k + 2)));
    }
    z = {0, 0};
    for (int k = terms - 1; k >= 0; --k) z[0] = z[0] * h + q[k];
    for (int k = terms - 1; k >= 1; --k) z[1] = z[1] * h + k * q[k];
  }
  return z;
}

/// A map of the plane whose derivatives are computed.
using Map = std::function<Point(const Point&)>;

/// The coefficients of degree 1 to 3 of a map by central differences of width 1e-6: errors near
/// 1e-12 times the derivative that is two degrees higher.
struct Differences {
  explicit Differences(const Map& map, const Point& at) : map_(map), at_(at) {}

  /// d^(a+b) / (a! b!) of component i.
  double coefficient(std::size_t i, int a, int b) const {
    Extended sum = 0;
    Extended scale = 1;
    for (int k = 1; k <= a; ++k) scale *= 2 * width_ * k;
    for (int k = 1; k <= b; ++k) scale *= 2 * width_ * k;
    for (int j = 0; j <= a; ++j) {
      for (int k = 0; k <= b; ++k) {
        const Extended weight = ((j + k) % 2 == 0 ? 1 : -1) * binomial(a, j) * binomial(b, k);
        sum += weight * map_({at_[0] + (a - 2 * j) * width_, at_[1] + (b - 2 * k) * width_})[i];
      }
    }
    return static_cast<double>(Extended(sum / scale));
  }

 private:
  static int binomial(int n, int k) { return k == 0 ? 1 : binomial(n - 1, k - 1) * n / k; }

  Map map_;
  Point at_;
  Extended width_ = 1e-7;
};

/// The largest difference of a jet's coefficients of degree 1 to 3 from the differences, relative
/// to the largest of the degree.
void expect_jet(const FlowJet<double>& jet, const Differences& differences, double tolerance) {
  for (int d = 1; d <= 3; ++d) {
    double error = 0;
    double scale = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      for (int a = 0; a <= d; ++a) {
        const std::vector<std::uint8_t> exponents = {static_cast<std::uint8_t>(a),
                                                     static_cast<std::uint8_t>(d - a)};
        const double expected = differences.coefficient(i, a, d - a);
        error = larger(error, std::abs(jet[i][jet[i].space().index(exponents)] - expected));
        scale = std::max(scale, std::abs(expected));
      }
    }
    EXPECT_GT(scale, 0.1);
    EXPECT_LE(error / scale, tolerance) << "degree " << d;
  }
}

constexpr double duration = 3;
const std::vector<double> start = {1, 0.05};
Flow<double> well() { return {double_well(), start, duration, 3, {}}; }
Point precise_start() { return {Extended(1), Extended(0.05)}; }

TEST(DoubleWellJet, OfGaussWithEightStages) {
  const auto jet = run_gauss(well(), adaptive(8, 1e-14));
  const Differences exact([](const Point& z) { return flow(z, Extended(duration), 60); },
                          precise_start());
  expect_jet(jet, exact, 2e-11);
}

// One stage is the midpoint scheme, whose map is far from the flow: the jet is that of the scheme's
// map.
TEST(DoubleWellJet, OfTheMidpointScheme) {
  constexpr int steps = 15;
  const auto jet = run_gauss(well(), fixed_step(1, duration / steps));
  RecordedHamiltonian<Extended> h(double_well());
  const Differences scheme(
      [&](const Point& z) {
        Vector<Extended> state(2);
        state << z[0], z[1];
        for (int k = 0; k < steps; ++k) {
          state = midpoint_step<Extended>(h, state, Extended(duration) / steps);
        }
        return Point{state(0), state(1)};
      },
      precise_start());
  expect_jet(jet, scheme, 2e-11);
  const Point end = flow(precise_start(), Extended(duration), 60);
  EXPECT_GT(std::abs(jet[0][0] - static_cast<double>(end[0])), 1e-3);
}

// Both maps are symplectic, so that F1 exists and is exact to round-off, though one of them is
// wrong.
TEST(DoubleWellJet, GeneratingFunctionIsExact) {
  for (const GaussSettings& settings : {adaptive(8, 1e-14), fixed_step(1, 0.2)}) {
    const auto inversion = inverted_jet(run_gauss(well(), settings), "F1");
    const auto residuals = exactness_residual(one_form(inversion));
    for (const ExactnessResidual& residual : residuals) {
      EXPECT_LE(residual.scaled, 1e-12) << residual.degree;
    }
  }
}

}  // namespace
}  // namespace hamjet::test
